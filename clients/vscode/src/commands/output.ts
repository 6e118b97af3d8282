// Output files are written beside their target and renamed: nobody reads half a program.

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";

export async function write(target: vscode.Uri, content: string | Uint8Array): Promise<void> {
  const beside = target.with({ path: `${target.path}.${randomBytes(6).toString("hex")}.tmp` });
  try {
    await vscode.workspace.fs.writeFile(beside, typeof content === "string" ? Buffer.from(content, "utf8") : content);
    await vscode.workspace.fs.rename(beside, target, { overwrite: true });
  } catch (error) {
    await vscode.workspace.fs.delete(beside).then(undefined, () => undefined);
    throw error;
  }
}

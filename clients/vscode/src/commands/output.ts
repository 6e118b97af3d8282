// Output files are written beside their target and renamed: nobody reads half a program. What is made is opened where it was made from.

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

/** Opens what is made of a document where that stands, so that the picture beside it becomes that of the file. */
export async function openMade(document: vscode.TextDocument, target: vscode.Uri): Promise<void> {
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
  await vscode.window.showTextDocument(target, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.Active, preview: false });
}

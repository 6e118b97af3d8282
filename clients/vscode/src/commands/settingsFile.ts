// The wedm.toml that holds for a drawing, and edits of it.

import * as vscode from "vscode";
import type { Server } from "../server/server";

/** The one that holds; undefined where there is none. */
export async function settingsThere(server: Server, uri: vscode.Uri): Promise<vscode.Uri | undefined> {
  const { file } = await server.request("wedm/settings", { uri: uri.toString() });
  return file === undefined ? undefined : vscode.Uri.parse(file);
}

/** The one that holds, or the one that would stand beside the drawing. */
export async function settingsFile(server: Server, uri: vscode.Uri): Promise<vscode.Uri> {
  return (await settingsThere(server, uri)) ?? vscode.Uri.joinPath(uri, "..", "wedm.toml");
}

/** Makes the file where it is not there, changes its text and saves it; undo works in that file. */
export async function rewrite(target: vscode.Uri, change: (text: string) => string): Promise<void> {
  const make = new vscode.WorkspaceEdit();
  make.createFile(target, { ignoreIfExists: true });
  await vscode.workspace.applyEdit(make);
  const document = await vscode.workspace.openTextDocument(target);
  const text = document.getText();
  const edit = new vscode.WorkspaceEdit();
  edit.replace(target, new vscode.Range(document.positionAt(0), document.positionAt(text.length)), change(text));
  await vscode.workspace.applyEdit(edit);
  await document.save();
}

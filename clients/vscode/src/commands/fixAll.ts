// Makes every safe repair in one undo step.

import * as vscode from "vscode";
import { isOurs } from "../languages";

const KIND = vscode.CodeActionKind.SourceFixAll.append("wedm");

export async function fixAll(): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined || !isOurs(editor.document)) {
    void vscode.window.showInformationMessage("Wire EDM: open a drawing or a program first.");
    return;
  }
  const { uri, version } = editor.document;
  const actions = await vscode.commands.executeCommand<vscode.CodeAction[]>(
    "vscode.executeCodeActionProvider",
    uri,
    new vscode.Range(0, 0, editor.document.lineCount, 0),
    KIND.value,
  );
  const edit = actions.find((action) => action.kind !== undefined && KIND.contains(action.kind))?.edit;
  if (edit === undefined) {
    void vscode.window.showInformationMessage("Wire EDM: there is nothing that can be repaired safely.");
    return;
  }
  if (editor.document.version !== version || !(await vscode.workspace.applyEdit(edit))) {
    void vscode.window.showWarningMessage("Wire EDM: the text has changed meanwhile, nothing was done.");
  }
}

// Makes every safe repair in one undo step.

import * as vscode from "vscode";
import type { Front } from "../front";

const KIND = vscode.CodeActionKind.SourceFixAll.append("wedm");

export async function fixAll(front: Front): Promise<void> {
  const document = front.document;
  if (document === undefined) {
    void vscode.window.showInformationMessage("Wire EDM: open a drawing or a program first.");
    return;
  }
  const { uri, version } = document;
  const actions = await vscode.commands.executeCommand<vscode.CodeAction[]>(
    "vscode.executeCodeActionProvider",
    uri,
    new vscode.Range(0, 0, document.lineCount, 0),
    KIND.value,
  );
  const edit = actions.find((action) => action.kind !== undefined && KIND.contains(action.kind))?.edit;
  if (edit === undefined) {
    void vscode.window.showInformationMessage("Wire EDM: there is nothing that can be repaired safely.");
    return;
  }
  if (document.version !== version || !(await vscode.workspace.applyEdit(edit))) {
    void vscode.window.showWarningMessage("Wire EDM: the text has changed meanwhile, nothing was done.");
  }
}

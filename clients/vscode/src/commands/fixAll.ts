// Makes every safe repair in one undo step.

import * as vscode from "vscode";
import { type CodeAction, LSPErrorCodes, ResponseError, TextDocumentEdit } from "vscode-languageclient/node";
import type { Front } from "../front";
import type { Server } from "../server/server";
import { uriOf } from "./subject";
import { t } from "../../../picture/words";

/** Kind of the action that makes every safe repair. */
const FIX_ALL = "source.fixAll.wedm";

export async function fixAll(server: Server, front: Front, argument: unknown): Promise<void> {
  const uri = uriOf(argument);
  const document = uri === undefined ? front.document : await vscode.workspace.openTextDocument(uri);
  if (document === undefined) {
    void vscode.window.showInformationMessage(t("Wire EDM: open a drawing or a program first."));
    return;
  }
  const offered = await vscode.window.withProgress({ location: vscode.ProgressLocation.Window, title: t("Wire EDM: looking for repairs") }, () =>
    repairs(server, document),
  );
  if (offered === "none") {
    void vscode.window.showInformationMessage(t("Wire EDM: there is nothing that can be repaired safely."));
  } else if (offered === "outdated" || offered.edit.textDocument.version !== document.version || !(await apply(document, offered.edit))) {
    void vscode.window.showWarningMessage(t("Wire EDM: the text has changed in the meantime, nothing was done."));
  } else if (offered.said !== undefined) {
    void vscode.window.showInformationMessage(t("Wire EDM: {0}.", offered.said));
  }
}

interface Repairs {
  edit: TextDocumentEdit;
  /** How many findings go and how many are left, as a sentence of the server. */
  said: string | undefined;
}

/** Asked of the server itself: VS Code's own way answers with nothing when the text changes, and does not say why. */
async function repairs(server: Server, document: vscode.TextDocument): Promise<Repairs | "none" | "outdated"> {
  const range = { start: { line: 0, character: 0 }, end: { line: document.lineCount, character: 0 } };
  const context = { diagnostics: [], only: [FIX_ALL] };
  let actions: CodeAction[] | null;
  try {
    actions = await server.request("textDocument/codeAction", { textDocument: { uri: document.uri.toString() }, range, context });
  } catch (error) {
    if (error instanceof ResponseError && error.code === LSPErrorCodes.ContentModified) {
      return "outdated";
    }
    throw error;
  }
  const action = actions?.find(({ kind }) => kind === FIX_ALL);
  const edit = action?.edit?.documentChanges?.find((change) => TextDocumentEdit.is(change));
  const data = action?.data as { said?: string } | undefined;
  return edit === undefined ? "none" : { edit, said: data?.said };
}

async function apply(document: vscode.TextDocument, repairs: TextDocumentEdit): Promise<boolean> {
  const edit = new vscode.WorkspaceEdit();
  const edits = repairs.edits.flatMap((each) => {
    if (!("newText" in each)) {
      return [];
    }
    const { start, end } = each.range;
    return [new vscode.TextEdit(new vscode.Range(start.line, start.character, end.line, end.character), each.newText)];
  });
  edit.set(document.uri, edits);
  return vscode.workspace.applyEdit(edit);
}

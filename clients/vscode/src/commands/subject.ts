// Which document a command is about.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isOurs } from "../languages";
import { t } from "../../../picture/words";

/** Commands come from the palette, a menu, a code lens or another program: with a URI, with its text, or with nothing. */
export async function subject(
  front: Front,
  argument: unknown,
  accepts: (language: string) => boolean,
): Promise<vscode.TextDocument | undefined> {
  const uri = uriOf(argument) ?? front.document?.uri;
  if (uri === undefined) {
    void vscode.window.showInformationMessage(t("Wire EDM: open a drawing or a program first."));
    return undefined;
  }
  const document = await vscode.workspace.openTextDocument(uri);
  if (!isOurs(document) || !accepts(document.languageId)) {
    void vscode.window.showInformationMessage(t("Wire EDM: {0} is not of the kind that this command is for.", vscode.workspace.asRelativePath(uri)));
    return undefined;
  }
  return document;
}

export function uriOf(argument: unknown): vscode.Uri | undefined {
  if (argument instanceof vscode.Uri) {
    return argument;
  }
  if (typeof argument === "string") {
    return vscode.Uri.parse(argument, true);
  }
  // What VS Code hands to commands that are called from elsewhere: a URI that has lost its class.
  if (typeof argument === "object" && argument !== null && "scheme" in argument && "path" in argument) {
    return vscode.Uri.from(argument as { scheme: string; path: string });
  }
  return undefined;
}

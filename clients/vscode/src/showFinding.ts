// From a finding under Problems to its place in the picture: VS Code opens the picture for it, and tells no picture what was clicked.

import * as vscode from "vscode";
import { uriOf } from "./commands/subject";
import { faultOf, keyOf } from "./findings";
import { DRAWING } from "./languages";
import type { Pictures } from "./picture/pictures";
import { t } from "../../picture/words";

/** Offers it among the quick fixes of a finding whose drawing is looked at as its picture. */
export function offerToShow(pictures: Pictures): vscode.Disposable {
  const offers: vscode.CodeActionProvider = {
    provideCodeActions({ uri }, _range, { diagnostics }) {
      if (pictures.inFront(uri) === undefined) {
        return [];
      }
      const own = diagnostics.filter(({ source }) => source === "wedm");
      const placed = own.filter((diagnostic) => faultOf(diagnostic, 1).handle !== undefined);
      return placed.map((diagnostic) => {
        const title = t("Show in the Picture");
        const action = new vscode.CodeAction(title, vscode.CodeActionKind.QuickFix);
        action.diagnostics = [diagnostic];
        action.command = { command: "wedm.showFinding", title, arguments: [uri, keyOf(diagnostic)] };
        return action;
      });
    },
  };
  const providedCodeActionKinds = [vscode.CodeActionKind.QuickFix];
  return vscode.languages.registerCodeActionsProvider({ language: DRAWING }, offers, { providedCodeActionKinds });
}

export function showFinding(pictures: Pictures, uri: unknown, key: unknown): void {
  const drawing = uriOf(uri);
  if (drawing !== undefined && typeof key === "string") {
    pictures.inFront(drawing)?.lookAt(key);
  }
}

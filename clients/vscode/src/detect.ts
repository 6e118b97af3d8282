// Programs come as .txt, .cnc, .cmd and .eia, too: such a text is given its language once, when it is opened.
// If the user chooses another one, that stays.

import * as vscode from "vscode";
import { languageOf } from "../../picture/content";

/** Endings under which programs come besides their own. */
const ENDINGS = /\.(txt|cnc|cmd|eia|tap)$/i;
/** The languages that VS Code takes such files for. */
const TAKEN_FOR = ["plaintext", "bat"];
/** Characters that are looked at. */
const HEAD = 64 * 1024;

export function detectPrograms(): vscode.Disposable {
  const seen = new Set<string>();
  const look = (document: vscode.TextDocument): void => {
    const key = document.uri.toString();
    if (!ENDINGS.test(document.uri.path) || !TAKEN_FOR.includes(document.languageId) || seen.has(key)) {
      return;
    }
    seen.add(key);
    const language = languageOf(document.getText(new vscode.Range(0, 0, 400, 0)).slice(0, HEAD));
    if (language !== null) {
      void vscode.languages.setTextDocumentLanguage(document, language);
    }
  };
  vscode.workspace.textDocuments.forEach(look);
  return vscode.workspace.onDidOpenTextDocument(look);
}

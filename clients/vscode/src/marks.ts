// The numbers of the picture's marks, beside the findings in the text of a drawing.

import * as vscode from "vscode";
import { faultOf, findings } from "./findings";
import { isDrawing } from "./languages";
import type { Server } from "./server/server";
import type { Severity } from "../../picture/messages";
import { circled, markNumbers } from "../../picture/numbers";

/** More of them nobody looks for; the picture numbers no more either. */
const MOST = 500;

const COLOURS: Record<Severity, string> = {
  error: "editorError.foreground",
  warning: "editorWarning.foreground",
  information: "editorInfo.foreground",
  hint: "editorHint.foreground",
};

export function numberMarks(server: Server): vscode.Disposable {
  const kind = vscode.window.createTextEditorDecorationType({ rangeBehavior: vscode.DecorationRangeBehavior.ClosedClosed });
  const show = (editor: vscode.TextEditor): void => {
    if (isDrawing(editor.document.languageId)) {
      editor.setDecorations(kind, numbersOf(editor.document));
    }
  };
  return vscode.Disposable.from(
    kind,
    vscode.window.onDidChangeVisibleTextEditors((editors) => {
      editors.forEach(show);
    }),
    server.onDidDiagnose((uri) => {
      vscode.window.visibleTextEditors.filter(({ document }) => document.uri.toString() === uri.toString()).forEach(show);
    }),
  );
}

function numbersOf({ uri }: vscode.TextDocument): vscode.DecorationOptions[] {
  const found = findings(uri);
  const faults = found.map((diagnostic) => faultOf(diagnostic, 1));
  const numbers = markNumbers(faults);
  return found.slice(0, MOST).flatMap(({ range }, index) => {
    const [number, fault] = [numbers[index], faults[index]];
    if (number === undefined || fault === undefined) {
      return [];
    }
    const color = new vscode.ThemeColor(COLOURS[fault.severity]);
    const after = { contentText: circled(number), color, margin: "0 0 0 1ch" };
    return [{ range: new vscode.Range(range.end, range.end), renderOptions: { after } }];
  });
}

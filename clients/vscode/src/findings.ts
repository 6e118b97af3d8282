// The server's findings about a document, as VS Code keeps them.

import * as vscode from "vscode";
import type { Fault } from "../../picture/messages";
import { faultOf as shownFault } from "../../picture/shown";

/** In the order in which the server sent them, by which marks are numbered. */
export function findings(uri: vscode.Uri): vscode.Diagnostic[] {
  return vscode.languages.getDiagnostics(uri).filter(({ source }) => source === "wedm");
}

export function faultOf(diagnostic: vscode.Diagnostic, toMm: number): Fault {
  const { code, severity, message, range } = diagnostic;
  const rule = String((typeof code === "object" ? code.value : code) ?? "");
  // The client keeps the server's `data` on the diagnostics that it makes.
  return shownFault({ severity, rule, message, line: range.start.line, data: (diagnostic as { data?: unknown }).data }, toMm);
}

/** Tells a finding from the others of its document. */
export function keyOf(diagnostic: vscode.Diagnostic): string {
  const { start } = diagnostic.range;
  return [faultOf(diagnostic, 1).rule, start.line, start.character, diagnostic.message].join(" ");
}

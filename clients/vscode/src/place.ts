// Between segments and their places in the text.

import * as vscode from "vscode";
import type { Located } from "../../picture/protocol";
import type { Server } from "./server/server";

/** What is written at a position; null where it is nothing with geometry, or the server cannot answer. */
export async function segmentAt(server: Server, uri: vscode.Uri, position: vscode.Position): Promise<Located | null> {
  try {
    const { line, character } = position;
    return await server.request("wedm/locate", { uri: uri.toString(), position: { line, character } });
  } catch {
    return null;
  }
}

/** Selects a segment in the text, which is brought to the front beside what has the focus. */
export async function reveal(server: Server, uri: vscode.Uri, handle: string, segment: number | undefined, focus: boolean): Promise<void> {
  const located = await server.request("wedm/locate", {
    uri: uri.toString(),
    handle,
    ...(segment === undefined ? {} : { segment }),
  });
  if (located === null) {
    return;
  }
  const { start, end } = located.range;
  await revealRange(uri, new vscode.Range(start.line, start.character, end.line, end.character), focus);
}

export async function revealLine(uri: vscode.Uri, line: number, focus: boolean): Promise<void> {
  const document = await vscode.workspace.openTextDocument(uri);
  if (line < document.lineCount) {
    await revealRange(uri, document.lineAt(line).range, focus);
  }
}

async function revealRange(uri: vscode.Uri, range: vscode.Range, focus: boolean): Promise<void> {
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === uri.toString());
  const editor = await vscode.window.showTextDocument(uri, {
    viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One,
    preserveFocus: !focus,
    preview: false,
  });
  editor.selection = new vscode.Selection(range.start, range.end);
  editor.revealRange(range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
}

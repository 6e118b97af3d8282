// Changes the correction where it is set: in wedm.toml, or in the settings of VS Code.

import * as vscode from "vscode";
import type { Front } from "../front";
import type { SettingsInForce } from "../../../picture/protocol";
import type { Server } from "../server/server";
import { isAboveZero, numberOf } from "./numbers";
import { t } from "../../../picture/words";

const KEYS = /^\s*(corrections?|wire[-_]?diameter|tool[-_]?diameter|gap)\s*=/i;

export async function changeCorrection(server: Server, front: Front): Promise<void> {
  const uri = front.document?.uri ?? vscode.workspace.workspaceFolders?.[0]?.uri;
  let inForce: SettingsInForce | undefined;
  try {
    inForce = uri === undefined ? undefined : await server.request("wedm/settings", { uri: uri.toString() });
  } catch {
    // Without the server the setting can be changed all the same.
  }
  if (inForce?.correctionFrom === "file" && inForce.file !== undefined) {
    await open(vscode.Uri.parse(inForce.file));
  } else if (inForce !== undefined && inForce.corrections.length > 1) {
    await vscode.commands.executeCommand("workbench.action.openSettings", "wedm.passes.corrections");
  } else {
    await ask(inForce?.correction);
  }
}

async function open(file: vscode.Uri): Promise<void> {
  const document = await vscode.workspace.openTextDocument(file);
  const editor = await vscode.window.showTextDocument(document);
  for (let line = 0; line < document.lineCount; line += 1) {
    const text = document.lineAt(line).text;
    if (KEYS.test(text)) {
      const value = /=\s*(\S[^#]*?)\s*(#|$)/.exec(text)?.[1] ?? "";
      const start = text.indexOf(value, text.indexOf("=") + 1);
      editor.selection = new vscode.Selection(line, start, line, start + value.length);
      editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
      return;
    }
  }
}

async function ask(present: number | undefined): Promise<void> {
  const entered = await vscode.window.showInputBox({
    title: t("Correction"),
    prompt: t("How far the wire's centre runs from the contour, in mm: wire radius + spark gap. Empty: the default."),
    value: present === undefined ? "" : String(present),
    validateInput: (text) => (text.trim() === "" || isAboveZero(text) ? null : t("expected a number above 0, in mm")),
  });
  if (entered === undefined) {
    return;
  }
  const hasFolder = (vscode.workspace.workspaceFolders?.length ?? 0) > 0;
  const target = hasFolder ? vscode.ConfigurationTarget.Workspace : vscode.ConfigurationTarget.Global;
  const value = entered.trim() === "" ? undefined : numberOf(entered);
  const settings = vscode.workspace.getConfiguration("wedm");
  await settings.update("correction", value, target);
}

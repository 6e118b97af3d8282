// Shows the pages of a report: in the browser, or here where that does not see the files.

import { randomBytes } from "node:crypto";
import { readFile } from "node:fs/promises";
import * as vscode from "vscode";
import { linked, pageOf } from "./reportPage";
import { t } from "../../../picture/words";

const VIEW_TYPE = "wedm.report";

/** The one report that is shown here. */
let shown: vscode.WebviewPanel | undefined;

export async function showReport(index: vscode.Uri): Promise<void> {
  const isHere = vscode.env.remoteName === undefined && vscode.env.uiKind === vscode.UIKind.Desktop;
  if (!isHere || !(await vscode.env.openExternal(index))) {
    await showHere(index);
  }
}

async function showHere(index: vscode.Uri): Promise<void> {
  shown?.dispose();
  const panel = vscode.window.createWebviewPanel(VIEW_TYPE, t("Report"), vscode.ViewColumn.Active, { enableScripts: true, localResourceRoots: [] });
  shown = panel;
  panel.onDidDispose(() => {
    shown = shown === panel ? undefined : shown;
  });
  const show = async (name: string): Promise<void> => {
    const text = await readFile(vscode.Uri.joinPath(index, "..", name).fsPath, "utf8");
    panel.webview.html = linked(text, randomBytes(16).toString("base64"));
  };
  panel.webview.onDidReceiveMessage(async (message: unknown) => {
    const name = pageOf(message);
    if (name !== null) {
      await show(name).catch((error: unknown) => vscode.window.showErrorMessage(`Wire EDM: ${error instanceof Error ? error.message : String(error)}`));
    }
  });
  await show("index.html");
}

// What the user is told of the server, and what can be done about it.

import * as vscode from "vscode";
import type { Server } from "./server";
import { t } from "../../../picture/words";

const HOW = vscode.Uri.parse("https://github.com/wedm/wedm#install");

/** Reports that the server is not there, once for each reason. */
export function sayWhatFails(server: Server, log: vscode.LogOutputChannel): vscode.Disposable {
  let said = "";
  return server.onDidChangeState(async (state) => {
    if (state.kind === "running") {
      said = "";
    }
    if (state.kind !== "failed" || state.reason === said) {
      return;
    }
    said = state.reason;
    const advice = t("Build it with: cargo install --path . (in the folder of wedm), or set wedm.server.path.");
    const [setting, get, again, showLog] = [t("Choose…"), t("How to Get It"), t("Try Again"), t("Show Log")];
    const missing = state.reason.includes("PATH") || state.reason.includes("wedm.server.path");
    const message = `Wire EDM: ${state.reason}.${missing ? ` ${advice}` : ""}`;
    // More than three do not fit into the notice.
    const ways = state.cure === "program" ? [get, setting, again] : [again, showLog, setting];
    const way = await vscode.window.showErrorMessage(message, ...ways);
    switch (way) {
      case setting:
        await chooseProgram();
        break;
      case get:
        await vscode.env.openExternal(HOW);
        break;
      case again:
        said = "";
        await server.restart();
        break;
      case showLog:
        log.show();
        break;
      case undefined:
      default:
    }
  });
}

/** The change of the setting starts the server. */
async function chooseProgram(): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({ title: t("The program wedm"), canSelectMany: false, openLabel: t("Use This Program") });
  if (chosen?.[0] !== undefined) {
    await vscode.workspace.getConfiguration("wedm").update("server.path", chosen[0].fsPath, vscode.ConfigurationTarget.Global);
  }
}

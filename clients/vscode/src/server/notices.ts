// What the user is told of the server, and what can be done about it.

import * as vscode from "vscode";
import type { Server } from "./server";

const HOW = vscode.Uri.parse("https://github.com/wedm/wedm#install");

const SETTING = "Choose…";
const GET = "How to Get It";
const AGAIN = "Try Again";
const LOG = "Show Log";

/** Says once for each reason that the server is not there. */
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
    const advice = "Build it with: cargo install --path . (in the folder of wedm), or set wedm.server.path.";
    const missing = state.reason.includes("PATH") || state.reason.includes("wedm.server.path");
    const message = `Wire EDM: ${state.reason}.${missing ? ` ${advice}` : ""}`;
    // More than three do not fit into the notice.
    const ways = state.cure === "program" ? [GET, SETTING, AGAIN] : [AGAIN, LOG, SETTING];
    const way = await vscode.window.showErrorMessage(message, ...ways);
    switch (way) {
      case SETTING:
        await chooseProgram();
        break;
      case GET:
        await vscode.env.openExternal(HOW);
        break;
      case AGAIN:
        said = "";
        await server.restart();
        break;
      case LOG:
        log.show();
        break;
      case undefined:
      default:
    }
  });
}

/** The change of the setting starts the server. */
async function chooseProgram(): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({ title: "The program wedm", canSelectMany: false, openLabel: "Use This Program" });
  if (chosen?.[0] !== undefined) {
    await vscode.workspace.getConfiguration("wedm").update("server.path", chosen[0].fsPath, vscode.ConfigurationTarget.Global);
  }
}

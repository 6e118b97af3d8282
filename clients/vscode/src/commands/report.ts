// Makes a report of drawings with `wedm report`, and shows it.

import { isAbsolute, relative } from "node:path";
import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { Server } from "../server/server";
import { askFolder } from "./folder";
import { complaint, type Outcome, optionsFor, programOf, runNoticed } from "./run";
import { saved } from "./saved";
import { showReport } from "./showReport";
import { uriOf } from "./subject";
import { t } from "../../../picture/words";

/** The Explorer hands over what was clicked, and all that is chosen there. */
export async function report(server: Server, front: Front, clicked: unknown, all: unknown): Promise<void> {
  const targets = await targetsOf(front, clicked, all);
  const [first] = targets;
  if (first === undefined) {
    return;
  }
  const odd = targets.find(({ scheme }) => scheme !== "file");
  if (odd !== undefined) {
    const sentence = odd.scheme === "untitled" ? t("Wire EDM: {0} must be saved first.", odd.path) : t("Wire EDM: {0} is not a file on disk.", odd.toString());
    void vscode.window.showErrorMessage(sentence);
    return;
  }
  const program = await programOf(server);
  if (program === undefined) {
    return;
  }
  const folder = await askFolder(t("Make a Report"), proposal(first));
  if (folder === undefined || !(await saved(targets))) {
    return;
  }
  const isOne = targets.length === 1;
  const title = isOne ? t("Making the report of {0}", vscode.workspace.asRelativePath(first)) : t("Making the report of {0} files", targets.length);
  const settings = await optionsFor(server, isOne ? first : vscode.Uri.joinPath(first, ".."));
  const from = (vscode.workspace.getWorkspaceFolder(first)?.uri ?? vscode.Uri.joinPath(first, "..")).fsPath;
  const options = ["report", ...settings, "--output", folder.fsPath, "--", ...targets.map(({ fsPath }) => seenFrom(from, fsPath))];
  const began = Date.now();
  const outcome = await runNoticed(program, options, title, { folder: from });
  if (outcome !== undefined) {
    await tell(outcome, vscode.Uri.joinPath(folder, "index.html"), began);
  }
}

/** Its pages name drawings by the paths that they are asked for by: short ones, from the folder of the workspace. */
function seenFrom(folder: string, path: string): string {
  const short = relative(folder, path) || ".";
  return short.startsWith("..") || isAbsolute(short) ? path : short;
}

async function targetsOf(front: Front, clicked: unknown, all: unknown): Promise<vscode.Uri[]> {
  const chosen = Array.isArray(all) ? all.flatMap((one: unknown) => uriOf(one) ?? []) : [];
  if (chosen.length > 0) {
    return chosen;
  }
  const { document } = front;
  const one = uriOf(clicked) ?? (document !== undefined && isDrawing(document.languageId) ? document.uri : undefined);
  return one === undefined ? await choose() : [one];
}

async function choose(): Promise<vscode.Uri[]> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri;
  const chosen = await vscode.window.showOpenDialog({
    title: t("Make a Report of a File or Folder"),
    openLabel: t("Report"),
    canSelectFiles: true,
    canSelectFolders: true,
    canSelectMany: true,
    ...(folder === undefined ? {} : { defaultUri: folder }),
  });
  return chosen ?? [];
}

/** `report` beside it; within a folder of the workspace, since what is beside that is not seen. */
function proposal(target: vscode.Uri): vscode.Uri {
  const isWhole = vscode.workspace.workspaceFolders?.some(({ uri }) => uri.toString() === target.toString()) ?? false;
  return isWhole ? vscode.Uri.joinPath(target, "report") : vscode.Uri.joinPath(target, "..", "report");
}

/** The pages are also written where drawings have errors, and of the rest where one cannot be read. */
async function tell(outcome: Outcome, index: vscode.Uri, began: number): Promise<void> {
  if (outcome.code !== 0 && outcome.code !== 1) {
    const isWritten = await vscode.workspace.fs.stat(index).then(({ mtime }) => mtime >= began, () => false);
    const show = t("Show the Report");
    if ((await vscode.window.showErrorMessage(complaint("report", outcome), ...(isWritten ? [show] : []))) === show) {
      await showReport(index);
    }
    return;
  }
  await showReport(index);
  const name = vscode.workspace.asRelativePath(index);
  if (outcome.code === 0) {
    void vscode.window.showInformationMessage(t("Wire EDM: the report is written: {0}.", name));
  } else {
    void vscode.window.showWarningMessage(t("Wire EDM: the report is written: {0}. There are errors in a drawing.", name));
  }
}

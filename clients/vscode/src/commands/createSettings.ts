// Makes the wedm.toml of a folder with `wedm init`, or opens the one that is there.

import * as vscode from "vscode";
import type { Front } from "../front";
import type { Server } from "../server/server";
import { folderOf, isThere } from "./folder";
import { type Answers, GAP, initOptions, isPasses, WIRE } from "./init";
import { isAboveZero, numberOf } from "./numbers";
import { machines } from "../../../picture/profiles";
import { complaint, programOf, run } from "./run";
import { settingsThere } from "./settingsFile";
import { uriOf } from "./subject";
import { t } from "../../../picture/words";

/** The number of questions. */
const STEPS = 4;

/** With a `table`, the file is opened at its head. */
export async function createSettings(server: Server, front: Front, argument: unknown, table: unknown): Promise<void> {
  const uri = uriOf(argument) ?? front.document?.uri;
  const folder = await folderFor(uri);
  if (folder === undefined) {
    return;
  }
  const target = vscode.Uri.joinPath(folder, "wedm.toml");
  const there = (await holding(server, uri)) ?? ((await isThere(target)) ? target : undefined);
  if (there !== undefined) {
    await open(there, table);
    return;
  }
  const program = await programOf(server);
  if (program === undefined) {
    return;
  }
  const answers = await ask();
  if (answers === undefined) {
    return;
  }
  const outcome = await run(program, initOptions(answers, folder.fsPath));
  if (outcome.code !== 0) {
    void vscode.window.showErrorMessage(complaint("init", outcome));
    return;
  }
  await open(target, table);
}

/** The workspace's folder that the document lies in, or the document's own; without a document, one of the workspace. */
async function folderFor(uri: vscode.Uri | undefined): Promise<vscode.Uri | undefined> {
  const folder = uri === undefined ? await onlyFolder() : (vscode.workspace.getWorkspaceFolder(uri)?.uri ?? folderOf(uri));
  if (folder === undefined) {
    void vscode.window.showInformationMessage(t("Wire EDM: open a folder or a drawing first."));
  } else if (folder.scheme !== "file") {
    void vscode.window.showErrorMessage(t("Wire EDM: {0} is not a folder on disk.", folder.toString()));
    return undefined;
  }
  return folder;
}

async function onlyFolder(): Promise<vscode.Uri | undefined> {
  const folders = vscode.workspace.workspaceFolders ?? [];
  return (folders.length > 1 ? await vscode.window.showWorkspaceFolderPick() : folders[0])?.uri;
}

/** The file that holds for the document. A server that does not run cannot say. */
async function holding(server: Server, uri: vscode.Uri | undefined): Promise<vscode.Uri | undefined> {
  try {
    return uri === undefined ? undefined : await settingsThere(server, uri);
  } catch {
    return undefined;
  }
}

async function ask(): Promise<Answers | undefined> {
  const set = vscode.workspace.getConfiguration("wedm");
  const proposed = (key: string, otherwise: number): number => set.get<number | null>(key, null) ?? otherwise;
  const length = t("expected a number above 0, in mm");
  const wire = await askNumber(1, t("Diameter of the wire, mm"), proposed("wireDiameter", WIRE), isAboveZero, length);
  if (wire === undefined) {
    return undefined;
  }
  const gap = await askNumber(2, t("Spark gap, mm; with several passes that of the rough one"), proposed("gap", GAP), isAboveZero, length);
  if (gap === undefined) {
    return undefined;
  }
  const passes = await askNumber(3, t("Passes along each contour"), 1, isPasses, t("expected a whole number from 1 to 9"));
  if (passes === undefined) {
    return undefined;
  }
  const how = { title: titleOf(STEPS), placeHolder: t("What the machine reads"), matchOnDetail: true, ignoreFocusOut: true };
  const machine = await vscode.window.showQuickPick(machines(), how);
  return machine && { wire, gap, passes, machine: machine.profile };
}

function titleOf(step: number): string {
  return t("Create wedm.toml ({0}/{1})", step, STEPS);
}

async function askNumber(
  step: number,
  prompt: string,
  proposed: number,
  fits: (text: string) => boolean,
  expected: string,
): Promise<number | undefined> {
  const validateInput = (text: string): string | null => (fits(text) ? null : expected);
  const title = titleOf(step);
  const entered = await vscode.window.showInputBox({ title, prompt, value: String(proposed), validateInput, ignoreFocusOut: true });
  return entered === undefined ? undefined : numberOf(entered);
}

async function open(file: vscode.Uri, table: unknown): Promise<void> {
  const document = await vscode.workspace.openTextDocument(file);
  const editor = await vscode.window.showTextDocument(document, { preview: false });
  const lines = document.getText().split(/\r?\n/);
  const head = typeof table === "string" ? lines.indexOf(`[${table}]`) : -1;
  if (head >= 0) {
    editor.selection = new vscode.Selection(head, 0, head, 0);
    editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenter);
  }
}

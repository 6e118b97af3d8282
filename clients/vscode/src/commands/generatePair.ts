// Writes the program of each part of a pair to a folder of the user's choice.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { Pictures } from "../picture/pictures";
import type { PairProgram } from "../../../picture/protocol";
import type { Server } from "../server/server";
import { attempt } from "./attempt";
import { ENDINGS, type Format, TITLES } from "../../../picture/programs";
import { findingsOf } from "../../../picture/counted";
import { askFolder, folderOf, isThere } from "./folder";
import { openMade, write } from "./output";
import { partFile, toldOfPart } from "../../../picture/parts";
import { offerToKeep } from "./sides";
import { subject } from "./subject";
import { t } from "../../../picture/words";

/** A wire cuts a pair; nothing of it is milled. */
const FORMATS: readonly Format[] = ["3b", "4b", "iso"];

export async function generatePair(server: Server, front: Front, pictures: Pictures, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  const format = document && (await askFormat());
  if (document === undefined || format === undefined) {
    return;
  }
  const { uri } = document;
  const attempted = await attempt(server, pictures, { method: "wedm/pair", uri, format });
  if (attempted === undefined) {
    return;
  }
  const { programs } = attempted.made;
  const folder = await askFolder(t("Save the Programs of the Pair"), folderOf(uri));
  const targets = folder && (await targetsOf(uri, folder, programs, format));
  if (targets === undefined) {
    return;
  }
  for (const [target, { program }] of targets) {
    await write(target, program);
  }
  const first = targets.keys().next().value;
  if (first !== undefined) {
    await openMade(document, first);
  }
  void vscode.window.showInformationMessage(told(programs, format));
  if (attempted.sides !== undefined) {
    await offerToKeep(server, uri, attempted.sides, false);
  }
}

async function askFormat(): Promise<Format | undefined> {
  const offered = FORMATS.map((format) => ({ label: TITLES[format](), format }));
  const title = t("The Programs of the Pair");
  const chosen = await vscode.window.showQuickPick(offered, { title, placeHolder: t("What the machine reads") });
  return chosen?.format;
}

/** A file for each part; undefined where the user does not want to lose what is there. */
async function targetsOf(
  uri: vscode.Uri,
  folder: vscode.Uri,
  programs: readonly PairProgram[],
  format: Format,
): Promise<Map<vscode.Uri, PairProgram> | undefined> {
  const stem = (uri.path.split("/").pop() ?? "").replace(/\.[^.]*$/, "");
  const names = programs.map(({ part }) => partFile(stem, part, ENDINGS[format][0]));
  const plain = names.map((name) => name.toLowerCase());
  const twice = names.find((_name, index) => plain.indexOf(plain[index] ?? "") < index);
  if (twice !== undefined) {
    void vscode.window.showErrorMessage(t("Wire EDM: two parts would be written to {0}: give them other names.", twice));
    return undefined;
  }
  const files = names.map((name) => vscode.Uri.joinPath(folder, name));
  const there = await Promise.all(files.map(isThere));
  const old = names.filter((_name, index) => there[index]);
  if (old.length > 0) {
    const overwrite = t("Overwrite");
    const question = old.length === 1 ? t("{0} is there already. Overwrite it?", old.join(", ")) : t("{0} are there already. Overwrite them?", old.join(", "));
    if ((await vscode.window.showWarningMessage(question, { modal: true, detail: folder.fsPath }, overwrite)) !== overwrite) {
      return undefined;
    }
  }
  return new Map(files.flatMap((file, index) => (programs[index] === undefined ? [] : [[file, programs[index]]])));
}

/** What stands in the drawing is told once: it is the same for every part, but for what a part is checked against alone. */
function told(programs: readonly PairProgram[], format: Format): string {
  const findings = Math.max(0, ...programs.map(({ warnings }) => warnings.length));
  return t("{0}: {1}.", TITLES[format](), programs.map(toldOfPart).join(t("; "))) + findingsOf(findings);
}

// Writes the program of a drawing to a file of the user's choice.

import * as vscode from "vscode";
import { LSPErrorCodes, ResponseError } from "vscode-languageclient/node";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { Milling, Program } from "../protocol";
import type { Server } from "../server/server";
import { write } from "./output";
import type { Pictures } from "../picture/pictures";
import type { Sides } from "./keep";
import { choices } from "./profiles";
import { askSides, offerToKeep } from "./sides";
import { subject } from "./subject";
import { t } from "../words";

export type Format = "3b" | "4b" | "iso" | "milling";

/** Functions, since the language is not chosen yet when this is read. */
const TITLES: Record<Format, () => string> = { "3b": () => "3B", "4b": () => "4B", iso: () => "ISO", milling: () => t("Milling") };
/** The endings of its files; the first is proposed. */
const ENDINGS: Record<Format, readonly [string, ...string[]]> = { "3b": ["3b"], "4b": ["4b"], iso: ["iso", "nc"], milling: ["iso", "nc"] };

/** The number of slugs that are named. */
const SLUGS = 4;

interface How {
  options?: { program?: { profile: string } };
  /** The user's answers for contours that no setting covers. */
  sides?: Sides;
  force?: boolean;
}

export async function generate(server: Server, front: Front, pictures: Pictures, format: Format, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const how = format === "iso" ? await chooseProfile(document) : {};
  if (how === undefined) {
    return;
  }
  const made = await attempt(server, pictures, document, format, how);
  if (made === undefined) {
    return;
  }
  const { generated } = made;
  const stem = document.uri.path.replace(/\.[^./]*$/, "");
  const target = await vscode.window.showSaveDialog({
    title: t("Save the {0} Program", TITLES[format]()),
    defaultUri: document.uri.with({ scheme: document.uri.scheme === "untitled" ? "file" : document.uri.scheme, path: `${stem}.${ENDINGS[format][0]}` }),
    filters: { [t("{0} program", TITLES[format]())]: [...ENDINGS[format]] },
  });
  if (target === undefined) {
    return;
  }
  await write(target, generated.program);
  // Where the drawing stands, so that its picture beside it becomes that of the program.
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
  await vscode.window.showTextDocument(target, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.Active, preview: false });
  void vscode.window.showInformationMessage(`${TITLES[format]()}: ${told(generated, format)}`);
  if (made.how.sides !== undefined) {
    await offerToKeep(server, document.uri, made.how.sides, format === "milling");
  }
}

async function chooseProfile(document: vscode.TextDocument): Promise<How | undefined> {
  const settings = vscode.workspace.getConfiguration("wedm", document);
  const own = Object.keys(settings.get<object | null>("profiles", null) ?? {});
  const offered = choices(settings.get<string | null>("program.profile", null), own);
  const placeHolder = t("How the ISO program is written");
  const chosen = await vscode.window.showQuickPick(offered, { title: t("Profile"), placeHolder, matchOnDetail: true });
  if (chosen === undefined) {
    return undefined;
  }
  return chosen.profile === undefined ? {} : { options: { program: { profile: chosen.profile } } };
}

interface Made {
  generated: Program;
  how: How;
}

/** Asks, and asks again as the user answers, until there is a program or they give up. */
async function attempt(
  server: Server,
  pictures: Pictures,
  document: vscode.TextDocument,
  format: Format,
  how: How,
): Promise<Made | undefined> {
  const uri = document.uri.toString();
  const options = { ...how.options, ...how.sides };
  try {
    const generated = await vscode.window.withProgress(
      { location: vscode.ProgressLocation.Window, title: t("Wire EDM: generating {0}", TITLES[format]()) },
      (_progress, token) => server.request("wedm/generate", { uri, format, options, ...(how.force === true ? { force: true } : {}) }, token),
    );
    return { generated, how };
  } catch (error) {
    const next = await answer(error, how, () => askSides(server, pictures, document.uri, format === "milling"));
    return next === undefined ? undefined : attempt(server, pictures, document, format, next);
  }
}

async function answer(error: unknown, how: How, ask: () => Promise<Sides | undefined>): Promise<How | undefined> {
  if (!(error instanceof ResponseError)) {
    void vscode.window.showErrorMessage(`Wire EDM: ${error instanceof Error ? error.message : String(error)}`);
    return undefined;
  }
  if (error.code === LSPErrorCodes.ContentModified) {
    return how;
  }
  const sentence = t("No program: {0}.", error.message);
  if (error.code !== LSPErrorCodes.RequestFailed) {
    void vscode.window.showErrorMessage(sentence);
    return undefined;
  }
  if (how.sides === undefined && /side of contour .* is not known|不知道轮廓 .* 的补偿方向/.test(error.message)) {
    const sides = await ask();
    return sides === undefined ? undefined : { ...how, sides };
  }
  const listed = (error.data as { diagnostics?: unknown[] } | undefined)?.diagnostics ?? [];
  const canBeForced = listed.length > 0 && how.force !== true;
  const [problems, force] = [t("Show Problems"), t("Generate All the Same")];
  switch (await vscode.window.showErrorMessage(sentence, ...(canBeForced ? [problems, force] : [problems]))) {
    case problems:
      await vscode.commands.executeCommand("workbench.actions.view.problems");
      return undefined;
    case force:
      return { ...how, force: true };
    case undefined:
    default:
      return undefined;
  }
}

function told(generated: Program, format: Format): string {
  const blocks = generated.blocks === 1 ? t("1 block") : t("{0} blocks", generated.blocks);
  const path = t("cut {0} mm, jumps {1} mm, decoded again at most {2} µm from the path", generated.length.toFixed(1), (generated.jumps ?? 0).toFixed(1), generated.deviation.toFixed(2));
  // A drift that rounds to zero has no sign.
  const [x, y] = [generated.closure.x, generated.closure.y].map((drift) => (Math.round(drift * 100) / 100 + 0).toFixed(2));
  const drift = ENDINGS[format][0] === "iso" ? "" : t("; rounding of J, added up: {0}, {1} µm", x ?? "", y ?? "");
  const minutes = generated.minutes === undefined ? "" : t("; {0} minutes on the machine", generated.minutes.toFixed(1));
  const milled = generated.milling === undefined ? "" : toldOfMilling(generated.milling);
  const slugs = (generated.work?.slugs ?? []).map(({ contour, mass }) => t("{0}: {1} g", contour, mass.toFixed(1)));
  const drops = slugs.length === 0 ? "" : t("; what drops out: {0}", slugs.slice(0, SLUGS).join(", ") + (slugs.length > SLUGS ? ", …" : ""));
  const { length } = generated.warnings;
  const stand = length === 1 ? t(" The drawing has 1 finding.") : t(" The drawing has {0} findings.", length);
  const warnings = length === 0 ? "" : stand;
  return t("{0}, {1}{2}.", blocks, path, drift + minutes + milled + drops) + warnings;
}

/** With several contours the floor is that of all of them, and the wear of the electrode that after the last one. */
function toldOfMilling({ layers, layer, contours }: Milling): string {
  const floors = contours.map(({ floor }) => floor);
  const [least, most] = [Math.min(...floors.map(({ least }) => least)), Math.max(...floors.map(({ most }) => most))];
  const worn = contours.at(-1)?.worn ?? 0;
  const figures = [least, most, worn].map((mm) => mm.toFixed(4));
  return t("; {0} layers of {1} mm; simulated: the floor {2} to {3} mm deep, the electrode {4} mm shorter", layers, layer, ...figures);
}

// Writes the program of a drawing to a file of the user's choice.

import * as vscode from "vscode";
import { ResponseError } from "vscode-languageclient/node";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import { CONTENT_MODIFIED, type Format, type Generated, REFUSED } from "../protocol";
import type { Server } from "../server/server";
import { write } from "./output";
import { choices } from "./profiles";
import { subject } from "./subject";

const TITLES: Record<Format, string> = { "3b": "3B", "4b": "4B", iso: "ISO" };
const PROBLEMS = "Show Problems";
const FORCE = "Generate All the Same";
const INSIDE = "Opening: Wire Inside";
const OUTSIDE = "Punch: Wire Outside";

interface How {
  options?: { side?: "opening" | "punch"; program?: { profile: string } };
  force?: boolean;
}

export async function generate(server: Server, front: Front, format: Format, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const how = format === "iso" ? await chooseProfile(document) : {};
  if (how === undefined) {
    return;
  }
  const generated = await attempt(server, document, format, how);
  if (generated === undefined) {
    return;
  }
  const stem = document.uri.path.replace(/\.[^./]*$/, "");
  const target = await vscode.window.showSaveDialog({
    title: `Save the ${TITLES[format]} Program`,
    defaultUri: document.uri.with({ scheme: document.uri.scheme === "untitled" ? "file" : document.uri.scheme, path: `${stem}.${format}` }),
    filters: { [`${TITLES[format]} program`]: format === "iso" ? ["iso", "nc"] : [format] },
  });
  if (target === undefined) {
    return;
  }
  await write(target, generated.program);
  // Where the drawing stands, so that its picture beside it becomes that of the program.
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
  await vscode.window.showTextDocument(target, { viewColumn: shown?.viewColumn ?? vscode.ViewColumn.Active, preview: false });
  void vscode.window.showInformationMessage(`${TITLES[format]}: ${told(generated)}`);
}

async function chooseProfile(document: vscode.TextDocument): Promise<How | undefined> {
  const settings = vscode.workspace.getConfiguration("wedm", document);
  const own = Object.keys(settings.get<object | null>("profiles", null) ?? {});
  const offered = choices(settings.get<string | null>("program.profile", null), own);
  const placeHolder = "How the ISO program is written";
  const chosen = await vscode.window.showQuickPick(offered, { title: "Profile", placeHolder, matchOnDetail: true });
  if (chosen === undefined) {
    return undefined;
  }
  return chosen.profile === undefined ? {} : { options: { program: { profile: chosen.profile } } };
}

/** Asks, and asks again as the user answers, until there is a program or they give up. */
async function attempt(server: Server, document: vscode.TextDocument, format: Format, how: How): Promise<Generated | undefined> {
  try {
    return await vscode.window.withProgress(
      { location: vscode.ProgressLocation.Window, title: `Wire EDM: generating ${TITLES[format]}` },
      (_progress, token) => server.request("wedm/generate", { uri: document.uri.toString(), format, ...how }, token),
    );
  } catch (error) {
    const next = await answer(error, how);
    return next === undefined ? undefined : attempt(server, document, format, next);
  }
}

async function answer(error: unknown, how: How): Promise<How | undefined> {
  if (!(error instanceof ResponseError)) {
    void vscode.window.showErrorMessage(`Wire EDM: ${error instanceof Error ? error.message : String(error)}`);
    return undefined;
  }
  if (error.code === CONTENT_MODIFIED) {
    return how;
  }
  const sentence = `No program: ${error.message}.`;
  if (error.code !== REFUSED) {
    void vscode.window.showErrorMessage(sentence);
    return undefined;
  }
  if (how.options?.side === undefined && /side of contour .* is not known/.test(error.message)) {
    const side = await vscode.window.showWarningMessage(sentence, { modal: false }, INSIDE, OUTSIDE);
    return side === undefined ? undefined : { ...how, options: { ...how.options, side: side === INSIDE ? "opening" : "punch" } };
  }
  const listed = (error.data as { diagnostics?: unknown[] } | undefined)?.diagnostics ?? [];
  const canBeForced = listed.length > 0 && how.force !== true;
  switch (await vscode.window.showErrorMessage(sentence, ...(canBeForced ? [PROBLEMS, FORCE] : [PROBLEMS]))) {
    case PROBLEMS:
      await vscode.commands.executeCommand("workbench.actions.view.problems");
      return undefined;
    case FORCE:
      return { ...how, force: true };
    case undefined:
    default:
      return undefined;
  }
}

function told(generated: Generated): string {
  const blocks = generated.blocks === 1 ? "1 block" : `${generated.blocks} blocks`;
  const minutes = generated.minutes === undefined ? "" : `, about ${generated.minutes.toFixed(0)} min`;
  const { x, y } = generated.closure;
  const warnings = generated.warnings.length === 0 ? "" : ` ${generated.warnings.length} warnings stand in the drawing.`;
  return `${blocks}, wire path ${generated.length.toFixed(3)} mm${minutes}; a controller that counts drifts by ${x.toFixed(2)}, ${y.toFixed(2)} µm.${warnings}`;
}

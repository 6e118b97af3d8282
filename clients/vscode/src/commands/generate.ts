// Writes the program of a drawing to a file of the user's choice.

import * as vscode from "vscode";
import type { Front } from "../front";
import { isDrawing } from "../languages";
import type { Milling, Program } from "../../../picture/protocol";
import type { Server } from "../server/server";
import type { Pictures } from "../picture/pictures";
import { attempt, ENDINGS, type Format, TITLES } from "./attempt";
import { openMade, write } from "./output";
import { offerToKeep } from "./sides";
import { blocksOf, findingsOf } from "../../../picture/counted";
import { subject } from "./subject";
import { t } from "../../../picture/words";

/** The number of slugs that are named. */
const SLUGS = 4;

export async function generate(server: Server, front: Front, pictures: Pictures, format: Format, argument: unknown): Promise<void> {
  const document = await subject(front, argument, isDrawing);
  if (document === undefined) {
    return;
  }
  const attempted = await attempt(server, pictures, { method: "wedm/generate", uri: document.uri, format });
  if (attempted === undefined) {
    return;
  }
  const { made, sides } = attempted;
  const stem = document.uri.path.replace(/\.[^./]*$/, "");
  const target = await vscode.window.showSaveDialog({
    title: t("Save the {0} Program", TITLES[format]()),
    defaultUri: document.uri.with({ scheme: document.uri.scheme === "untitled" ? "file" : document.uri.scheme, path: `${stem}.${ENDINGS[format][0]}` }),
    filters: { [t("{0} program", TITLES[format]())]: [...ENDINGS[format]] },
  });
  if (target === undefined) {
    return;
  }
  await write(target, made.program);
  await openMade(document, target);
  void vscode.window.showInformationMessage(`${TITLES[format]()}: ${told(made, format)}`);
  if (sides !== undefined) {
    await offerToKeep(server, document.uri, sides, format === "milling");
  }
}

function told(generated: Program, format: Format): string {
  const path = t("cut {0} mm, jumps {1} mm, decoded again at most {2} µm from the path", generated.length.toFixed(1), (generated.jumps ?? 0).toFixed(1), generated.deviation.toFixed(2));
  // A drift that rounds to zero has no sign.
  const [x, y] = [generated.closure.x, generated.closure.y].map((drift) => (Math.round(drift * 100) / 100 + 0).toFixed(2));
  const drift = ENDINGS[format][0] === "iso" ? "" : t("; rounding of J, added up: {0}, {1} µm", x ?? "", y ?? "");
  const minutes = generated.minutes === undefined ? "" : t("; {0} minutes on the machine", generated.minutes.toFixed(1));
  const milled = generated.milling === undefined ? "" : toldOfMilling(generated.milling);
  const slugs = (generated.work?.slugs ?? []).map(({ contour, mass }) => t("{0}: {1} g", contour, mass.toFixed(1)));
  const drops = slugs.length === 0 ? "" : t("; what drops out: {0}", slugs.slice(0, SLUGS).join(", ") + (slugs.length > SLUGS ? ", …" : ""));
  return t("{0}, {1}{2}.", blocksOf(generated.blocks), path, drift + minutes + milled + drops) + findingsOf(generated.warnings.length);
}

/** With several contours the floor is that of all of them, and the wear of the electrode that after the last one. */
function toldOfMilling({ layers, layer, contours }: Milling): string {
  const floors = contours.map(({ floor }) => floor);
  const [least, most] = [Math.min(...floors.map(({ least }) => least)), Math.max(...floors.map(({ most }) => most))];
  const worn = contours.at(-1)?.worn ?? 0;
  const figures = [least, most, worn].map((mm) => mm.toFixed(4));
  return t("; {0} layers of {1} mm; simulated: the floor {2} to {3} mm deep, the electrode {4} mm shorter", layers, layer, ...figures);
}

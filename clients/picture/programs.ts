// What programs are written in, and what one comes to, in a sentence.

import { blocksOf, findingsOf } from "./counted";
import type { Milling, Program } from "./protocol";
import { t } from "./words";

export type Format = "3b" | "4b" | "iso" | "milling";

/** Functions, since the language is not chosen yet when this is read. */
export const TITLES: Record<Format, () => string> = { "3b": () => "3B", "4b": () => "4B", iso: () => "ISO", milling: () => t("Milling") };
/** The endings of its files; the first is proposed. */
export const ENDINGS: Record<Format, readonly [string, ...string[]]> = { "3b": ["3b"], "4b": ["4b"], iso: ["iso", "nc"], milling: ["iso", "nc"] };

/** The number of slugs that are named. */
const SLUGS = 4;

export function told(generated: Program, format: Format): string {
  const path = t("cut {0} mm, jumps {1} mm, decoded again at most {2} µm from the path", generated.length.toFixed(1), (generated.jumps ?? 0).toFixed(1), generated.deviation.toFixed(2));
  // A drift that rounds to zero has no sign.
  const [x, y] = [generated.closure.x, generated.closure.y].map((drift) => (Math.round(drift * 100) / 100 + 0).toFixed(2));
  const drift = ENDINGS[format][0] === "iso" ? "" : t("; rounding of J, added up: {0}, {1} µm", x ?? "", y ?? "");
  const chords = generated.offChords === undefined ? "" : t("; chords of the drawing are cut as arcs, at most {0} µm from the outline", generated.offChords.toFixed(2));
  const minutes = generated.minutes === undefined ? "" : t("; {0} minutes on the machine", generated.minutes.toFixed(1));
  const milled = generated.milling === undefined ? "" : toldOfMilling(generated.milling);
  const slugs = (generated.work?.slugs ?? []).map(({ contour, mass }) => t("{0}: {1} g", contour, mass.toFixed(1)));
  const drops = slugs.length === 0 ? "" : t("; what drops out: {0}", slugs.slice(0, SLUGS).join(", ") + (slugs.length > SLUGS ? ", …" : ""));
  const alone = (generated.unattended ?? []).map((sentence) => `; ${sentence}`).join("");
  return t("{0}, {1}{2}.", blocksOf(generated.blocks), path, drift + chords + minutes + milled + drops + alone) + findingsOf(generated.warnings.length);
}

/** With several contours the floor is that of all of them, and the wear of the electrode that after the last one. */
function toldOfMilling({ layers, layer, contours }: Milling): string {
  const floors = contours.map(({ floor }) => floor);
  const [least, most] = [Math.min(...floors.map(({ least }) => least)), Math.max(...floors.map(({ most }) => most))];
  const worn = contours.at(-1)?.worn ?? 0;
  const figures = [least, most, worn].map((mm) => mm.toFixed(4));
  return t("; {0} layers of {1} mm; simulated: the floor {2} to {3} mm deep, the electrode {4} mm shorter", layers, layer, ...figures);
}

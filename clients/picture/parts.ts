// The parts of a pair: what each is called, and its file. Knows nothing of VS Code.

import type { PairProgram } from "./protocol";
import { blocksOf } from "./counted";
import { t } from "./words";

/** `washer-punch.3b`, as `wedm pair` names it; characters that a file name cannot hold become `_`. */
export function partFile(stem: string, part: string, ending: string): string {
  return `${stem}-${part.replace(/[^\p{Alphabetic}\p{N}_.-]/gu, "_")}.${ending}`;
}

/** The four parts of a tool have names in every language; a workpiece has the one that it was given. */
function titleOf(part: string): string {
  const known = new Map([
    ["punch", t("punch")],
    ["plate", t("plate")],
    ["stripper", t("stripper")],
    ["holder", t("holder")],
  ]);
  return known.get(part) ?? part;
}

/** What was written for one part, in the figures of `wedm pair`. */
export function toldOfPart({ part, corrections, otherSide, blocks, length, jumps = 0 }: PairProgram): string {
  const each = corrections.map((correction) => correction.toFixed(4)).join(" / ");
  const lengths = jumps === 0 ? t("cut {0} mm", length.toFixed(1)) : t("cut {0} mm, jumps {1} mm", length.toFixed(1), jumps.toFixed(1));
  const side = otherSide ? t(", the wire on what is drawn or on its other side") : "";
  return t("{0}: correction {1} mm{2}, {3}, {4}", titleOf(part), each, side, blocksOf(blocks), lengths);
}

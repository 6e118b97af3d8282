// The numbers of marks: the same in the picture, in every list beside it and in the report.

import type { Fault } from "./messages";

/** Rules whose hints are about a single place, and so have a mark. */
const OF_ONE_PLACE = ["near-tangent", "arc-as-chords"];

/**
 * The number of the mark of each finding, from 1, as the server counts them: arcs that are too tight come first, then the other findings
 * about a segment. Undefined where a finding has no mark.
 */
export function markNumbers(faults: readonly Pick<Fault, "rule" | "severity" | "segment" | "left">[]): (number | undefined)[] {
  let tight = 0;
  let others = faults.filter(({ rule }) => rule === "small-radius").length;
  return faults.map(({ rule, severity, segment, left }, index) => {
    // The places of a fit, the tightest first.
    if (left !== undefined) {
      return index + 1;
    }
    if (rule === "small-radius") {
      tight += 1;
      return tight;
    }
    const isMarked = segment !== undefined && (severity === "error" || severity === "warning" || OF_ONE_PLACE.includes(rule));
    others += isMarked ? 1 : 0;
    return isMarked ? others : undefined;
  });
}

/** A number as a list of plain text shows it, like the mark in the picture: ① to ⑳, then (21). */
export function circled(number: number): string {
  return number <= 20 ? String.fromCodePoint(0x2460 + number - 1) : `(${number})`;
}

import assert from "node:assert/strict";
import { test } from "node:test";
import type { Fault } from "../../../picture/messages";
import { circled, markNumbers } from "../../../picture/numbers";

const fault = (rule: string, severity: Fault["severity"], segment?: number): Fault => ({ rule, severity, message: "", ...(segment === undefined ? {} : { segment }) });

test("arcs that are too tight are counted first, then what else is about a segment", () => {
  const faults = [
    fault("units", "information"),
    fault("sharp-corner", "hint", 0),
    fault("gap", "error", 1),
    fault("small-radius", "error", 2),
    fault("near-tangent", "hint", 3),
    fault("small-radius", "error", 4),
    fault("open-contour", "error"),
  ];
  assert.deepEqual(markNumbers(faults), [undefined, undefined, 3, 1, 4, 2, undefined]);
  assert.deepEqual(markNumbers([]), []);
});

test("the places of a fit are counted as they are listed", () => {
  const place = { ...fault("does-not-fit", "error", 2), left: "0.0010 mm left" };
  assert.deepEqual(markNumbers([place, place]), [1, 2]);
});

test("in a list of plain text a number looks like its mark as far as there are such signs", () => {
  assert.deepEqual([1, 20, 21].map(circled), ["①", "⑳", "(21)"]);
});

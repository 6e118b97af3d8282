import assert from "node:assert/strict";
import { test } from "node:test";
import { inShort } from "../../src/inShort";

test("what a drawing is checked against is said in short, and where the correction comes from", () => {
  const base = { correction: 0.1, correctionFrom: "default", corrections: [0.1], side: "both", unitsToMm: 1 } as const;
  const check = (inForce: Partial<Parameters<typeof inShort>[0]>, expected: string): void => {
    assert.equal(inShort({ ...base, ...inForce }), expected);
  };
  check({}, "0.100 mm (default), both sides, drawn in mm");
  check({ correctionFrom: "client", side: "auto", unitsToMm: 25.4 }, "0.100 mm (VS Code settings), by nesting, drawn in inches");
  check({ correctionFrom: "file", corrections: [0.2, 0.14, 0.11], correction: 0.2, side: "punch" }, "0.200 mm · 3 passes (wedm.toml), punch, drawn in mm");
  check({ unitsToMm: 1000 }, "0.100 mm (default), both sides, drawn in units of 1000 mm");
  // A program has no unit of a drawing.
  check({ unitsToMm: undefined }, "0.100 mm (default), both sides");
});

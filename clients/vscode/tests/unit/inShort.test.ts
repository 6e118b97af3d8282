import assert from "node:assert/strict";
import { test } from "node:test";
import { inShort } from "../../src/inShort";

test("what a drawing is checked against is said in short, and where the correction comes from", () => {
  type InForce = Parameters<typeof inShort>[0];
  const ofProgram: InForce = { correction: 0.1, correctionFrom: "default", corrections: [0.1], side: "both" };
  const check = (inForce: Partial<InForce>, expected: string): void => {
    assert.equal(inShort({ ...ofProgram, unitsToMm: 1, ...inForce }), expected);
  };
  check({}, "0.100 mm (default), both sides, drawn in mm");
  check({ correctionFrom: "client", side: "auto", unitsToMm: 25.4 }, "0.100 mm (VS Code settings), by nesting, drawn in inches");
  check({ correctionFrom: "file", corrections: [0.2, 0.14, 0.11], correction: 0.2, side: "punch" }, "0.200 mm · 3 passes (wedm.toml), punch, drawn in mm");
  check({ unitsToMm: 1000 }, "0.100 mm (default), both sides, drawn in units of 1000 mm");
  assert.equal(inShort(ofProgram), "0.100 mm (default), both sides");
});

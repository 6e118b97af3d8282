import assert from "node:assert/strict";
import { test } from "node:test";
import { answersOf, correctionsOf, withAnswers } from "../../src/settings";

const NEW = answersOf("");

test("the form of a folder without settings writes wire, gap and machine", () => {
  assert.equal(withAnswers("", { ...NEW, wire: "0.2" }), "wire-diameter = 0.2\ngap = 0.01\n");
  const robofil = withAnswers("", { ...NEW, wire: "0.25", gap: "0.03", passes: 3, machine: "robofil" });
  assert.equal(robofil, `wire-diameter = 0.25
gap = 0.03

[passes]
corrections = [0.2150, 0.1700, 0.1400]
gaps = [0.0300, 0.0150, 0.0150]

[program]
format = "iso"
profile = "robofil"
`);
});

test("what is not asked stays as it is written", () => {
  const text = '# ours\ngap = 0.02 # measured\n\n[program]\nlead-in = 2\n\n[layers]\nFRAME = "ignore"\n';
  const after = withAnswers(text, { ...answersOf(text), side: "punch" });
  assert.equal(after, '# ours\ngap = 0.02 # measured\nwire-diameter = 0.18\nside = "punch"\n\n[program]\nlead-in = 2\n\n[layers]\nFRAME = "ignore"\n');
});

test("answers are read back as they were given", () => {
  const given = { wire: "0.2", gap: "0.015", passes: 2, machine: "generic", side: "opening", thickness: "40", drawnAs: "punch", clearance: "0.01" };
  assert.deepEqual(answersOf(withAnswers("", given)), given);
  const back = withAnswers(withAnswers("", given), { ...given, passes: 1, machine: "3b", side: "", thickness: "", drawnAs: "", clearance: "" });
  assert.equal(back, 'wire-diameter = 0.2\ngap = 0.015\n\n[program]\nformat = "3b"\n');
});

test("corrections fall from pass to pass", () => {
  assert.deepEqual(correctionsOf(0.18, 0.01, 1), [0.09 + 0.01]);
  assert.deepEqual(correctionsOf(0.2, 0.02, 3).map((mm) => mm.toFixed(4)), ["0.1800", "0.1400", "0.1100"]);
});

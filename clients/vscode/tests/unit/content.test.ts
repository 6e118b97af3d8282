import assert from "node:assert/strict";
import { test } from "node:test";
import { cases } from "../../../languages.json";
import manifest from "../../package.json";
import { languageOf } from "../../../picture/content";

for (const { text, language } of cases) {
  test(`the language of ${JSON.stringify(text.slice(0, 24))}`, () => {
    assert.equal(languageOf(text), language);
  });
}

// What VS Code itself goes by where it knows no ending, before the extension runs.
test("first lines of programs and of other texts", () => {
  const firstLine = (id: string): RegExp => new RegExp(manifest.contributes.languages.find((one) => one.id === id)?.firstLine ?? "");
  const [threeB, iso] = [firstLine("3b"), firstLine("wire-iso")];
  for (const line of ["B9900B0B9900GXL1", "N 1: B 9900 B 0 B 9900 GX L1", "; Start Point = 0 , 0"]) {
    assert.ok(threeB.test(line) && !iso.test(line), line);
  }
  for (const line of ["%", "O0001", "O0001 (PLATE)", "N10 G92 X0 Y0", "G90G54"]) {
    assert.ok(iso.test(line) && !threeB.test(line), line);
  }
  for (const line of ["%PDF-1.4", "Dear customer,", "#!/bin/sh", "G1 goes first", "BABBBAGE", ""]) {
    assert.ok(!iso.test(line) && !threeB.test(line), line);
  }
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { keep, type Sides } from "../../src/commands/keep";

test("what is said of contours is written into wedm.toml, and nothing else is touched", () => {
  const check = (text: string, sides: Sides, expected: string): void => {
    assert.equal(keep(text, sides), expected);
  };
  const auto: Sides = { side: "auto" };
  check("", auto, 'side = "auto"\n');
  check("correction = 0.1\n", auto, 'correction = 0.1\nside = "auto"\n');
  check('side = "both"  # bare\ncorrection = 0.1', auto, 'side = "auto"  # bare\ncorrection = 0.1\n');
  check('[rules]\r\nside = "off"\r\n', auto, 'side = "auto"\r\n\r\n[rules]\r\nside = "off"\r\n');
  check("margin = 0\n\n[rules]\n", auto, 'margin = 0\nside = "auto"\n\n[rules]\n');
  const contours: Sides = { contours: { "2A": "punch", "2B": "opening" } };
  check("", contours, '[contours]\n"2A" = "punch"\n"2B" = "opening"\n');
  check('[contours] # mine\n2A = "both"\n\n[rules]\n', contours, '[contours] # mine\n"2A" = "punch"\n"2B" = "opening"\n\n[rules]\n');
  check('correction = 0.1\n', { layers: { 'A "B"': "ignore" } }, 'correction = 0.1\n\n[layers]\n"A \\"B\\"" = "ignore"\n');
});

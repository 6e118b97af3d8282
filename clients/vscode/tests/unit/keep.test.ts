import assert from "node:assert/strict";
import { test } from "node:test";
import { keep, keepContour, type Sides } from "../../../picture/keep";

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

test("what is said of one contour of one drawing stands in its own table, and goes again", () => {
  const check = (text: string, said: Parameters<typeof keepContour>[3], expected: string): void => {
    assert.equal(keepContour(text, "plate.dxf", "2A", said), expected);
  };
  const head = '[drawings."plate.dxf".contours.2A]';
  check("", { side: "opening" }, `${head}\nside = "opening"\n`);
  check("correction = 0.1\n", { thread: [1.5, -2] }, `correction = 0.1\n\n${head}\nthread = [1.5, -2]\n`);
  check(`${head} # mine\nside = "punch"\n\n[rules]\n`, { order: 2 }, `${head} # mine\nside = "punch"\norder = 2\n\n[rules]\n`);
  check(`${head}\nside = "punch"\norder = 2\n`, { side: null }, `${head}\norder = 2\n`);
  check(`margin = 0\n\n${head}\nside = "punch"\n`, { side: null }, "margin = 0\n");
  check("margin = 0\n", { side: null, thread: null }, "margin = 0\n");
  assert.equal(keepContour("", "a#b.dxf", "#1", { order: 1 }), '[drawings."a#b.dxf".contours."#1"]\norder = 1\n');
});

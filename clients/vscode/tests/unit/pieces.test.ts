import assert from "node:assert/strict";
import { test } from "node:test";
import { boxOf, dataOf, lengthOf, runsOf } from "../../../picture/pieces";

/** A line to the right, then a quarter of a circle of radius 5 up, counter-clockwise. */
const ROUNDED = [0, 0, 10_000, 0, 0, 15_000, 5_000, 5_000];

test("a piece in numbers is path data, and is read out of it", () => {
  assert.equal(dataOf(ROUNDED), "M0 0L10 0A5 5 0 0 1 15 5");
  assert.deepEqual(runsOf("M0 0L10 0A5 5 0 0 1 15 5"), [ROUNDED]);
  assert.deepEqual(runsOf("M1 2L3 4M5 6A2.5 2.5 0 0 0 7 8Z"), [[1000, 2000, 3000, 4000, 0], [5000, 6000, 7000, 8000, -2500]]);
});

test("lines and arcs have their lengths", () => {
  assert.ok(Math.abs(lengthOf(ROUNDED) - (10 + 2.5 * Math.PI)) < 1e-9);
  // What is rounded may make a chord that is longer than the arc is wide.
  assert.ok(Math.abs(lengthOf([0, 0, 2001, 0, 1000]) - Math.PI) < 1e-3);
  assert.equal(lengthOf([3, 4]), 0);
});

test("a piece lies in its box on the sheet, whose y points down", () => {
  const { x, y, width, height } = boxOf(ROUNDED, 100, 200);
  assert.ok(x <= 100 && x + width >= 115 && y <= 195 && y + height >= 200);
  assert.ok(width < 17 && height < 8);
});

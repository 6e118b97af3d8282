import assert from "node:assert/strict";
import { test } from "node:test";
import { type Box, centred, fitted, moved, roundLength, sees, unitsPerPixel, zoomed } from "../../../picture/frame";

function close(seen: Box, expected: Box): void {
  for (const key of ["x", "y", "width", "height"] as const) {
    assert.ok(Math.abs(seen[key] - expected[key]) < 1e-9, `${key}: ${seen[key]}, expected ${expected[key]}`);
  }
}

const size = { width: 800, height: 400 };

test("what is fitted is seen as a whole, in the middle", () => {
  const view = fitted({ x: 10, y: 20, width: 60, height: 30 }, size, { width: 100, height: 50 });
  close(view, { x: 0, y: 15, width: 80, height: 40 });
  assert.equal(unitsPerPixel(view, size), 0.1);
  // A single point has no extent, and a window may have none yet.
  close(fitted({ x: 1, y: 1, width: 0, height: 0 }, size, { width: 0, height: 0 }), { x: -399, y: -199, width: 800, height: 400 });
  assert.ok(Number.isFinite(fitted({ x: 1, y: 1, width: 5, height: 5 }, { width: 0, height: 0 }, { width: 9, height: 9 }).x));
});

test("zoom leaves the point under the pointer where it is, and has its ends", () => {
  const all = { x: 0, y: 0, width: 80, height: 40 };
  close(zoomed(all, 2, 20, 10, all), { x: 10, y: 5, width: 40, height: 20 });
  close(zoomed(zoomed(all, 3, 7, 9, all), 1 / 3, 7, 9, all), all);
  let view = all;
  for (let step = 0; step < 100; step += 1) {
    view = zoomed(view, 10, 20, 10, all);
  }
  assert.ok(view.width > 0 && Math.abs(view.x - 20) < 1e-3, JSON.stringify(view));
  assert.equal(zoomed(all, 1e-9, 0, 0, all).width, 480);
});

test("a part is brought into view, and known to be in it", () => {
  const view = moved({ x: 0, y: 0, width: 80, height: 40 }, 10, 0);
  assert.ok(sees(view, { x: 30, y: 10, width: 1, height: 1 }));
  assert.ok(!sees(view, { x: 10, y: 10, width: 1, height: 1 }), "at the very edge");
  assert.ok(!sees(view, { x: 95, y: 10, width: 1, height: 1 }));
  close(centred(view, 100, 50), { x: 60, y: 30, width: 80, height: 40 });
});

test("a scale has a round length", () => {
  const lengths = [7.3, 1, 0.049, 2000, 0, -1, Number.NaN, Infinity];
  const round = lengths.map((length) => Number(roundLength(length).toPrecision(6)));
  assert.deepEqual(round, [5, 1, 0.02, 2000, 0, 0, 0, 0]);
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { Track } from "../../../picture/track";

test("a distance is a place in a piece", () => {
  const track = new Track([2, 0, 3]);
  assert.equal(track.length, 5);
  const check = (distance: number, piece: number, along: number): void => {
    assert.deepEqual(track.at(distance), { piece, along }, String(distance));
  };
  check(-1, 0, 0);
  check(0, 0, 0);
  check(2, 0, 2);
  check(2.5, 2, 0.5);
  check(5, 2, 3);
  check(99, 2, 3);
  assert.deepEqual([0, 1, 2].map((piece) => track.startOf(piece)), [0, 2, 2]);
});

test("there may be no way, and pieces without a length", () => {
  assert.equal(new Track([]).at(1), null);
  assert.deepEqual(new Track([Number.NaN, 1]).at(0.5), { piece: 1, along: 0.5 });
});

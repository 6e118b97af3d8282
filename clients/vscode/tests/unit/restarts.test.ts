import assert from "node:assert/strict";
import { test } from "node:test";
import { cases } from "../../../restarts.json";
import { Restarts } from "../../src/server/restarts";

test("pauses are those of every client", () => {
  for (const { lives, pauses } of cases) {
    const restarts = new Restarts();
    const ours = lives.map((life) => restarts.afterLifeOf(life * 1_000));
    assert.deepEqual(ours, pauses.map((pause) => pause && pause * 1_000));
  }
});

test("a start that the user asks for begins again", () => {
  const restarts = new Restarts();
  assert.deepEqual([0, 1, 2, 3, 4, 5].map(() => restarts.afterLifeOf(0)).at(-1), null);
  restarts.reset();
  assert.equal(restarts.afterLifeOf(0), 0);
});

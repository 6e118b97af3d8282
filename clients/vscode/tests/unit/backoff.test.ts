import assert from "node:assert/strict";
import { test } from "node:test";
import { Backoff } from "../../src/server/backoff";

test("waits grow, and end", () => {
  const backoff = new Backoff();
  const waits = [0, 1, 2, 3, 4, 5].map((death) => {
    backoff.started(death * 1_000);
    return backoff.died(death * 1_000 + 500);
  });
  assert.deepEqual(waits, [250, 1_000, 3_000, 8_000, 20_000, null]);
});

test("a server that lived long was sound, and a start that never came was not", () => {
  const backoff = new Backoff();
  backoff.started(1);
  assert.equal(backoff.died(500), 250);
  assert.equal(backoff.died(600), 1_000);
  backoff.started(700);
  assert.equal(backoff.died(60_701), 250);
  backoff.reset();
  assert.equal(backoff.died(70_000), 250);
});

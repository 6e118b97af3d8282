import assert from "node:assert/strict";
import { test } from "node:test";
import { type Answer, misfit } from "../../src/server/handshake";

const WEDM = { name: "wedm", version: "9.9.9" };

function check(experimental: unknown, expected: string | null, serverInfo: Answer["serverInfo"]): void {
  assert.equal(misfit({ serverInfo, capabilities: { experimental } }, "/bin/wedm"), expected);
}

test("the same protocol fits, others say which side is old", () => {
  check({ wedm: { protocol: 1 } }, null, WEDM);
  check({ wedm: { protocol: 2 } }, "/bin/wedm (wedm 9.9.9) speaks protocol 2 of wedm, this extension speaks 1: update the extension", WEDM);
  check({ wedm: { protocol: 0 } }, "/bin/wedm (wedm 9.9.9) speaks protocol 0 of wedm, this extension speaks 1: update the server", WEDM);
});

test("what is no wedm is named", () => {
  check({}, "/bin/wedm is not wedm: it says it is ra 1 and names no protocol of wedm", { name: "ra", version: "1" });
  for (const odd of [null, 1, "wedm", { wedm: 1 }, { wedm: { protocol: "1" } }]) {
    check(odd, "/bin/wedm is not wedm: it says it is unnamed without a version and names no protocol of wedm", undefined);
  }
  assert.match(misfit(undefined, "/bin/wedm") ?? "", /is not wedm/);
});

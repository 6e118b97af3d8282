import assert from "node:assert/strict";
import { test } from "node:test";
import { read } from "../../src/commands/listed";
import { fromPage } from "../../../picture/messages";

test("of the page's messages only those are heard that say something", () => {
  const check = (message: unknown, expected: unknown): void => {
    assert.deepEqual(fromPage(message), expected);
  };
  check({ type: "ready", more: 1 }, { type: "ready" });
  check({ type: "segment", handle: "2A", segment: 3 }, { type: "segment", handle: "2A", segment: 3 });
  check({ type: "segment", handle: "2A", segment: -1 }, { type: "segment", handle: "2A", segment: null });
  check({ type: "playing", line: null }, { type: "playing", line: null });
  check({ type: "line", line: 4 }, { type: "line", line: 4 });
  check({ type: "fault", fault: 2 }, { type: "fault", fault: 2 });
  check({ type: "fix", fault: 2, repair: 0 }, { type: "fix", fault: 2, repair: 0 });
  check({ type: "fixAll" }, { type: "fixAll" });
  check({ type: "program", format: "4b" }, { type: "program", format: "4b" });
  check({ type: "program", format: "exe" }, null);
  check({ type: "explain", rule: "small-radius" }, { type: "explain", rule: "small-radius" });
  const said = { side: "punch", thread: [1, 2], entry: null, order: 3 };
  check({ type: "say", handles: ["2A"], said }, { type: "say", handles: ["2A"], said });
  for (const odd of [{}, { side: "up" }, { thread: [1] }, { order: 0 }, { length: 1 }, null]) {
    check({ type: "say", handles: ["2A"], said: odd }, null);
  }
  check({ type: "say", handles: [], said }, null);
  check({ type: "explain", rule: "../secret" }, null);
  for (const odd of [null, 1, "ready", {}, { type: "segment" }, { type: "line", line: 1.5 }, { type: "line", line: "1" }, { type: "run" }]) {
    check(odd, null);
  }
});

test("a list of findings is read, and what is none is not", () => {
  const good = { path: "/a.dxf", line: 1, column: 1, endLine: 1, endColumn: 2, rule: "small-radius", severity: "error", message: "m" };
  const odd = [{ ...good, line: 0 }, { ...good, severity: "fatal" }, { ...good, path: 1 }, null];
  assert.deepEqual(read(JSON.stringify({ diagnostics: [good, ...odd] })), [good]);
  for (const text of ["", "{", "{}", "[]", '{"diagnostics": 1}']) {
    assert.equal(read(text), null, text);
  }
});

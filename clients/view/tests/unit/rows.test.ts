import assert from "node:assert/strict";
import { test } from "node:test";
import type { Fault } from "../../../picture/messages";
import type { FileEntry } from "../../src/api";
import { difference, keyOf, languageOfFile } from "../../src/doc";
import { fileRows, findingRows, lineRows } from "../../src/rows";

const file = (path: string, errors: number | null, warnings: number | null, more: Partial<FileEntry> = {}): FileEntry =>
  ({ uri: `file:///${path}`, path, language: "dxf", trouble: null, bytes: 1, errors, warnings, ...more });
const fault = (rule: string, handle: string, segment: number, severity: Fault["severity"] = "error"): Fault =>
  ({ rule, handle, segment, severity, message: `${rule} at ${handle}` });

test("the worst file comes first, and a search finds by any part of the path", () => {
  const files = [file("ok.dxf", 0, 0), file("wedm.toml", 0, 0, { language: "toml" }), file("warned.dxf", 0, 2), file("bad.dxf", 3, 0), file("torn.dxf", null, null, { trouble: "t" })];
  assert.deepEqual(fileRows(files, "").map(({ text }) => text), ["bad.dxf", "torn.dxf", "warned.dxf", "ok.dxf", "wedm.toml"]);
  assert.deepEqual(fileRows(files, "A dxf").map(({ text }) => text), ["bad.dxf", "warned.dxf"]);
});

test("findings stand under their rule; of a folded rule only the head is seen", () => {
  const faults = [fault("gap", "A", 0, "warning"), fault("small-radius", "B", 1), fault("small-radius", "C", 2)];
  const rows = findingRows(faults, [], new Set([keyOf(faults[2] as Fault)]), new Set(["gap"]));
  assert.deepEqual(rows.map(({ key }) => key), ["rule small-radius", "fault 1", "fault 2", "rule gap"]);
  assert.deepEqual(rows.map(({ kind }) => kind?.includes("new")), [false, false, true, false]);
  // As the marks of the picture are numbered.
  assert.deepEqual(rows.slice(1, 3).map(({ detail }) => detail?.slice(0, 2)), ["① ", "② "]);
});

test("what is new and what is gone is told by handles, not by order", () => {
  const [a, b, c] = [fault("gap", "A", 0), fault("gap", "B", 0), fault("small-radius", "C", 1)];
  const { added, gone, fresh } = difference([a, b], [c, a]);
  assert.deepEqual([added, gone, [...fresh]], [1, 1, [keyOf(c)]]);
  assert.deepEqual([difference([a, a], [a]).gone, difference([a], [a, a]).added], [1, 1]);
});

test("the lines of a program carry the worst that was found in them", () => {
  const found: Fault[] = [{ severity: "warning", rule: "w", message: "w", line: 1 }, { severity: "error", rule: "e", message: "e", line: 1 }];
  assert.deepEqual(lineRows(["B1B2B3GXL1", "DD", ""], found).map(({ text, kind }) => [text, kind?.trim()]), [["1  B1B2B3GXL1", "code"], ["2  DD", "code error"]]);
});

test("a file is known by its ending, else by its text", () => {
  assert.equal(languageOfFile("a.DXF", ""), "dxf");
  assert.equal(languageOfFile("a.4b", ""), "3b");
  assert.equal(languageOfFile("a.txt", "B0B2900B2900GYL4\nDD\n"), "3b");
  assert.equal(languageOfFile("a.txt", "to whom it may concern\n"), null);
});

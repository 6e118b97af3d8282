import assert from "node:assert/strict";
import { test } from "node:test";
import { Source } from "../../src/source";

const bytes = (...parts: (string | number[])[]): Uint8Array =>
  Uint8Array.from(parts.flatMap((part) => (typeof part === "string" ? [...new TextEncoder().encode(part)] : part)));
const edit = (line: number, from: number, to: number, newText: string) =>
  ({ range: { start: { line, character: from }, end: { line, character: to } }, newText });

test("an edit changes the bytes that it is about, and no other", () => {
  const source = new Source(bytes("10\r\n19.92\r\n42\r\n0.41\r\n"));
  const after = source.edited([edit(3, 0, 4, "0.5"), edit(1, 0, 5, "19.899")]);
  assert.equal(new TextDecoder().decode(after), "10\r\n19.899\r\n42\r\n0.5\r\n");
});

test("an edit takes lines away", () => {
  const source = new Source(bytes("a\nb\nc\nd\n"));
  const gone = { range: { start: { line: 1, character: 0 }, end: { line: 3, character: 0 } }, newText: "" };
  assert.equal(new TextDecoder().decode(source.edited([gone])), "a\nd\n");
});

test("a text in GBK keeps its bytes, and is read as what it says", () => {
  // 凹模, the name of a layer.
  const name = [0xb0, 0xbc, 0xc4, 0xa3];
  const source = new Source(bytes("9\n$DWGCODEPAGE\n3\nANSI_936\n8\n", name, "X\n40\n0.08\n"));
  assert.equal(source.text.split("\n")[5], "凹模X");
  const after = source.edited([edit(7, 0, 4, "0.101"), edit(5, 2, 3, "YZ")]);
  assert.deepEqual(after, bytes("9\n$DWGCODEPAGE\n3\nANSI_936\n8\n", name, "YZ\n40\n0.101\n"));
});

test("the mark at the beginning of a text stays", () => {
  const source = new Source(bytes([0xef, 0xbb, 0xbf], "B1B2B3GXL1\n"));
  assert.equal(source.text[0], "\ufeff");
  assert.deepEqual(source.edited([edit(0, 1, 3, "B9")]), bytes([0xef, 0xbb, 0xbf], "B9B2B3GXL1\n"));
});

test("a binary file is known as one", () => {
  assert.ok(new Source(bytes("AutoCAD Binary DXF\r\n", [0x1a, 0])).isBinary);
  assert.ok(!new Source(bytes("0\nSECTION\n")).isBinary);
});

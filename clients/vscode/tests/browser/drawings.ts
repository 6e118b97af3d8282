// Drawings and programs that the tests look at.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { PROJECT } from "./paths";

/** A plate of 20 × 10 mm with one fillet of R 0.05, whose bulge stands in line 36. */
export const FILLET = await readFile(join(PROJECT, "tests/data/tight_fillet.dxf"), "utf8");
/** A round hole as a program. */
export const HOLE = await readFile(join(PROJECT, "tests/data/hole.3b"), "utf8");

/** A drawing in mm with the entities that these lines describe. */
export function drawn(...entities: string[]): string {
  const head = ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "4", "0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"];
  return [...head, ...entities, "0", "ENDSEC", "0", "EOF", ""].join("\n");
}

/** A plate of 20 × 10 mm with a hole of R 3 in its middle, on layers of their own. */
export const PLATE = drawn(
  ...["0", "LWPOLYLINE", "5", "2A", "8", "DIE", "90", "4", "70", "1"],
  ...[[0, 0], [20, 0], [20, 10], [0, 10]].flatMap(([x, y]) => ["10", String(x), "20", String(y)]),
  ...["0", "CIRCLE", "5", "2B", "8", "HOLES", "10", "10", "20", "5", "40", "3"],
);

/** Line, from 1, of the n-th line that is exactly this. */
export function lineOf(text: string, wanted: string, nth = 1): number {
  const lines = text.split(/\r?\n/);
  let found = 0;
  for (const [index, line] of lines.entries()) {
    if (line.trim() === wanted) {
      found += 1;
      if (found === nth) {
        return index + 1;
      }
    }
  }
  throw new Error(`there is no line ${wanted}`);
}

/** A sound drawing of more than `bytes` bytes: texts that nobody cuts, and one fillet too tight at its end. */
export function large(bytes: number): Buffer {
  const head = "0\nSECTION\n2\nENTITIES\n";
  const note = (n: number): string => `0\nTEXT\n5\n${(n + 256).toString(16)}\n8\nNOTE\n10\n0\n20\n0\n40\n1\n1\n${"x".repeat(2000)}\n`;
  const notes = Array.from({ length: Math.ceil(bytes / note(0).length) }, (_, n) => note(n)).join("");
  return Buffer.from(`${head}${notes}0\n${FILLET.slice(FILLET.indexOf("LWPOLYLINE"))}`);
}

/** A drawing of group codes with numbers and texts as binary DXF, as AutoCAD writes it from R13 on. */
export function binary(text: string): Buffer {
  const lines = text.trimEnd().split(/\r?\n/).map((line) => line.trim());
  const parts: Buffer[] = [Buffer.from("AutoCAD Binary DXF\r\n\x1a\0", "latin1")];
  for (let at = 0; at + 1 < lines.length; at += 2) {
    const [code, value] = [Number(lines[at]), lines[at + 1] ?? ""];
    const head = Buffer.alloc(2);
    head.writeUInt16LE(code);
    parts.push(head, written(code, value));
  }
  return Buffer.concat(parts);
}

function written(code: number, value: string): Buffer {
  const isWithin = (from: number, to: number): boolean => code >= from && code < to;
  const bytes = Buffer.alloc(isWithin(10, 60) ? 8 : isWithin(60, 80) ? 2 : 4);
  if (isWithin(10, 60)) {
    bytes.writeDoubleLE(Number(value));
  } else if (isWithin(60, 80)) {
    bytes.writeInt16LE(Number(value));
  } else if (isWithin(90, 100)) {
    bytes.writeInt32LE(Number(value));
  } else {
    return Buffer.from(`${value}\0`, "latin1");
  }
  return bytes;
}

/** A rectangle of 20 × 10 mm as DXB: lines whose coordinates are of double precision. */
export function dxb(): Buffer {
  const corners = [[0, 0], [20, 0], [20, 10], [0, 10]] as const;
  const lines = corners.map(([x, y], index) => {
    const [endX, endY] = corners[(index + 1) % corners.length] ?? [0, 0];
    const line = Buffer.alloc(1 + 6 * 8);
    line.writeUInt8(1);
    [x, y, 0, endX, endY, 0].forEach((value, place) => line.writeDoubleLE(value, 1 + 8 * place));
    return line;
  });
  return Buffer.concat([Buffer.from("AutoCAD DXB 1.0\r\n\x1a\0", "latin1"), Buffer.from([135, 1, 0]), ...lines, Buffer.from([0])]);
}

import assert from "node:assert/strict";
import { test } from "node:test";
import { partFile, toldOfPart } from "../../../picture/parts";
import type { PairProgram } from "../../../picture/protocol";

test("files of parts are named as wedm pair names them", () => {
  assert.equal(partFile("washer", "punch", "3b"), "washer-punch.3b");
  assert.equal(partFile("a.b", "upper part/2", "iso"), "a.b-upper_part_2.iso");
  assert.equal(partFile("模", "凸模 Ⅱ-½_1", "4b"), "模-凸模_Ⅱ-½_1.4b");
  assert.equal(partFile("x", "😀..", "3b"), "x-_...3b");
});

test("a part is told with its corrections, its blocks and its lengths", () => {
  const check = (part: Partial<PairProgram>, expected: string): void => {
    const plain = { part: "punch", corrections: [0.1], otherSide: false, blocks: 3, length: 37.46 } as PairProgram;
    assert.equal(toldOfPart({ ...plain, ...part }), expected);
  };
  check({}, "punch: correction 0.1000 mm, 3 blocks, cut 37.5 mm");
  check({ part: "upper", corrections: [0.16, 0.1], blocks: 1, jumps: 2 }, "upper: correction 0.1600 / 0.1000 mm, 1 block, cut 37.5 mm, jumps 2.0 mm");
  check({ otherSide: true }, "punch: correction 0.1000 mm, the wire on what is drawn or on its other side, 3 blocks, cut 37.5 mm");
});

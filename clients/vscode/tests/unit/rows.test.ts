import assert from "node:assert/strict";
import { test } from "node:test";
import type { Inspection } from "../../../picture/protocol";
import { rows, summary } from "../../../picture/rows";

const inspection: Inspection = {
  unitsToMm: 25.4,
  entities: [
    { handle: "1", type: "LINE", layer: "0", closed: false, cut: true, segments: [{ index: 0, kind: "line", start: [0, 0], end: [1, 0], length: 1, verdict: "ok" }] },
    {
      handle: "2A",
      type: "LWPOLYLINE",
      layer: "DIE",
      closed: true,
      cut: true,
      segments: [
        { index: 0, kind: "line", start: [0, 0], end: [1, 0], length: 1, verdict: "ok" },
        { index: 2, kind: "arc", start: [1, 0.5], end: [0, 0], length: 0.1, radius: 0.003, sweep: 90, verdict: "small-radius,gap" },
      ],
    },
  ],
};

test("figures are mm whatever the drawing's unit, and vertices keep their numbers", () => {
  const list = rows(inspection, false);
  assert.deepEqual(list.map(({ label, description }) => [label, description]), [
    ["LINE 1", "0 · 1 segment"],
    ["LWPOLYLINE 2A", "DIE · 1 of 2 segments not ok"],
  ]);
  assert.deepEqual(list[1]?.segments.map(({ label, description }) => [label, description]), [
    ["0   line 25.400", "0.000, 0.000"],
    ["2   R 0.076", "small-radius,gap · 25.400, 12.700"],
  ]);
  assert.equal(summary(list), "1 not ok");
});

test("contours come before what is in none, and hold the segments of all their entities", () => {
  const piece = (handle: string, segment: number) => ({ handle, segment, kind: "line" as const, start: [0, 0] as [number, number], end: [1, 0] as [number, number], length: 1, reversed: false });
  const contour = { closed: true, role: "opening" as const, length: 2, gaps: [], order: 4, segments: [piece("2A", 0), piece("2A", 2)] };
  const list = rows(inspection, false, [contour]);
  assert.deepEqual(list.map(({ label, description, handles }) => [label, description, handles]), [
    ["Contour 5", "DIE · 1 of 2 segments not ok", ["2A"]],
    ["LINE 1", "0 · 1 segment", ["1"]],
  ]);
  const joined = rows(inspection, false, [{ ...contour, segments: [piece("1", 0), ...contour.segments] }]);
  assert.deepEqual(joined.map(({ segments }) => segments.map(({ label }) => label)), [["1 · 0   line 25.400", "2A · 0   line 25.400", "2A · 2   R 0.076"]]);
});

test("a segment has the numbers of its marks", () => {
  const of = (rule: string) => ({ rule, severity: "error" as const, message: "", handle: "2A", segment: 2 });
  const list = rows(inspection, false, [], [of("gap"), of("small-radius")]);
  assert.deepEqual(list[1]?.segments.map(({ description }) => description), ["0.000, 0.000", "② · ① · small-radius,gap · 25.400, 12.700"]);
});

test("only faults leaves what is sound out", () => {
  const list = rows(inspection, true);
  assert.deepEqual(list.map(({ handle, segments }) => [handle, segments.length]), [["2A", 1]]);
  assert.equal(summary([]), "all ok");
});

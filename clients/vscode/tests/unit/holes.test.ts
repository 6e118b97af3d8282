import assert from "node:assert/strict";
import { test } from "node:test";
import { csvOf } from "../../src/commands/holes";

test("the drill list has the columns of the command line, in mm, and coordinates that round to zero have no sign", () => {
  const holes = [
    { contour: "2A", at: [1, -1e-9] as [number, number], diameter: 2, given: true },
    { contour: 'a "b"', at: [-0.5, 2] as [number, number], given: false },
  ];
  assert.equal(
    csvOf("a, b.dxf", holes, 25.4),
    'drawing,x_mm,y_mm,diameter_mm,contour,hole\n"a, b.dxf",25.4000,0.0000,2,2A,given\n"a, b.dxf",-12.7000,50.8000,,"a ""b""",found\n',
  );
});

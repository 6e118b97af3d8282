// The drill list as CSV, in the columns of `wedm holes`. Knows nothing of VS Code.

import type { StartHole } from "../protocol";

export function csvOf(drawing: string, holes: readonly StartHole[], unitsToMm: number): string {
  const rows = holes.map(({ at: [x, y], diameter, contour, given }) =>
    [cell(drawing), mm(x * unitsToMm), mm(y * unitsToMm), diameter ?? "", cell(contour), given ? "given" : "found"].join(","),
  );
  return ["drawing,x_mm,y_mm,diameter_mm,contour,hole", ...rows, ""].join("\n");
}

/** A coordinate that rounds to zero has no sign. */
function mm(along: number): string {
  return (Math.round(along * 1e4) / 1e4 + 0).toFixed(4);
}

/** In quotes where it has to be. */
function cell(text: string): string {
  return /[,"\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

// What the server answers, as the picture shows it.

import type { Contour, Fault, Severity } from "./messages";
import type { Contours, ContoursContour, Fit, SettingsInForce } from "./protocol";
import { t } from "./words";

/** A finding of an editor's or of the protocol's own kind, the severity counted from 0. */
export interface Found {
  severity: number;
  rule: string;
  message: string;
  /** Counts from 0; undefined in a file without lines. */
  line?: number | undefined;
  data?: unknown;
}

const SEVERITIES: readonly Severity[] = ["error", "warning", "information", "hint"];

export function faultOf({ severity, rule, message, line, data }: Found, toMm: number): Fault {
  const told: { handle?: unknown; segment?: unknown; radius?: unknown } = typeof data === "object" && data !== null ? data : {};
  const { handle, segment, radius } = told;
  return {
    severity: SEVERITIES[severity] ?? "hint",
    rule,
    message,
    ...(line === undefined ? {} : { line }),
    ...(typeof handle === "string" ? { handle } : {}),
    ...(typeof segment === "number" ? { segment } : {}),
    ...(typeof radius === "number" ? { radius: radius * toMm } : {}),
  };
}

/** The handles of a contour's entities. */
export function handlesOf({ handles, segments }: ContoursContour): string[] {
  return [...new Set(handles ?? segments.map(({ handle }) => handle))];
}

/** The contour of each entity. */
export function byHandle(contours: readonly Contour[]): Map<string, Contour> {
  return new Map(contours.flatMap((contour) => contour.handles.map((handle) => [handle, contour] as const)));
}

/** The contours with their settings. */
export function contoursOf(listed: Contours, settings: Pick<SettingsInForce, "contours">): Contour[] {
  return listed.contours.map((contour, index) => {
    const handles = handlesOf(contour);
    const said = handles.map((handle) => settings.contours?.[handle]).find((each) => each !== undefined) ?? {};
    const { closed, role } = contour;
    return { number: (contour.order ?? index) + 1, handles, closed, role, length: contour.length * listed.unitsToMm, said };
  });
}

/** The places where less is left between two parts than there should be, the tightest first. */
export function faultsOfFit({ places, clearance: wanted }: Fit): Fault[] {
  const sorted = [...places].sort((a, b) => a.clearance - b.clearance);
  return sorted.map(({ at, clearance, handle, segment, of }) => {
    const left = t("{0} mm left", clearance.toFixed(4));
    return { severity: clearance < 0 ? "error" : "warning", rule: "does-not-fit", message: `${left} (${of})`, left, at, reach: Math.max(wanted, wanted - clearance), handle, segment };
  });
}

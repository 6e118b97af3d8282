// What the picture and its host say to each other: VS Code's extension, or the page of `wedm view`.

import type { ContourSettings, Piece, Repair, Role, SimulatedBlock } from "./protocol";

export type Severity = "error" | "warning" | "information" | "hint";

/** A finding as the strip below the picture shows it. */
export interface Fault {
  severity: Severity;
  rule: string;
  message: string;
  /** In a drawing. */
  handle?: string;
  segment?: number;
  /** The radius of an arc that is too tight, mm. */
  radius?: number;
  /** For a place of a fit: the clearance that is left there, in words. */
  left?: string;
  /** Where that is, drawing units, and how much round it to show, mm. */
  at?: [number, number];
  reach?: number;
  /** The line in a program; counts from 0. */
  line?: number;
}

/** A contour of a drawing as the page knows it. */
export interface Contour {
  /** From 1: its place among the cuts where it has one. */
  number: number;
  /** The handles of its entities; the first names it. */
  handles: string[];
  closed: boolean;
  role: Role;
  /** mm. */
  length: number;
  /** Its settings in wedm.toml. */
  said: ContourSettings;
}

/** A finding at close quarters: why it is one, and what would repair it. */
export interface Card {
  fault: number;
  why: string;
  repairs: Repair[];
}

export interface Shown {
  type: "picture";
  uri: string;
  /** The document that it was made of, whose view stays as it is. */
  madeOf?: string;
  name: string;
  /** With a fit there is no wire to play, and nothing to save. */
  kind: "drawing" | "program" | "fit";
  svg: string;
  /** The drawing, where it has too many elements for its SVG. */
  pieces?: Piece[];
  faults: Fault[];
  contours: Contour[];
  blocks: SimulatedBlock[];
  /** The lines of a program. */
  lines: string[];
  /** It is the editor of the drawing, where findings and contours are acted upon. */
  isEditor: boolean;
  /** Settings can be saved in a file beside it. */
  keeps: boolean;
  /** The host makes programs and all safe repairs: the toolbar offers them. */
  makes?: boolean;
}

export type ToPage =
  | Shown
  /** What the cursor stands on in a drawing, or null. */
  | { type: "segment"; handle: string | null; segment: number | null }
  /** Entities that are asked about: marked together until they are answered, wherever the cursor moves. */
  | { type: "contour"; handles: string[] }
  /** The line on which the cursor stands in a program. */
  | { type: "line"; line: number }
  | { type: "trouble"; message: string }
  | { type: "busy"; busy: boolean }
  | { type: "card"; card: Card }
  /** A segment, or all of these entities, picked elsewhere: selected, and framed. */
  | { type: "approach"; handles: string[]; segment: number | null }
  /** The finding with this index, picked elsewhere. */
  | { type: "look"; fault: number }
  | { type: "play" };

export type FromPage =
  | { type: "ready" }
  | { type: "segment"; handle: string; segment: number | null }
  | { type: "line"; line: number }
  /** The user looks at the finding with this index. */
  | { type: "fault"; fault: number }
  /** The user makes its repair with this index. */
  | { type: "fix"; fault: number; repair: number }
  /** The user opens the page of a rule. */
  | { type: "explain"; rule: string }
  /** Sets keys of the contour with this handle; null removes a key. */
  | { type: "say"; handles: string[]; said: Said }
  | { type: "text" }
  | { type: "export" }
  /** The user makes every safe repair, or a program. */
  | { type: "fixAll" }
  | { type: "program"; format: Made }
  /** The block on which the wire is while it plays; null when it has stopped. */
  | { type: "playing"; line: number | null };

/** What the toolbar makes of a drawing. */
export const MADE = ["3b", "4b", "iso"] as const;
export type Made = (typeof MADE)[number];

/** Keys of a contour's settings with their new values. */
export type Said = { [Key in keyof ContourSettings]?: ContourSettings[Key] | null };

const isIndex = (value: unknown): value is number => Number.isInteger(value) && Number(value) >= 0;
const isPoint = (value: unknown): value is [number, number] => Array.isArray(value) && value.length === 2 && value.every(Number.isFinite);
const ROLES: unknown[] = ["opening", "punch", "both", "left", "right", "line", "ignore"];

/** The page is ours, but its messages are checked all the same. */
export function fromPage(message: unknown): FromPage | null {
  if (typeof message !== "object" || message === null) {
    return null;
  }
  const { type, handle, segment, line, fault, repair, rule, handles, said, format } = message as Record<string, unknown>;
  switch (type) {
    case "ready":
    case "text":
    case "export":
    case "fixAll":
      return { type };
    case "program": {
      const made = MADE.find((each) => each === format);
      return made === undefined ? null : { type, format: made };
    }
    case "segment":
      return typeof handle === "string" ? { type, handle, segment: isIndex(segment) ? segment : null } : null;
    case "line":
      return isIndex(line) ? { type, line } : null;
    case "playing":
      return { type, line: isIndex(line) ? line : null };
    case "fault":
      return isIndex(fault) ? { type, fault } : null;
    case "fix":
      return isIndex(fault) && isIndex(repair) ? { type, fault, repair } : null;
    case "explain":
      return typeof rule === "string" && /^[\w-]+$/.test(rule) ? { type, rule } : null;
    case "say": {
      const named = Array.isArray(handles) && handles.length > 0 && handles.every((each) => typeof each === "string");
      const meant = saidOf(said);
      return named && meant !== null ? { type, handles, said: meant } : null;
    }
    default:
      return null;
  }
}

/** Null where a value is not allowed. */
function saidOf(value: unknown): Said | null {
  if (typeof value !== "object" || value === null) {
    return null;
  }
  const fits: Record<string, (value: unknown) => boolean> = {
    side: (side) => ROLES.includes(side),
    thread: isPoint,
    entry: isPoint,
    order: (order) => isIndex(order) && order > 0,
  };
  const entries = Object.entries(value);
  const all = entries.every(([key, each]) => each === null || fits[key]?.(each) === true);
  return all && entries.length > 0 ? value : null;
}

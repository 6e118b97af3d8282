// What the picture's page and the extension say to each other.

import type { SimulatedBlock } from "../protocol";

/** A finding as the strip below the picture shows it. */
export interface Fault {
  severity: "error" | "warning";
  rule: string;
  message: string;
  /** In a drawing. */
  handle?: string;
  segment?: number;
  /** In a program; counts from 0. */
  line?: number;
}

export type ToPage =
  | { type: "picture"; uri: string; name: string; kind: "drawing" | "program"; svg: string; faults: Fault[]; blocks: SimulatedBlock[] }
  /** What the cursor stands on in a drawing, or null. */
  | { type: "segment"; handle: string | null; segment: number | null }
  /** Entities that are asked about: marked together until the cursor moves. */
  | { type: "contour"; handles: string[] }
  /** The line on which the cursor stands in a program. */
  | { type: "line"; line: number }
  | { type: "trouble"; message: string }
  | { type: "play" };

export type FromPage =
  | { type: "ready" }
  | { type: "segment"; handle: string; segment: number | null }
  | { type: "line"; line: number }
  /** The block on which the wire is while it plays; null when it has stopped. */
  | { type: "playing"; line: number | null };

/** The page is ours, and its messages are looked at all the same. */
export function fromPage(message: unknown): FromPage | null {
  if (typeof message !== "object" || message === null) {
    return null;
  }
  const { type, handle, segment, line } = message as Record<string, unknown>;
  const isIndex = (value: unknown): value is number => Number.isInteger(value) && Number(value) >= 0;
  if (type === "ready") {
    return { type };
  }
  if (type === "segment" && typeof handle === "string") {
    return { type, handle, segment: isIndex(segment) ? segment : null };
  }
  if (type === "line" && isIndex(line)) {
    return { type, line };
  }
  if (type === "playing") {
    return { type, line: isIndex(line) ? line : null };
  }
  return null;
}

// The messages of the server's own name space, as docs/protocol.md has them.

import type { CodeAction, CodeActionParams, Diagnostic, Position, Range } from "vscode-languageserver-protocol";

/** Version of the name space that this extension speaks. */
export const PROTOCOL = 1;

/** Errors of the server that the user is shown as they are. */
export const REFUSED = -32803;
export const CONTENT_MODIFIED = -32801;
export const INVALID_PARAMS = -32602;

/** Kind of the action that makes every safe repair. */
export const FIX_ALL = "source.fixAll.wedm";

export type Point = [x: number, y: number];

export interface Segment {
  index: number;
  kind: "line" | "arc" | "circle";
  start: Point;
  end: Point;
  length: number;
  center?: Point;
  radius?: number;
  /** Degrees, positive counter-clockwise. */
  sweep?: number;
  /** `ok`, or the names of the rules at fault with a comma between. */
  verdict: string;
}

export interface InspectedEntity {
  handle: string;
  type: string;
  layer: string;
  closed: boolean;
  segments: Segment[];
}

export interface Inspection {
  unitsToMm: number;
  entities: InspectedEntity[];
}

export interface Located {
  handle: string;
  segment?: number;
  range: Range;
}

export interface SettingsInForce {
  /** mm */
  correction: number;
  corrections: number[];
  correctionFrom: "default" | "client" | "file";
  side: string;
  file?: string;
}

/** What a contour is: which side of it the wire runs on. */
export type Role = "opening" | "punch" | "both" | "ignore";

export interface Contour {
  closed: boolean;
  role: Role;
  /** Drawing units. */
  length: number;
  segments: { handle: string; segment: number }[];
}

export interface Contours {
  unitsToMm: number;
  contours: Contour[];
}

export type Format = "3b" | "4b" | "iso";

export interface Generated {
  program: string;
  blocks: number;
  /** mm */
  length: number;
  /** µm */
  closure: { x: number; y: number };
  /** Largest distance of a decoded block from the path, µm. */
  deviation: number;
  warnings: Diagnostic[];
}

/** One block of a program as the controller runs it; points in µm. */
export interface Block {
  line: number;
  number?: number;
  kind: string;
  start: Point;
  end: Point;
  deviation?: number;
}

export interface Simulation {
  blocks: Block[];
  closure: { x: number; y: number };
  /** mm */
  length: number;
  minutes?: number;
}

/** Params and result of each request. */
export interface Methods {
  "wedm/inspect": [{ uri: string; handle?: string }, Inspection];
  "wedm/contours": [{ uri: string }, Contours];
  "wedm/picture": [{ uri: string; options?: object }, { svg: string }];
  "wedm/locate": [{ uri: string; position: Position } | { uri: string; handle: string; segment?: number }, Located | null];
  "wedm/settings": [{ uri: string }, SettingsInForce];
  "wedm/generate": [{ uri: string; format: Format; options?: object; force?: boolean }, Generated];
  "textDocument/codeAction": [CodeActionParams, CodeAction[] | null];
  "wedm/simulate": [{ uri: string }, Simulation];
}

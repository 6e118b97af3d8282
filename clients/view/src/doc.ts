// What is shown: a drawing or a program, of a file or in memory.

import { languageOf } from "../../picture/content";
import type { Fault } from "../../picture/messages";
import { nameOf } from "./dom";
import { Source } from "./source";

export type Language = "dxf" | "3b" | "wire-iso";

export interface Doc {
  uri: string;
  name: string;
  language: Language;
  source: Source;
  /** Of the file that was read; null in memory. */
  revision: string | null;
  /** Where what was made in memory is to be saved; null: it is downloaded. */
  saveAs: string | null;
}

const ENDINGS: readonly (readonly [RegExp, Language])[] = [
  [/\.dxf$/i, "dxf"],
  [/\.[34]b$/i, "3b"],
  [/\.(iso|nc)$/i, "wire-iso"],
];

/** By the ending, else by the text; null where it is none of ours. */
export function languageOfFile(name: string, text: string): Language | null {
  return ENDINGS.find(([ending]) => ending.test(name))?.[1] ?? languageOf(text);
}

export function isDrawing(doc: Doc): boolean {
  return doc.language === "dxf";
}

/** A document that no file holds. */
export function inMemory(name: string, language: Language, bytes: Uint8Array, saveAs: string | null): Doc {
  return { uri: `untitled:${encodeURIComponent(name)}`, name, language, source: new Source(bytes), revision: null, saveAs };
}

export function ofFile(uri: string, language: Language, bytes: Uint8Array, revision: string): Doc {
  return { uri, name: nameOf(uri), language, source: new Source(bytes), revision, saveAs: null };
}

/** The name by which a finding is known again after the text has changed: lines move, handles stay. */
export function keyOf({ rule, handle, segment, message }: Fault): string {
  return handle === undefined ? `${rule}\n${message}` : `${rule}\n${handle}\n${segment ?? ""}`;
}

/** How many findings are new, and how many are gone; those of one name are counted. */
export function difference(before: readonly Fault[], after: readonly Fault[]): { fresh: Set<string>; added: number; gone: number } {
  const left = new Map<string, number>();
  for (const fault of before) {
    left.set(keyOf(fault), (left.get(keyOf(fault)) ?? 0) + 1);
  }
  const fresh = new Set<string>();
  let added = 0;
  for (const fault of after) {
    const count = left.get(keyOf(fault)) ?? 0;
    if (count > 0) {
      left.set(keyOf(fault), count - 1);
    } else {
      fresh.add(keyOf(fault));
      added += 1;
    }
  }
  return { fresh, added, gone: [...left.values()].reduce((sum, count) => sum + count, 0) };
}

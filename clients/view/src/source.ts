// A text and the bytes that it was read from: an edit changes only the bytes that it is about, in whatever encoding they are.

import type { TextEdit } from "./server";

/** What decoders call the code pages that a DXF names. */
const PAGES: Record<string, string> = {
  ANSI_936: "gb18030", GBK: "gb18030", GB2312: "gb18030", ANSI_950: "big5", BIG5: "big5", ANSI_932: "shift_jis", ANSI_949: "euc-kr",
};

const BINARY_DXF = "AutoCAD Binary DXF";

export class Source {
  readonly text: string;
  readonly #encoding: string;

  constructor(readonly bytes: Uint8Array) {
    this.#encoding = encodingOf(bytes);
    this.text = decoded(bytes, this.#encoding);
  }

  /** Not a text at all, which no editor can change. */
  get isBinary(): boolean {
    return decoded(this.bytes.subarray(0, BINARY_DXF.length), "latin1") === BINARY_DXF || this.bytes.subarray(0, 4096).includes(0);
  }

  /** The bytes after these edits, none of which overlap. */
  edited(edits: readonly TextEdit[]): Uint8Array {
    const lines = linesOf(this.bytes);
    const byPlace = edits.map(({ range, newText }) => ({
      from: this.#byteOf(lines, range.start.line, range.start.character),
      to: this.#byteOf(lines, range.end.line, range.end.character),
      text: new TextEncoder().encode(newText),
    }));
    byPlace.sort((a, b) => a.from - b.from || a.to - b.to);
    const parts: Uint8Array[] = [];
    let done = 0;
    for (const { from, to, text } of byPlace) {
      parts.push(this.bytes.subarray(done, from), text);
      done = to;
    }
    parts.push(this.bytes.subarray(done));
    const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) {
      whole.set(part, at);
      at += part.length;
    }
    return whole;
  }

  #byteOf(lines: readonly number[], line: number, character: number): number {
    const begin = lines[line] ?? this.bytes.length;
    const end = lines[line + 1] ?? this.bytes.length;
    const own = this.bytes.subarray(begin, end);
    if (own.every((byte) => byte < 0x80)) {
      return Math.min(begin + character, this.bytes.length);
    }
    let [length, characters] = [0, 0];
    // A character comes out with its last byte.
    const decoder = new TextDecoder(this.#encoding, { ignoreBOM: true });
    while (length < own.length && characters < character) {
      characters += decoder.decode(own.subarray(length, length + 1), { stream: true }).length;
      length += 1;
    }
    return begin + length;
  }
}

function decoded(bytes: Uint8Array, encoding: string): string {
  // The mark at the beginning is a character of the first line for the server, too.
  return new TextDecoder(encoding, { ignoreBOM: true }).decode(bytes);
}

function encodingOf(bytes: Uint8Array): string {
  for (const encoding of ["utf-8", pageOf(bytes), "gb18030"]) {
    try {
      new TextDecoder(encoding, { fatal: true }).decode(bytes);
      return encoding;
    } catch {
      // Not written in this one.
    }
  }
  return "windows-1252";
}

/** The encoding that a DXF says it has. */
function pageOf(bytes: Uint8Array): string {
  const head = decoded(bytes.subarray(0, 16_384), "latin1");
  const page = /\$DWGCODEPAGE\s+3\s+(\w+)/.exec(head)?.[1]?.toUpperCase() ?? "";
  return PAGES[page] ?? (/^ANSI_125\d$/.test(page) ? page.replace("ANSI_", "windows-") : "utf-8");
}

/** Where each line begins. */
function linesOf(bytes: Uint8Array): number[] {
  const lines = [0];
  const [feed, carriage] = [0x0a, 0x0d];
  for (let at = 0; at < bytes.length; at += 1) {
    if (bytes[at] === feed || (bytes[at] === carriage && bytes[at + 1] !== feed)) {
      lines.push(at + 1);
    }
  }
  return lines;
}

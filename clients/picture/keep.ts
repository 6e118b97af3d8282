// Writes the user's answers into the text of a wedm.toml, and reads what stands there. Knows nothing of VS Code.

import type { Said } from "./messages";
import type { Role } from "./protocol";

/** By nesting, or what each contour or layer is. */
export type Sides = { side: "auto" } | { contours: Record<string, Role> } | { layers: Record<string, Role> };

/** The text with the answer in it: an existing key gets the new value, every other line stays as it is. */
export function keep(text: string, sides: Sides): string {
  if ("side" in sides) {
    return withKey(text, null, "side", JSON.stringify(sides.side));
  }
  const [table, roles] = "contours" in sides ? (["contours", sides.contours] as const) : (["layers", sides.layers] as const);
  return Object.entries(roles).reduce((kept, [name, role]) => withKey(kept, table, JSON.stringify(name), JSON.stringify(role)), text);
}

/** The text with the settings of one contour of a drawing, by the name of its file and a handle. */
export function keepContour(text: string, drawing: string, handle: string, said: Said): string {
  const table = `drawings.${JSON.stringify(drawing)}.contours.${/^[\w-]+$/.test(handle) ? handle : JSON.stringify(handle)}`;
  return Object.entries(said).reduce((kept, [key, value]) => withKey(kept, table, key, written(value)), text);
}

/** As TOML; null where there is no value. */
function written(value: Said[keyof Said]): string | null {
  if (value === null || value === undefined) {
    return null;
  }
  return Array.isArray(value) ? `[${value.map((number) => String(Number(number.toFixed(6)))).join(", ")}]` : JSON.stringify(value);
}

/** What stands at a key of a table, as it is written; undefined where it is not set. `table` null: before the first table. */
export function valueOf(text: string, table: string | null, key: string): string | undefined {
  let isWithin = table === null;
  for (const line of text.split(/\r?\n/)) {
    if (/^\s*\[/.test(line)) {
      isWithin = table !== null && isHead(line, table);
    }
    const value = new RegExp(`^\\s*${key}\\s*=\\s*("[^"]*"|\\[[^\\]]*\\]|[^#\\s]+)`).exec(line)?.[1];
    if (isWithin && value !== undefined) {
      return value;
    }
  }
  return undefined;
}

/** The text with this value at a key; null takes the key out. Every other line stays as it is. */
export function withKey(text: string, table: string | null, key: string, value: string | null): string {
  const end = text.includes("\r\n") ? "\r\n" : "\n";
  const lines = text === "" ? [] : text.replace(/\r?\n$/, "").split(/\r?\n/);
  const heads = lines.flatMap((line, index) => (/^\s*\[/.test(line) ? [index] : []));
  const head = table === null ? -1 : heads.find((index) => isHead(lines[index] ?? "", table));
  const entry = `${key} = ${value ?? ""}`;
  if (head === undefined) {
    if (value === null) {
      return text;
    }
    lines.push(...(lines.length === 0 ? [] : [""]), `[${table ?? ""}]`, entry);
  } else {
    const next = heads.find((index) => index > head) ?? lines.length;
    const names = [key, key.replace(/^"([\w-]+)"$/, "$1")];
    const stands = lines.findIndex((line, index) => index > head && index < next && names.includes(line.split("=")[0]?.trim() ?? ""));
    if (value === null) {
      lines.splice(Math.max(stands, 0), stands >= 0 ? 1 : 0);
      // The head of a table that has become empty goes, with the blank line before it.
      const rest = lines.slice(head + 1, stands >= 0 ? next - 1 : next);
      if (head >= 0 && rest.every((line) => line.trim() === "")) {
        const apart = head > 0 && (lines[head - 1] ?? "").trim() === "" ? 1 : 0;
        lines.splice(head - apart, 1 + apart);
      }
    } else if (stands >= 0) {
      const remark = /\s*#.*$/.exec(lines[stands]?.replace(/"(?:[^"\\]|\\.)*"|'[^']*'/g, (quoted) => "x".repeat(quoted.length)) ?? "")?.[0] ?? "";
      lines[stands] = entry + (remark === "" ? "" : (lines[stands]?.slice(-remark.length) ?? ""));
    } else {
      // After the last line of its table that is not blank.
      let at = next;
      while (at > head + 1 && (lines[at - 1] ?? "").trim() === "") {
        at -= 1;
      }
      lines.splice(at, 0, entry, ...(at === next && next < lines.length ? [""] : []));
    }
  }
  return lines.length === 0 ? "" : lines.join(end) + end;
}

/** Whether a line is the head of a table, with or without a comment after it. */
function isHead(line: string, table: string): boolean {
  const head = `[${table}]`;
  return line.trim().startsWith(head) && /^\s*(#.*)?$/.test(line.trim().slice(head.length));
}

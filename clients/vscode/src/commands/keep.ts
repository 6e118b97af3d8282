// Writes what the user has said of contours into the text of a wedm.toml. Knows nothing of VS Code.

import type { Role } from "../protocol";

/** By nesting, or what each contour or layer is. */
export type Sides = { side: "auto" } | { contours: Record<string, Role> } | { layers: Record<string, Role> };

/** The text with the answer in it: a key that stands already gets the new value, every other line stays as it is. */
export function keep(text: string, sides: Sides): string {
  if ("side" in sides) {
    return withKey(text, null, "side", sides.side);
  }
  const [table, roles] = "contours" in sides ? (["contours", sides.contours] as const) : (["layers", sides.layers] as const);
  return Object.entries(roles).reduce((kept, [name, role]) => withKey(kept, table, JSON.stringify(name), role), text);
}

function withKey(text: string, table: string | null, key: string, value: string): string {
  const end = text.includes("\r\n") ? "\r\n" : "\n";
  const lines = text === "" ? [] : text.replace(/\r?\n$/, "").split(/\r?\n/);
  const heads = lines.flatMap((line, index) => (/^\s*\[/.test(line) ? [index] : []));
  const head = table === null ? -1 : heads.find((index) => lines[index]?.replace(/#.*/, "").trim() === `[${table}]`);
  const entry = `${key} = ${JSON.stringify(value)}`;
  if (head === undefined) {
    lines.push(...(lines.length === 0 ? [] : [""]), `[${table ?? ""}]`, entry);
  } else {
    const next = heads.find((index) => index > head) ?? lines.length;
    const names = [key, key.replace(/^"([\w-]+)"$/, "$1")];
    const stands = lines.findIndex((line, index) => index > head && index < next && names.includes(line.split("=")[0]?.trim() ?? ""));
    if (stands >= 0) {
      const remark = /\s*#.*$/.exec(lines[stands]?.replace(/"(?:[^"\\]|\\.)*"|'[^']*'/g, (quoted) => "x".repeat(quoted.length)) ?? "")?.[0] ?? "";
      lines[stands] = entry + (remark === "" ? "" : (lines[stands]?.slice(-remark.length) ?? ""));
    } else {
      // Behind the last line of its table that says something.
      let at = next;
      while (at > head + 1 && (lines[at - 1] ?? "").trim() === "") {
        at -= 1;
      }
      lines.splice(at, 0, entry, ...(at === next && next < lines.length ? [""] : []));
    }
  }
  return lines.join(end) + end;
}

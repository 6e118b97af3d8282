// The list that `wedm check --output json` prints. Knows nothing of VS Code.

export interface Listed {
  path: string;
  /** Lines and columns count from 1. */
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
  rule: string;
  severity: "error" | "warning" | "information" | "hint";
  message: string;
  data?: unknown;
}

/** Null when the text is no such list. */
export function read(text: string): Listed[] | null {
  try {
    const list: unknown = (JSON.parse(text) as { diagnostics?: unknown }).diagnostics;
    return Array.isArray(list) ? list.filter(isListed) : null;
  } catch {
    return null;
  }
}

function isListed(value: unknown): value is Listed {
  const listed = value as Partial<Listed> | null;
  const places = [listed?.line, listed?.column, listed?.endLine, listed?.endColumn];
  const severities: unknown[] = ["error", "warning", "information", "hint"];
  return (
    typeof listed?.path === "string" &&
    typeof listed.message === "string" &&
    typeof listed.rule === "string" &&
    severities.includes(listed.severity) &&
    places.every((place) => Number.isInteger(place) && Number(place) > 0)
  );
}

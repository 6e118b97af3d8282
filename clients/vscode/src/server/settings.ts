// The extension's settings as the server takes them. Knows nothing of VS Code.

/** Keys of the section that are the extension's own. */
const OWN = new Set(["server", "trace", "picture"]);

/** The settings that the user has set, without the extension's own keys: null is "not set". */
export function forServer(section: unknown): Record<string, unknown> {
  return Object.fromEntries(Object.entries(set(section) ?? {}).filter(([key]) => !OWN.has(key)));
}

/** The tables and values of a section that are set; undefined for an empty table. */
function set(value: unknown): Record<string, unknown> | undefined {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    return undefined;
  }
  const entries = Object.entries(value as Record<string, unknown>).flatMap(([key, inner]): [string, unknown][] => {
    const isTable = typeof inner === "object" && inner !== null && !Array.isArray(inner);
    const kept = isTable ? set(inner) : inner;
    return kept === undefined || kept === null ? [] : [[key, kept]];
  });
  return entries.length === 0 ? undefined : Object.fromEntries(entries);
}

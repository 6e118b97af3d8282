// What may stand at a place of a wedm.toml, out of the settings that the extension declares. Knows nothing of VS Code.

/** A setting as the manifest declares it. */
export interface Declared {
  type?: string | string[];
  enum?: (string | boolean | null)[];
  enumDescriptions?: (string | null)[];
  markdownDescription?: string;
  additionalProperties?: Declared | boolean;
  properties?: Record<string, Declared>;
  propertyNames?: { enum: string[] };
}

export interface Offer {
  kind: "table" | "key" | "value";
  label: string;
  /** What is written in place of the word at the cursor. */
  text: string;
  detail: string;
}

/** Settings that hold for the extension alone. */
const OWN = ["server", "trace"];

const kebab = (name: string): string => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

/** The settings by the dotted keys of a wedm.toml. */
export function keysOf(declared: Record<string, Declared>): Map<string, Declared> {
  const named = Object.entries(declared).map(([name, setting]) => [name.replace(/^wedm\./, "").split(".").map(kebab), setting] as const);
  return new Map(named.filter(([[first]]) => !OWN.includes(first ?? "")).map(([path, setting]) => [path.join("."), setting]));
}

/** What may stand at the end of `before`, the line up to the cursor, below the lines `above`. */
export function offers(keys: Map<string, Declared>, above: readonly string[], before: string): Offer[] {
  if (/^\s*\[[^\]]*$/.test(before)) {
    return tables(keys);
  }
  const heads = above.flatMap((line) => /^\s*\[([^[\]]*)\]\s*(?:#.*)?$/.exec(line)?.[1] ?? []);
  const table = heads.at(-1)?.trim() ?? "";
  const entry = /^\s*([^=#"]*?)\s*=\s*("?)[\w-]*$/.exec(before);
  const within = (key: string): string => (table === "" ? key : `${table}.${key}`);
  if (entry !== null) {
    const key = within(entry[1] ?? "");
    return values(keys.get(key) ?? inTable(keys.get(table)), entry[2] === '"');
  }
  return /^\s*[\w.-]*$/.test(before) ? names(keys, table) : [];
}

function tables(keys: Map<string, Declared>): Offer[] {
  const dotted = [...keys.keys()].flatMap((key) => key.split(".").slice(0, -1));
  const ofNames = [...keys].filter(([key, setting]) => !key.includes(".") && isTable(setting)).map(([key]) => key);
  return [...new Set([...dotted, ...ofNames])].map((name) => ({ kind: "table", label: name, text: name, detail: keys.get(name)?.markdownDescription ?? "" }));
}

function names(keys: Map<string, Declared>, table: string): Offer[] {
  const own = [...keys].filter(([key, setting]) => (table === "" ? !key.includes(".") && !isTable(setting) : key.startsWith(`${table}.`)));
  const listed = own.map(([key, setting]) => [table === "" ? key : key.slice(table.length + 1), setting] as const);
  const { properties = {}, propertyNames } = keys.get(table) ?? {};
  const named = (propertyNames?.enum ?? []).map((name): [string, Declared] => [name, {}]);
  return [...listed, ...Object.entries(properties), ...named].map(([name, setting]) => ({ kind: "key", label: name, text: `${name} = `, detail: setting.markdownDescription ?? "" }));
}

function values(setting: Declared | undefined, isQuoted: boolean): Offer[] {
  const words = setting?.enum ?? [];
  const said = (word: string): string => (isQuoted ? word : JSON.stringify(word));
  const named = words.flatMap((word, index): Offer[] => (typeof word !== "string" ? [] : [{ kind: "value", label: word, text: said(word), detail: setting?.enumDescriptions?.[index] ?? "" }]));
  const isTruth = [setting?.type].flat().includes("boolean") && !isQuoted;
  return [...named, ...(isTruth ? ["true", "false"] : []).map((word): Offer => ({ kind: "value", label: word, text: word, detail: "" }))];
}

/** What each entry of a table of names is. */
function inTable(setting: Declared | undefined): Declared | undefined {
  return typeof setting?.additionalProperties === "object" ? setting.additionalProperties : undefined;
}

function isTable(setting: Declared): boolean {
  return [setting.type].flat().includes("object") && [setting.type].flat().every((type) => type === "object" || type === "null");
}

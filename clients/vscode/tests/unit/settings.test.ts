import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { forServer } from "../../src/server/settings";

test("what nobody has set is left out, and so are the extension's own keys", () => {
  const section = {
    server: { path: "/x/wedm", log: "warn" },
    trace: { server: "off" },
    correction: 0.12,
    gap: null,
    passes: { corrections: null },
    program: { layout: "checking", thread: [1, 2], leadIn: null },
    rules: { "sharp-corner": "off" },
  };
  assert.deepEqual(forServer(section), {
    correction: 0.12,
    program: { layout: "checking", thread: [1, 2] },
    rules: { "sharp-corner": "off" },
  });
  for (const nothing of [null, undefined, {}, { correction: null }, "odd", [1]]) {
    assert.deepEqual(forServer(nothing), {});
  }
});

interface Schema {
  $ref?: string;
  type?: string | string[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  enum?: unknown[];
  const?: unknown;
  properties?: Record<string, Schema>;
}

interface Setting {
  type: string | string[];
  default: unknown;
  enum?: unknown[];
  enumDescriptions?: string[];
  enumItemLabels?: string[];
  order?: number;
  description?: string;
  markdownDescription?: string;
  additionalProperties?: Schema;
}

async function read(path: string): Promise<unknown> {
  return JSON.parse(await readFile(new URL(path, import.meta.url), "utf8"));
}

/** The bundle of the tests lies in dist/unit. */
const protocol = (await read("../../../../docs/protocol.schema.json")) as { $defs: Record<string, Schema> };
const manifest = (await read("../../package.json")) as { contributes: { configuration: { properties: Record<string, Setting> } } };
const contributed = manifest.contributes.configuration.properties;
const english = (await read("../../package.nls.json")) as Record<string, string>;

/** The sentence that a reference of the manifest stands for. */
function said(reference: string | undefined): string {
  return english[/^%(.*)%$/.exec(reference ?? "")?.[1] ?? ""] ?? "";
}

function resolved(schema: Schema): Schema {
  const real = [...(schema.anyOf ?? [])].find((one) => one.type !== "null") ?? schema;
  const name = real.$ref?.replace("#/$defs/", "");
  return name === undefined ? real : resolved(protocol.$defs[name] ?? {});
}

/** Every setting of the server, by its key. Tables with keys of their own are descended into. */
function settings(schema: Schema, prefix: string): [string, Schema][] {
  return Object.entries(schema.properties ?? {}).flatMap(([name, inner]) => {
    const real = resolved(inner);
    const key = `${prefix}.${name}`;
    return real.properties === undefined ? [[key, real]] : settings(real, key);
  });
}

function words(schema: Schema): unknown[] {
  const own = schema.const === undefined ? [] : [schema.const];
  return [...own, ...(schema.enum ?? []), ...(schema.oneOf ?? []).flatMap(words)];
}

test("the package contributes every setting of the server, and no other", () => {
  const server = settings(protocol.$defs["Settings"] ?? {}, "wedm").map(([key]) => key);
  const own = ["wedm.server.path", "wedm.server.log", "wedm.trace.server"];
  assert.ok(server.length >= 18, String(server.length));
  assert.deepEqual(Object.keys(contributed).toSorted(), [...server, ...own].toSorted());
});

test("a profile may hold what the server's profiles hold", () => {
  const profile = contributed["wedm.profiles"]?.additionalProperties;
  const server = protocol.$defs["ProfileSettings"]?.properties ?? {};
  assert.deepEqual(Object.keys(profile?.properties ?? {}), Object.keys(server));
  for (const [key, schema] of Object.entries(server)) {
    assert.deepEqual(new Set(profile?.properties?.[key]?.enum), new Set(words(resolved(schema))), key);
  }
});

test("each of them is not set by default, is described, and offers the words that the server knows", () => {
  for (const [key, schema] of settings(protocol.$defs["Settings"] ?? {}, "wedm")) {
    const setting = contributed[key];
    assert.ok(setting, key);
    assert.equal(setting.default, null, key);
    assert.ok([setting.type].flat().includes("null"), key);
    assert.ok(said(setting.markdownDescription).length > 20, key);
    const known = words(schema);
    if (known.length > 0) {
      assert.deepEqual(new Set(setting.enum), new Set([...known, null]), key);
      assert.equal(setting.enumDescriptions?.length, setting.enum?.length, key);
      assert.deepEqual(setting.enumDescriptions?.filter((one) => said(one) === ""), [], key);
    }
  }
});

test("a choice that is not made is called so, not null", () => {
  const choices = Object.entries(contributed).filter(([, setting]) => setting.enum?.includes(null) === true);
  assert.ok(choices.length > 10);
  for (const [key, { enum: all = [], enumItemLabels: labels = [] }] of choices) {
    assert.equal(labels.length, all.length, key);
    assert.equal(said(labels[all.indexOf(null)]), "not set", key);
  }
});

test("the settings that every job needs come first, those of the extension last", () => {
  const keys = Object.keys(contributed).toSorted((a, b) => (contributed[a]?.order ?? 0) - (contributed[b]?.order ?? 0));
  assert.deepEqual(keys.slice(0, 4), ["wedm.wireDiameter", "wedm.gap", "wedm.correction", "wedm.side"]);
  assert.deepEqual(keys.slice(-3), ["wedm.server.path", "wedm.server.log", "wedm.trace.server"]);
  assert.equal(new Set(keys.map((key) => contributed[key]?.order)).size, keys.length);
});

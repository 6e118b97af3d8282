// Writes clients/picture/protocol.ts: the types of the requests that a client may make, out of the published schema.
//   node generate-protocol.mjs [--check]
// With --check nothing is written; it fails where the file is not that of the schema.
import { compile } from "json-schema-to-typescript";
import { readFile, writeFile } from "node:fs/promises";

const TARGET = new URL("../picture/protocol.ts", import.meta.url);
const schema = JSON.parse(await readFile(new URL("../../docs/protocol.schema.json", import.meta.url), "utf8"));

/**
 * A schema as the compiler reads it. It knows tuples by the name that they had before 2020-12. And it takes an optional key to be
 * null as well, which neither the server nor a client of ours ever sends. Keys beside a reference would become a second type.
 */
function readable(node) {
  if (Array.isArray(node)) {
    return node.map(readable);
  }
  if (typeof node !== "object" || node === null) {
    return node;
  }
  const { prefixItems, properties, ...rest } = Object.fromEntries(Object.entries(node).map(([key, value]) => [key, readable(value)]));
  const required = new Set(Array.isArray(node.required) ? node.required : []);
  if (rest.$ref !== undefined && Object.keys(rest).length > 1) {
    const { $ref, ...besides } = rest;
    return { ...besides, allOf: [{ $ref }] };
  }
  const withoutNull = ([key, value]) => [key, required.has(key) ? value : present(value)];
  return {
    ...rest,
    ...(prefixItems === undefined ? {} : { items: prefixItems }),
    ...(properties === undefined ? {} : { properties: Object.fromEntries(Object.entries(properties).map(withoutNull)) }),
  };
}

/** The same value where it is there. */
function present({ type, anyOf, ...rest }) {
  const types = Array.isArray(type) ? type.filter((each) => each !== "null") : type;
  const others = anyOf?.filter((each) => each.type !== "null");
  const one = others?.length === 1 ? others[0] : others && { anyOf: others };
  return readable({ ...rest, ...(types === undefined ? {} : { type: types.length === 1 ? types[0] : types }), ...one });
}

const requests = Object.entries(schema.methods).filter(([, { result, sentBy }]) => result !== undefined && sentBy === undefined);
const pair = ({ params, result }) => ({ type: "object", required: ["params", "result"], properties: { params, result } });
const methods = {
  title: "Methods",
  description: "Params and result of each request.",
  type: "object",
  required: requests.map(([method]) => method),
  properties: Object.fromEntries(requests.map(([method, types]) => [method, pair(types)])),
  $defs: schema.$defs,
};
const types = await compile(readable(methods), "Methods", {
  additionalProperties: false,
  bannerComment: "",
  style: { printWidth: 140 },
});
const text = `// Made out of docs/protocol.schema.json by generate-protocol.mjs: edit neither by hand.

/** Version of the name space that these clients speak. */
export const PROTOCOL = ${schema.protocol};

${types}`;

if (!process.argv.includes("--check")) {
  await writeFile(TARGET, text);
} else if ((await readFile(TARGET, "utf8")) !== text) {
  console.error("clients/picture/protocol.ts is not that of docs/protocol.schema.json; make it again with: npm run protocol");
  process.exitCode = 1;
}

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { asOptions } from "../../src/commands/inForce";
import { GAP, initOptions, isPasses, WIRE } from "../../src/commands/init";
import { isAboveZero, numberOf } from "../../src/commands/numbers";
import { choices, machines } from "../../../picture/profiles";
import { linked, pageOf } from "../../src/commands/reportPage";

test("of what is set in VS Code only what no wedm.toml sets becomes an option", () => {
  const check = (inForce: Partial<Parameters<typeof asOptions>[0]>, expected: string): void => {
    assert.equal(asOptions({ correctionFrom: "default", corrections: [0.1], side: "both", ...inForce }).join(" "), expected);
  };
  check({}, "");
  check({ correctionFrom: "client", corrections: [0.12] }, "--correction 0.12");
  check({ correctionFrom: "client", corrections: [0.16, 0.1], side: "auto" }, "--passes 0.16,0.1 --side auto");
  check({ correctionFrom: "file", corrections: [0.12], side: "punch", file: "file:///a/wedm.toml" }, "");
});

test("what is proposed for a wedm.toml are the defaults, and its machines are those of the program", async () => {
  const page = await readFile(new URL("../../../../docs/settings.md", import.meta.url), "utf8");
  const of = (key: string): number => Number(new RegExp(`^${key} = ([\\d.]+)`, "m").exec(page)?.[1]);
  assert.deepEqual([WIRE, GAP], [of("wire-diameter"), of("gap")]);
  const shipped = choices(null, []).flatMap(({ profile }) => profile ?? []);
  assert.deepEqual(machines().map(({ profile }) => profile), ["3b", ...shipped]);
  const options = initOptions({ wire: 0.25, gap: 0.03, passes: 3, machine: "robofil" }, "/w");
  assert.equal(options.join(" "), "init --wire 0.25 --gap 0.03 --passes 3 --machine robofil -- /w");
  assert.deepEqual(["1", " 9 ", "0", "10", "2.5", ""].map(isPasses), [true, true, false, false, false, false]);
});

test("numbers are read as people type them", () => {
  assert.deepEqual(["0.18", " 0,18 ", "1e-1"].map(numberOf), [0.18, 0.18, 0.1]);
  assert.ok(["0.18", "0,18", "1e-1"].every(isAboveZero));
  assert.ok(!["0", "-1", "", " ", "x", "Infinity"].some(isAboveZero));
});

test("a page of a report runs no script but the one that tells of its links", () => {
  const page = linked("<html><head>$&</head><body><a href=\"x%20y.html\">x</a></body></html>", "abc");
  const policy = /<head><meta http-equiv="Content-Security-Policy" content="default-src 'none';[^"]*script-src 'nonce-abc'">/;
  assert.match(page, policy);
  assert.equal(page.match(/<script nonce="abc">/g)?.length, 1);
  assert.ok(page.endsWith("</script>$&</head><body><a href=\"x%20y.html\">x</a></body></html>"));
  assert.deepEqual(["plate.html", "a b+1.html"].map(pageOf), ["plate.html", "a b+1.html"]);
  assert.deepEqual(["../x.html", "a/b.html", "a\\b.html", "x.txt", 1, null].map(pageOf), Array(6).fill(null));
});

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { choices } from "../../../picture/profiles";

test("the profiles that ship are those of the page on programs", async () => {
  const page = await readFile(new URL("../../../../docs/programs.md", import.meta.url), "utf8");
  const table = page.slice(page.indexOf("### Profiles"), page.indexOf("[profiles.NAME]"));
  const shipped = [...table.matchAll(/^\| `([\w-]+)` \|/gm)].map((match) => match[1]);
  assert.ok(shipped.length >= 3);
  const offered = choices(null, []).flatMap(({ profile }) => (profile === undefined ? [] : [profile]));
  assert.deepEqual(offered.sort(), shipped.sort());
});

test("one's own profiles stand behind, and one that changes what ships stands once", () => {
  const shipped = choices(null, []).map(({ label }) => label);
  const names = choices("shop", ["shop", "robofil"]).map(({ label, description }) => [label, description]);
  assert.deepEqual(names[0], ["As the Settings Say", "shop"]);
  assert.deepEqual(names.map(([label]) => label), [...shipped, "shop"]);
});

import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import { test } from "node:test";
import { whyOf } from "../../../picture/why";

const rules = new URL("../../../../docs/", import.meta.url);

for (const folder of ["rules/", "zh/rules/"]) {
  test(`every page of ${folder} says what its rule finds, and not first how severe it is`, async () => {
    const pages = (await readdir(new URL(folder, rules))).filter((name) => name.endsWith(".md") && name !== "README.md");
    assert.ok(pages.length > 50);
    for (const name of pages) {
      const why = whyOf(await readFile(new URL(folder + name, rules), "utf8"));
      assert.ok(why.length >= 8 && !/[`*]|\]\(|severity|默认级别/.test(why), `${name}: ${why}`);
    }
  });
}

test("links and code are plain text in it", () => {
  assert.equal(whyOf("# gap\n\nDefault severity: warning.\n\n## What it does\n\nIt finds `gap` in [a page](x.md),\ntwice.\n"), "It finds gap in a page, twice.");
});

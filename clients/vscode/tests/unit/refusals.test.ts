import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { PAIR_IS_NOT_SET, SIDE_IS_NOT_KNOWN } from "../../../picture/refusals";

/** The server's sentence of a name, in both languages. */
async function sentences(name: string): Promise<string[]> {
  const files = ["en", "zh"].map((language) => new URL(`../../../../src/message/${language}/toolpath.rs`, import.meta.url));
  const texts = await Promise.all(files.map((file) => readFile(file, "utf8")));
  return texts.map((text) => new RegExp(`^ *${name}\\(.*\\) => "(.*)";$`, "m").exec(text)?.[1] ?? "");
}

test("what can be asked is known by the server's sentence, in both languages", async () => {
  for (const sentence of await sentences("side_of_contour_is_not_known")) {
    assert.ok(SIDE_IS_NOT_KNOWN.test(sentence) && !PAIR_IS_NOT_SET.test(sentence), sentence);
  }
  for (const sentence of await sentences("a_pair_needs")) {
    assert.ok(PAIR_IS_NOT_SET.test(sentence) && !SIDE_IS_NOT_KNOWN.test(sentence), sentence);
  }
});

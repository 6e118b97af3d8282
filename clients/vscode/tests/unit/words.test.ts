import assert from "node:assert/strict";
import { readdir, readFile } from "node:fs/promises";
import { test } from "node:test";
import { speak, t } from "../../../picture/words";

const root = new URL("../../", import.meta.url);
const read = (name: string): Promise<string> => readFile(new URL(name, root), "utf8");
const table = async (name: string): Promise<Record<string, string>> => JSON.parse(await read(name)) as Record<string, string>;
const placeholders = (sentence: string): string[] => [...sentence.matchAll(/\{\d+\}/g)].map(([placeholder]) => placeholder).sort();
const isChinese = (sentence: string): boolean => /[\u4e00-\u9fff]/.test(sentence);

/** The sentences of a source: first arguments of `t` and `text`, and the words of profiles, which are handed to it. */
function sentences(source: string): string[] {
  const calls = source.matchAll(/(?<![.\w])(?:t|text)\(\s*("(?:[^"\\]|\\.)*"|'[^']*')/g);
  const quoted = [...calls].map(([, quoted]) => quoted ?? "");
  const meant = [...source.matchAll(/^ {2}\["[\w-]+", ("[^"]*")\],$/gm)].map(([, quoted]) => quoted ?? "");
  return [...quoted, ...meant].map((quoted) => (quoted.startsWith("'") ? quoted.slice(1, -1) : (JSON.parse(quoted) as string)));
}

test("every sentence has its twin, with the same placeholders", async () => {
  const files = await Promise.all(["src", "webview", "../picture"].map((folder) => readdir(new URL(folder, root), { recursive: true }).then((names) => names.map((name) => `${folder}/${name}`))));
  const sources = await Promise.all(files.flat().filter((name) => name.endsWith(".ts") && !name.endsWith("words.ts")).map(read));
  const said = new Set(sources.flatMap(sentences).filter((sentence) => !sentence.startsWith(".")));
  const twins = await table("l10n/bundle.l10n.zh-cn.json");
  assert.deepEqual(Object.keys(twins).sort(), [...said].sort());
  for (const [sentence, twin] of Object.entries(twins)) {
    assert.deepEqual(placeholders(twin), placeholders(sentence), sentence);
    assert.ok(isChinese(twin) || !/[A-Za-z]{3}/.test(twin.replace(/profile/, "")), sentence);
  }
});

test("what the manifest names stands in both languages", async () => {
  const named = new Set([...(await read("package.json")).matchAll(/"%([\w.-]+)%"/g)].map(([, name]) => name));
  const [english, chinese] = [await table("package.nls.json"), await table("package.nls.zh-cn.json")];
  assert.deepEqual(new Set(Object.keys(english)), named);
  assert.deepEqual(Object.keys(chinese).sort(), Object.keys(english).sort());
  assert.deepEqual(Object.entries(chinese).filter(([, sentence]) => !isChinese(sentence)), []);
});

test("a sentence is said in the language that is spoken, and in English where that has none", () => {
  assert.equal(t("cut {0} of {1} mm", 1, 2), "cut 1 of 2 mm");
  speak({ "line {0}": "行 {0}" });
  assert.equal(t("line {0}", 7), "行 7");
  assert.equal(t("cut {0} of {1} mm", 1, 2), "cut 1 of 2 mm");
  speak({});
});

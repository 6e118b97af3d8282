import assert from "node:assert/strict";
import { access, readFile } from "node:fs/promises";
import { test } from "node:test";
import { DRAWING, PROGRAMS } from "../../src/languages";

const root = new URL("../../", import.meta.url);
const manifest = JSON.parse(await readFile(new URL("package.json", root), "utf8")) as {
  activationEvents: string[];
  main: string;
  contributes: {
    languages: { id: string; configuration: string; icon: { light: string; dark: string } }[];
    grammars: { language: string; path: string }[];
    commands: { command: string }[];
    menus: Record<string, { command: string }[]>;
  };
};

test("each language has a grammar, an icon, a configuration, and starts the extension", async () => {
  const ids = manifest.contributes.languages.map((language) => language.id);
  assert.deepEqual(ids, [DRAWING, ...PROGRAMS]);
  assert.deepEqual(manifest.contributes.grammars.map((grammar) => grammar.language), ids);
  for (const id of ids) {
    assert.ok(manifest.activationEvents.includes(`onLanguage:${id}`), id);
  }
  const files = manifest.contributes.languages.flatMap(({ configuration, icon }) => [configuration, icon.light, icon.dark]);
  for (const file of [...files, ...manifest.contributes.grammars.map((grammar) => grammar.path)]) {
    await access(new URL(file, root));
  }
});

test("every command that is offered is registered, and menus offer no other", async () => {
  const source = await readFile(new URL("src/extension.ts", root), "utf8");
  const registered = new Set([...source.matchAll(/^ {4}"(wedm\.[\w.]+)":/gm)].map((match) => match[1]));
  const offered = new Set(manifest.contributes.commands.map(({ command }) => command));
  assert.deepEqual(registered, offered);
  for (const { command } of Object.values(manifest.contributes.menus).flat()) {
    assert.ok(offered.has(command), command);
  }
  // Code lenses of the server name these.
  for (const command of ["wedm.simulate", "wedm.openPicture", "wedm.convertToDxf"]) {
    assert.ok(registered.has(command), command);
  }
});

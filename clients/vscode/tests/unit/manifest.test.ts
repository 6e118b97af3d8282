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
    menus: Record<string, ({ command: string } | { submenu: string })[]>;
    submenus: { id: string }[];
    walkthroughs: { steps: { id: string; media: { markdown: string }; completionEvents: string[] }[] }[];
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
  for (const entry of Object.values(manifest.contributes.menus).flat()) {
    if ("command" in entry) {
      assert.ok(offered.has(entry.command), entry.command);
    } else {
      assert.ok(manifest.contributes.submenus.some(({ id }) => id === entry.submenu), entry.submenu);
    }
  }
  // Code lenses of the server name these.
  for (const command of ["wedm.simulate", "wedm.openPicture", "wedm.convertToDxf"]) {
    assert.ok(registered.has(command), command);
  }
});

test("a walkthrough names commands that are there, and its pages are there in both languages with their pictures", async () => {
  const offered = new Set(manifest.contributes.commands.map(({ command }) => command));
  const steps = manifest.contributes.walkthroughs.flatMap((walkthrough) => walkthrough.steps);
  const events = steps.flatMap(({ completionEvents }) => completionEvents);
  const words = await Promise.all(["package.nls.json", "package.nls.zh-cn.json"].map((file) => readFile(new URL(file, root), "utf8")));
  const named = [...events.join("\n").matchAll(/onCommand:(wedm\.\S+)/g), ...words.join("\n").matchAll(/\(command:(wedm\.\w+)\)/g)];
  for (const [, command = ""] of named) {
    assert.ok(offered.has(command), command);
  }
  const pictures = async (file: string): Promise<(string | undefined)[]> => {
    const page = await readFile(new URL(file, root), "utf8");
    return [...page.matchAll(/!\[[^\]]+\]\(\.\.\/dist\/pictures\/([^)]+)\)/g)].map(([, picture]) => picture);
  };
  for (const { id, media, completionEvents } of steps) {
    assert.ok(completionEvents.length > 0, id);
    const shown = await pictures(media.markdown);
    assert.deepEqual(await pictures(media.markdown.replace(/\.md$/, ".nls.zh-cn.md")), shown);
    for (const picture of shown) {
      await access(new URL(`../../docs/pictures/${picture ?? ""}`, root));
    }
  }
});

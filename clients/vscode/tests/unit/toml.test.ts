import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { keysOf, offers, type Declared } from "../../src/tomlKeys";

const manifest = JSON.parse(readFileSync("package.json", "utf8")) as { contributes: { configuration: { properties: Record<string, Declared> } } };
const keys = keysOf(manifest.contributes.configuration.properties);

test("a wedm.toml is completed from the settings of the manifest", () => {
  const labels = (above: string[], before: string): string[] => offers(keys, above, before).map((offer) => offer.label);
  const holds = (found: string[], expected: string[], others: string[]): void => {
    assert.deepEqual(expected.filter((name) => !found.includes(name)), []);
    assert.deepEqual(others.filter((name) => found.includes(name)), []);
  };
  holds(labels([], ""), ["correction", "wire-diameter", "side", "arc-fit"], ["server.path", "layers", "tab", "program.tab"]);
  holds(labels([], "["), ["program", "passes", "milling", "layers", "rules"], ["correction", "server"]);
  holds(labels(["[program]", 'layout = "compact"'], "le"), ["lead-in", "tab", "closing-overlap"], ["correction", "thickness"]);
  holds(labels(["[program] # mine", "[job]"], ""), ["thickness", "slug-limit"], ["tab"]);
  holds(labels(["[rules]"], "sm"), ["small-radius", "gap"], ["correction"]);
  assert.deepEqual(labels(["[rules]"], "gap = "), ["error", "warning", "information", "hint", "off"]);
  assert.deepEqual(labels([], "side = "), ["both", "auto", "opening", "punch", "left", "right"]);
  assert.deepEqual(labels(["[milling]"], "slot-ends = "), ["true", "false"]);
  assert.deepEqual(labels(["[layers]"], "DIE = "), ["opening", "punch", "both", "left", "right", "line", "ignore"]);
  assert.deepEqual(labels([], "correction = 0.1"), []);
  assert.deepEqual(labels([], "# side = "), []);
});

test("what is written is TOML, in the quotes that stand there", () => {
  const texts = (above: string[], before: string): string[] => offers(keys, above, before).map((offer) => offer.text);
  assert.equal(texts([], "side = ")[1], '"auto"');
  assert.equal(texts([], 'side = "')[1], "auto");
  assert.ok(texts(["[program]"], "").includes("start-hole = "));
  assert.ok(offers(keys, ["[program]"], "").every((offer) => offer.detail !== ""));
});

// How it looks: light, dark, narrow, in Chinese; nothing lies over another or runs out of the window.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { Bench } from "./bench";
import { type PageChecks, expectEqual, expectSoon } from "./checks";
import { PROJECT } from "./paths";

const picture = (name: string): Promise<string> => readFile(join(PROJECT, "docs/pictures", name), "utf8");
const PLATE = await readFile(join(PROJECT, "src/cli/demo/plate.dxf"), "utf8");
const FILES = { "plate.dxf": PLATE, "die.dxf": await picture("die.dxf"), "slot.dxf": await picture("slot.dxf"), "wedm.toml": 'side = "opening"\n[layers]\nPLATE = "ignore"\n' };
const NARROW = { width: 400, height: 760 };

export async function look(checks: PageChecks): Promise<void> {
  const bench = await Bench.start(FILES, { colorScheme: "light" });
  checks.bench = bench;
  const { page } = bench;
  const fits = async (): Promise<void> => {
    const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    expectEqual("as wide as the window", (wide ?? 0) <= (seen ?? 0), true);
  };

  await checks.check("light", async () => {
    await bench.open("plate.dxf");
    await bench.finding("small-radius").click();
    await page.locator("#card h2").waitFor();
    await bench.shot("light");
    await fits();
  });

  await checks.check("dark, by the switch, which is remembered", async () => {
    await page.locator("#theme").click();
    await expectSoon("dark", async () => (await page.locator(":root").getAttribute("data-theme")) === "dark");
    await page.reload();
    await bench.finding("small-radius").click();
    await page.locator("#card h2").waitFor();
    await bench.shot("dark");
    await page.locator("#theme").click();
  });

  await checks.check("in a narrow window one pane at a time", async () => {
    await page.setViewportSize(NARROW);
    await expectSoon("the picture alone", async () => (await page.locator("#middle").isVisible()) && !(await page.locator("#left").isVisible()));
    await bench.shot("narrow");
    await fits();
    await page.locator("#exports > button").click();
    await bench.shot("narrow-menu");
    await fits();
    await page.keyboard.press("Escape");
    await page.locator("#panes [data-pane=right]").click();
    await page.locator("#right").waitFor();
    await bench.shot("narrow-lists");
    await page.locator("#panes [data-pane=left]").click();
    await bench.file("die.dxf").click();
    await page.locator("#middle").waitFor();
    await page.locator("#document", { hasText: "die.dxf" }).waitFor();
    await page.setViewportSize({ width: 1280, height: 800 });
  });

  await checks.check("in Chinese every sentence is Chinese", async () => {
    await page.locator("#language").click();
    await page.locator("#tab-findings", { hasText: "问题" }).waitFor();
    await bench.open("plate.dxf");
    await bench.finding("small-radius").click();
    await page.locator("#card h2", { hasText: "补偿量" }).waitFor();
    await bench.shot("chinese");
    await page.locator("#settings").click();
    await page.locator("dialog h2", { hasText: "设置" }).waitFor();
    await bench.shot("chinese-settings");
    const texts = await page.locator("button, label, h2").allInnerTexts();
    const english = texts.filter((text) => /[a-z]{4,}/.test(text.replace(/wedm\.toml|wedm|generic|fast-wire|robofil|small-radius|English/gi, "")));
    expectEqual("English", english, []);
    await page.keyboard.press("Escape");
  });

  await checks.check("what cannot be seen is said: every control has a name", async () => {
    const nameless = await page.locator("button, input, select").evaluateAll((all) =>
      all.filter((each) => each instanceof HTMLElement && each.innerText.trim() === "" && !each.ariaLabel && !each.closest("label")).map((each) => each.outerHTML));
    expectEqual("without a name", nameless, []);
  });
}

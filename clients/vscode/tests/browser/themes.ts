// The picture and its page in the dark and the light theme of VS Code: looked at in screenshots, and read by contrast.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { type WindowChecks, expectSoon } from "./checks";
import { PLATE } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import type { Frame } from "playwright-core";
import { Window } from "./window";

const SMALL = await readFile(join(PROJECT, "docs/pictures/small-radius.dxf"), "utf8");
const PROGRAM = await readFile(join(PROJECT, "tests/data/hole.3b"), "utf8");
const THEMES = { dark: "Default Dark Modern", light: "Default Light Modern" };
/** The contrasts of WCAG 2.1: for text, and for graphics. */
const READ = 4.5;
const SEEN = 3;
const TEXTS = [
  "#title, #note, #alert, #place, #scale-text, .chip, .chip i, .chip span, .rule, #where, #motion, #block",
  "#card h2, #card p, #card .name, #card .link, #trouble, #speed",
].join(", ");
const LINES = "svg .contour, svg .wire, svg .fault, svg .lead:not(.back)";

type Colour = [red: number, green: number, blue: number, opacity: number];

/** All of these that are visible and have too little contrast with their background. */
async function faint(page: Frame): Promise<string[]> {
  return page.evaluate(
    ([texts, lines, read, seen]) => {
      const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
      const rgb = (colour: string): Colour => {
        if (canvas === null) {
          return [0, 0, 0, 1];
        }
        canvas.clearRect(0, 0, 1, 1);
        canvas.fillStyle = colour;
        canvas.fillRect(0, 0, 1, 1);
        const [r = 0, g = 0, b = 0, a = 0] = canvas.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
      };
      const over = ([r, g, b, a]: Colour, [x, y, z]: Colour): Colour => [r * a + x * (1 - a), g * a + y * (1 - a), b * a + z * (1 - a), 1];
      const light = ([r, g, b]: Colour): number => {
        const linear = (part: number): number => (part / 255 <= 0.03928 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
        return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
      };
      const groundOf = (element: Element | null): Colour => {
        if (element === null) {
          return rgb(getComputedStyle(document.documentElement).getPropertyValue("--vscode-editor-background"));
        }
        const own = rgb(getComputedStyle(element).backgroundColor);
        return own[3] === 1 ? own : over(own, groundOf(element.parentElement));
      };
      const check = (selector: string, least: number, part: "color" | "stroke"): string[] =>
        Array.from(document.querySelectorAll(selector)).flatMap((element: Element) => {
          const { width, height } = element.getBoundingClientRect();
          if (width + height === 0 || (part === "color" && element.textContent.trim() === "")) {
            return [];
          }
          const ground = groundOf(element);
          const colour = getComputedStyle(element)[part];
          const [a, b] = [light(over(rgb(colour), ground)), light(ground)];
          const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
          const name = `${element.tagName.toLowerCase()}#${element.id}.${element.getAttribute("class") ?? ""}`;
          return contrast < least ? [`${name}: ${contrast.toFixed(2)} (${colour})`] : [];
        });
      return [...new Set([...check(texts, read, "color"), ...check(lines, seen, "stroke")])];
    },
    [TEXTS, LINES, READ, SEEN] as const,
  );
}

export async function themes(checks: WindowChecks): Promise<void> {
  for (const [name, theme] of Object.entries(THEMES)) {
    const settings = { "wedm.server.path": WEDM, "wedm.correction": 0.1, "wedm.wireDiameter": 0.18, "wedm.gap": 0.01, "workbench.colorTheme": theme };
    const pair = { "wedm.pair.drawnAs": "punch", "wedm.pair.clearance": 0.005 };
    const host = await Host.start({ ...settings, ...pair }, { "plate.dxf": PLATE, "small-radius.dxf": SMALL, "way.3b": PROGRAM });
    const window = new Window(host.page);
    checks.page = host.page;
    try {
      await window.openOurs("small-radius.dxf");
      await window.squiggles.first().waitFor();
      await checks.check(`${name}: the picture, its chips and what is wrong can be read`, async () => {
        await window.command("Wire EDM: Open Picture Beside");
        const page = await window.picture();
        await expectSoon("chips", async () => (await page.locator("#faults .chip").count()) >= 4);
        await checks.shot(`theme-${name}-picture`);
        const tooFaint = await faint(page);
        await window.close("Picture of");
        await host.page.locator("iframe.webview.ready:visible").waitFor({ state: "detached" });
        await expectNone(tooFaint);
      });
      await checks.check(`${name}: the card of a finding can be read`, async () => {
        await window.command("Wire EDM: Open as Picture");
        const page = await window.picture();
        await page.locator("svg .mark .badge").first().waitFor({ state: "attached" });
        await window.clickDrawnUntil(page.locator("svg .mark").first().locator(".badge"), "the card of the finding", () => page.locator("#card .primary").isVisible());
        await checks.shot(`theme-${name}-card`);
        await expectNone(await faint(page));
        await host.page.keyboard.press("Control+w");
      });
      await checks.check(`${name}: the way of a program can be read while it is played`, async () => {
        await window.openOurs("way.3b");
        await window.command("Wire EDM: Open Picture Beside");
        const page = await window.pictureOf("way.3b");
        await page.locator("#player").waitFor();
        await page.locator("#slider").fill("400");
        await checks.shot(`theme-${name}-player`);
        await expectNone(await faint(page));
      });
    } finally {
      await host.stop();
    }
  }
}

async function expectNone(faint: readonly string[]): Promise<void> {
  if (faint.length > 0) {
    throw new Error(`too faint:\n    ${faint.join("\n    ")}`);
  }
  return Promise.resolve();
}

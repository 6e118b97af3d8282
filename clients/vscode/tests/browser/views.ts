// Whatever is looked at answers: list and problems lead into the picture where that is in front; marks have one number everywhere; the
// toolbar makes programs and repairs in the picture that is there; files that are broken or no texts are shown as what they are.

import { readFile, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Frame } from "playwright-core";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { binary, dxb, PLATE } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import { Window } from "./window";

const SMALL = await readFile(join(PROJECT, "docs/pictures/small-radius.dxf"), "utf8");
const RADII = ["0.080", "0.040", "0.060", "0.050"];

export async function views(checks: WindowChecks): Promise<void> {
  const settings = { "wedm.server.path": WEDM, "wedm.correction": 0.1, "workbench.editorAssociations": {} };
  const files = { "small-radius.dxf": SMALL, "plate.dxf": PLATE, "broken.dxf": "  0\nSECTION\n  2\nENTITIES\nnothing\n", "binary.dxf": binary(SMALL), "plate.dxb": dxb() };
  const host = await Host.start(settings, files);
  const window = new Window(host.page);
  checks.page = host.page;
  const texts = host.page.locator(".editor-group-container .view-lines");
  const webviews = host.page.locator("iframe.webview.ready");
  try {
    await host.page.locator('.activitybar [aria-label*="Wire EDM"]').first().waitFor();
    await window.open("small-radius.dxf");
    const page = await window.pictureOf("small-radius.dxf");
    await expectSoon("four faults", async () => (await page.locator("svg .drawing .fault").count()) === 4);
    await window.command("Wire EDM: Show Radius List");
    const row = host.page.locator(".sidebar .monaco-list-row", { hasText: "R 0.040" });
    await row.waitFor();
    await checks.check("a radius in the list is selected and framed in the picture that is in front", async () => {
      await actUntil("the radius from near", () => row.click(), () => page.locator("svg.close .correction.fine").first().isVisible());
      expectEqual("selected", await page.locator("svg .fault.selected").getAttribute("data-segment"), "4");
      expectEqual("texts", await texts.count(), 0);
      await checks.shot("list-to-picture");
    });
    await checks.check("marks are numbered alike in picture, strip and list", async () => {
      await page.locator("#fit").click();
      for (const [index, radius] of RADII.entries()) {
        const mark = page.locator("svg .mark", { hasText: `R ${radius}` });
        expectEqual(`mark of R ${radius}`, await mark.locator(".count").textContent(), String(index + 1));
        expectEqual(`chip of R ${radius}`, await page.locator("#chips .chip", { hasText: radius }).locator("i").innerText(), String(index + 1));
        const listed = await host.page.locator(".sidebar .monaco-list-row", { hasText: `R ${radius}` }).innerText();
        expectEqual(`row of R ${radius}`, listed.includes("①②③④"[index] ?? "?"), true);
      }
    });
    await checks.check("a problem is shown in the picture that is in front, with what would repair it", async () => {
      await window.command("Problems: Focus on Problems View");
      const problem = host.page.locator(".markers-panel .monaco-list-row", { hasText: "R 0.060 mm" });
      await problem.waitFor();
      await problem.click();
      const show = host.page.locator(".action-widget .monaco-list-row.action, .monaco-menu .action-item", { hasText: "Show in the Picture" }).first();
      const card = page.locator("#card h2", { hasText: "R 0.060 mm" });
      // A menu that has just come up takes no click.
      const choose = async (): Promise<void> => {
        if (!(await show.isVisible())) {
          await problem.click();
          await window.press("Control+.", show);
        }
        await host.page.waitForTimeout(300);
        await show.click({ timeout: 2_000 }).catch(() => undefined);
      };
      await actUntil("its card", choose, () => card.isVisible());
      await expectSoon("it selected", async () => (await page.locator("svg .fault.selected").getAttribute("data-segment")) === "8");
      expectEqual("texts", await texts.count(), 0);
      await checks.shot("problem-to-picture");
      await window.hidePanel();
    });
    await checks.check("in the text the findings have the numbers of their marks", async () => {
      await page.locator("#text").click();
      await texts.first().waitFor();
      await window.goToLine(50);
      const numbers = (): Promise<string> => host.page.evaluate(() => Array.from(document.querySelectorAll(".view-line span"), (span) => getComputedStyle(span, "::after").content).join(""));
      await expectSoon("② beside R 0.040", async () => (await numbers()).includes("②"), numbers);
      await checks.shot("text-numbers");
    });
    await checks.check("with the text in front a row of the list leads into the text", async () => {
      await actUntil("the line of the row", () => row.click(), async () => (await window.line()) === 50);
      await host.page.keyboard.press("Control+1");
      await actUntil("the text closed", () => host.page.keyboard.press("Control+w"), async () => (await texts.count()) === 0);
      await window.open("small-radius.dxf");
    });
    const again = await window.pictureOf("small-radius.dxf");
    await checks.check("Fix all and Program stand in the toolbar of the picture, which is the only one", async () => {
      await again.locator("#fix-all").click();
      await expectSoon("no faults", async () => (await again.locator("svg .drawing .fault").count()) === 0);
      await expectSoon("nothing left to fix", () => again.locator("#fix-all").isHidden());
      await again.locator("#program").selectOption("3b");
      const asked = host.page.locator(".quick-input-widget", { hasText: "Which Side Does the Wire Run On?" });
      await asked.getByText("By Nesting").waitFor();
      await expectSoon("the contour marked", async () => (await again.locator("svg .contour.selected").count()) === 14);
      expectEqual("pictures", await webviews.count(), 1);
      await checks.shot("program-from-picture");
      await asked.locator("input").fill("Opening");
      await host.page.keyboard.press("Enter");
      const target = join(host.folder, "made.3b");
      await window.path(target);
      await expectSoon("a program", async () => (await readFile(target, "utf8")).endsWith("DD\n"));
      await window.tab("made.3b");
      expectEqual("says its name again", await again.locator("#program").inputValue(), "");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("they stand in the title of the editor, too", async () => {
      await window.open("plate.dxf");
      await window.pictureOf("plate.dxf");
      const tools = host.page.locator(".editor-group-container.active .editor-actions");
      await tools.locator('[aria-label^="Wire EDM: Fix All"], [aria-label^="Fix All"]').first().waitFor();
      const entry = host.page.locator(".monaco-menu .action-item", { hasText: "Generate ISO Program" });
      await actUntil("the menu", () => tools.locator('[aria-label="Program"], [aria-label^="Program"]').first().click(), () => entry.isVisible());
      await checks.shot("program-menu");
      await host.page.keyboard.press("Escape");
    });
    await checks.check("a broken file says in the empty space what is wrong with it", async () => {
      await window.open("broken.dxf");
      const broken = await broughtUp(window, "broken.dxf");
      await expectSoon("the reason", async () => (await broken.locator("#trouble").innerText()).includes("group code"), () => broken.locator("#trouble").innerText());
      await checks.shot("broken-file");
    });
    await checks.check("a binary DXF opens as a picture that is looked at only", async () => {
      await window.ask("Control+p", "binary.dxf", "binary.dxf");
      await host.page.keyboard.press("Enter");
      const shown = await window.pictureOf("binary.dxf");
      await expectSoon("four faults", async () => (await shown.locator("svg .drawing .fault").count()) === 4);
      expectEqual("chips", await shown.locator("#chips .chip").count(), 4);
      expectEqual("nothing to make", await shown.locator("#program:visible, #fix-all:visible, #text:visible").count(), 0);
      await shown.locator("#chips .chip").first().click();
      await shown.locator("svg.close .correction.fine").first().waitFor();
      await checks.shot("binary-dxf");
      await expectSoon("one tab of it", async () => (await host.page.locator('.tabs-container .tab[data-resource-name="binary.dxf"]').count()) === 1);
    });
    await checks.check("a DXB does, too, and is drawn again when it is saved", async () => {
      await window.open("plate.dxb");
      const shown = await window.pictureOf("plate.dxb");
      await expectSoon("its contour", async () => (await shown.locator("svg .drawing .contour").count()) === 4, async () => String(await shown.locator("svg .drawing .contour").count()));
      await checks.shot("dxb");
      await writeFile(join(host.folder, "plate.dxb"), dxb().subarray(0, -60));
      await expectSoon("why it breaks off", async () => (await shown.locator("#trouble").innerText()) !== "", () => shown.locator("#faults").innerText());
    });
    await checks.check("one broken number of the settings leaves the others in force", async () => {
      await window.open("plate.dxf");
      await window.hold(host.folder, 'correction = "abc"\nwire-diameter = 0.3\ngap = 0.02\nside = "auto"\n', "0.170");
      await rm(join(host.folder, "wedm.toml"));
    });
    await checks.check("the settings begin with the wire, and a choice that is not made is not set", async () => {
      await window.command("Preferences: Open Settings (UI)");
      const search = host.page.locator(".settings-editor .suggest-input-container .monaco-editor").first();
      await search.click();
      await host.page.keyboard.type("@ext:wedm.wedm");
      const names = host.page.locator(".settings-editor .setting-item-label");
      await expectSoon("wire diameter first", async () => (await names.first().innerText()) === "Wire Diameter", () => names.allInnerTexts().then(String));
      const side = host.page.locator('.settings-editor [data-key="wedm.side"] select');
      await expectSoon("the side not set", async () => (await side.evaluate((select: HTMLSelectElement) => select.selectedOptions[0]?.text ?? "")).startsWith("not set"), () => side.innerText());
      expectEqual("null", (await host.page.locator(".settings-editor").innerText()).includes("null"), false);
      await checks.shot("settings");
    });
  } finally {
    await host.stop();
  }
}

/** The page of a picture in which nothing is drawn. */
async function broughtUp(window: Window, name: string): Promise<Frame> {
  await window.tab(name);
  let found: Frame | undefined;
  await expectSoon(`the page of ${name}`, async () => {
    found = await window.picture(false);
    return found.locator("#trouble").isVisible();
  });
  if (found === undefined) {
    throw new Error(`there is no page of ${name}`);
  }
  return found;
}

// A drawing as text: squiggle, Problems, hover, hints, quick fix, undo, fix all, the correction in the status bar.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { FILLET, lineOf } from "./drawings";
import { Host } from "./host";
import { Window } from "./window";

const BULGE = "0.41421356237309503";

export async function text(checks: WindowChecks): Promise<void> {
  // As the README has it installed.
  const host = await Host.start({ "wedm.side": "opening" }, { "plate.dxf": FILLET }, { path: "/usr/bin:/bin", isInstalled: true });
  const window = new Window(host.page);
  const file = join(host.folder, "plate.dxf");
  const line = lineOf(FILLET, BULGE);
  checks.page = host.page;
  try {
    await checks.check("an arc too tight is underlined", async () => {
      await window.openText("plate.dxf");
      await window.squiggles.first().waitFor();
      expectEqual("squiggles", await window.squiggles.count(), 1);
      const label = await host.page.locator(".tabs-container .tab.active").getAttribute("aria-label");
      expectEqual("tab", label?.includes("plate.dxf"), true);
    });
    await checks.check("the language has its name and its colours", async () => {
      await host.page.locator('.statusbar-item[id="status.editor.mode"]', { hasText: "DXF" }).waitFor();
      const colours = await host.page.locator(".view-line span span").evaluateAll((spans) => new Set(spans.map((span) => getComputedStyle(span).color)).size);
      expectEqual("colours", colours >= 4, true);
    });
    await checks.check("the radius stands beside the bulge", async () => {
      await host.page.locator(".view-lines", { hasText: "R 0.05 mm" }).waitFor();
    });
    await checks.check("sections and entities are the outline", async () => {
      await window.goToLine(1);
      const outline = host.page.locator(".quick-input-widget .monaco-list-row");
      await window.press("Control+Shift+o", outline.filter({ hasText: "ENTITIES" }).first());
      await outline.filter({ hasText: "LWPOLYLINE" }).first().waitFor();
      await host.page.keyboard.press("Escape");
    });
    await checks.check("it is listed under Problems", async () => {
      await expectSoon("one problem of small-radius", async () => (await window.problems()).some((row) => row.includes("arc R 0.050 mm is below the correction 0.100 mm") && row.includes("small-radius")), async () => (await window.problems()).join("\n"));
      await checks.shot("problems");
      await window.hidePanel();
      await window.goToLine(line);
    });
    await checks.check("the status bar has the correction in force, and changes it", async () => {
      const inForce = "0.100 mm (default), opening, drawn in mm";
      await expectSoon(inForce, async () => (await window.status.innerText()).includes(inForce), () => window.status.innerText());
      await checks.shot("against");
      const input = host.page.locator(".quick-input-widget input");
      const ask = (): Promise<void> => actUntil("the question for the correction", () => window.status.click(), () => input.isVisible());
      await ask();
      await input.fill("0.04");
      await host.page.keyboard.press("Enter");
      await window.squiggles.first().waitFor({ state: "hidden" });
      await expectSoon("0.040 mm", async () => (await window.status.innerText()).includes("0.040 mm"), () => window.status.innerText());
      await ask();
      await input.fill("");
      await host.page.keyboard.press("Enter");
      await window.squiggles.first().waitFor();
    });
    await checks.check("hover says what the number is", async () => {
      await window.goToLine(line, 3);
      await window.hover("bulge");
    });
    await checks.check("the quick fix is applied and saved, and nothing else is changed", async () => {
      await window.goToLine(line, 3);
      const first = await window.quickFix();
      await checks.shot("quick-fix");
      expectEqual("first fix", (await first.innerText()).includes("R 0.101 mm"), true);
      await host.page.keyboard.press("Enter");
      await window.squiggles.first().waitFor({ state: "hidden" });
      const before = FILLET.split("\n");
      // Of a file that is being written only a part may be seen.
      const written = async (): Promise<string> => {
        const after = (await readFile(file, "utf8")).split("\n");
        return `${after.length - before.length} lines more, ${after.filter((text, index) => text !== before[index]).length} changed`;
      };
      await window.save("two lines changed in the file", async () => (await written()) === "0 lines more, 2 changed", written);
    });
    await checks.check("undo brings the old numbers and the finding back", async () => {
      await host.page.keyboard.press("Control+z");
      await window.squiggles.first().waitFor();
      await window.save("the old file", async () => (await readFile(file, "utf8")) === FILLET);
    });
    await checks.check("fix all repairs in one undo step", async () => {
      await window.command("Wire EDM: Fix All That Is Safe to Fix");
      await window.notification("1 finding repaired, none left.").waitFor();
      await window.squiggles.first().waitFor({ state: "hidden" });
      await host.page.keyboard.press("Control+z");
      await window.squiggles.first().waitFor();
      await window.save("the old file", async () => (await readFile(file, "utf8")) === FILLET);
    });
    await checks.check("saving repairs, where that is set as the README says", async () => {
      await mkdir(join(host.folder, ".vscode"), { recursive: true });
      await writeFile(join(host.folder, ".vscode/settings.json"), JSON.stringify({ "editor.codeActionsOnSave": { "source.fixAll.wedm": "explicit" } }));
      await window.goToLine(line, 1);
      const repaired = async (): Promise<boolean> => {
        // The setting is in force a moment later.
        await host.page.keyboard.press("Control+s");
        await host.page.waitForTimeout(300);
        return /^19\.899\r?$/m.test(await readFile(file, "utf8"));
      };
      await expectSoon("a file that is repaired", repaired, () => readFile(file, "utf8"));
      await window.squiggles.first().waitFor({ state: "hidden" });
    });
    await checks.check("tables, rules and their severities are completed in a wedm.toml", async () => {
      await writeFile(join(host.folder, "wedm.toml"), "");
      await window.openText("wedm.toml");
      const offered = host.page.locator(".suggest-widget.visible .monaco-list-row");
      const complete = async (typed: string, whole: string): Promise<void> => {
        await host.page.keyboard.type(typed, { delay: 50 });
        const wanted = offered.filter({ hasText: whole }).first();
        // What is offered while one types may come too late for that: then it is asked for.
        await expectSoon(whole, () => wanted.isVisible(), undefined, 8_000).catch(() => window.press("Control+Space", wanted));
        await checks.shot(`settings-${whole}`);
        await host.page.keyboard.press("Enter");
        await offered.first().waitFor({ state: "hidden" });
      };
      await complete("corr", "correction");
      await host.page.keyboard.type("0.04\n");
      await complete("[ru", "rules");
      await host.page.keyboard.press("End");
      await host.page.keyboard.type("\n");
      await complete("small", "small-radius");
      await complete("warn", "warning");
      const written = (): Promise<string> => readFile(join(host.folder, "wedm.toml"), "utf8");
      await window.save("the settings", async () => (await written()) === 'correction = 0.04\n[rules]\nsmall-radius = "warning"', written);
    });
  } finally {
    await host.stop();
  }
}

// What the page shows while a picture is made and while the text is broken; the page alone.

import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { openAlone, shown, tell } from "./alone";
import { type WindowChecks, expectEqual, expectSoon } from "./checks";
import { PLATE } from "./drawings";
import { WEDM } from "./paths";
import { startBrowser } from "./start";

export async function states(checks: WindowChecks): Promise<void> {
  const folder = await mkdtemp(join(tmpdir(), "states-"));
  const browser = await startBrowser();
  try {
    await writeFile(join(folder, "plate.dxf"), PLATE);
    await promisify(execFile)(WEDM, ["draw", "plate.dxf", "--side", "auto", "-o", "plate.svg"], { cwd: folder });
    const svg = await readFile(join(folder, "plate.svg"), "utf8");
    const page = await openAlone(browser, folder);
    checks.page = page;
    const opacity = (selector: string): Promise<number> =>
      page.locator(selector).evaluate((element) => Number(getComputedStyle(element).opacity));
    await checks.check("a busy sign comes when a picture takes longer than a moment, and goes with it", async () => {
      expectEqual("at rest", await page.locator("#busy").isHidden(), true);
      await tell(page, { type: "busy", busy: true });
      await expectSoon("the sign", async () => (await opacity("#busy")) === 1);
      expectEqual("said to those who do not see it", await page.locator("#busy").getAttribute("aria-label"), "The picture is being made");
      await checks.shot("busy");
      await tell(page, { type: "busy", busy: false });
      await page.locator("#busy").waitFor({ state: "hidden" });
    });
    const contours = page.locator("#stage > svg .contour");
    await checks.check("the last good picture stays, dimmed, while the text is broken, with the sentence that says so", async () => {
      await tell(page, shown({ svg }));
      await expectSoon("the picture", async () => (await contours.count()) > 0);
      expectEqual("in full", await opacity("#stage > svg"), 1);
      const drawn = await contours.count();
      const faults = [{ severity: "error" as const, rule: "syntax", message: "expected a number, found abc", line: 7 }];
      const empty = svg.slice(0, svg.indexOf(">") + 1) + "</svg>";
      await tell(page, shown({ svg: empty, faults }));
      await page.locator("#trouble", { hasText: "expected a number, found abc" }).waitFor();
      await expectSoon("dimmed", async () => (await opacity("#stage > svg")) === 0.45, () => opacity("#stage > svg").then(String));
      expectEqual("contours", await contours.count(), drawn);
      await checks.shot("broken");
    });
    await checks.check("mended, it is drawn in full again", async () => {
      await tell(page, shown({ svg }));
      await page.locator("#trouble").waitFor({ state: "hidden" });
      await expectSoon("in full", async () => (await opacity("#stage > svg")) === 1);
    });
    await checks.check("what is cut is the figure of the title, at the end of the way too", async () => {
      const title = /cut ([\d.]+) mm/.exec(await page.locator("#note").innerText())?.[1];
      expectEqual("in the title", title !== undefined, true);
      const where = page.locator("#where");
      expectEqual("of", /of ([\d.]+) mm/.exec(await where.innerText())?.[1], title);
      await page.locator("#slider").evaluate((slider: HTMLInputElement) => {
        slider.value = slider.max;
        slider.dispatchEvent(new Event("input"));
      });
      await expectSoon("all of it cut", async () => (await where.innerText()).includes(`cut ${title ?? ""} of ${title ?? ""} mm`), () => where.innerText());
    });
  } finally {
    await browser.close();
    await rm(folder, { recursive: true, force: true });
  }
}

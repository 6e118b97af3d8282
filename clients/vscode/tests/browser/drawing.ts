// A drawing that opens as its picture: findings are acted upon, settings of contours saved, the text is one click away, the picture saved.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { PLATE } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import { Window } from "./window";

const SMALL = await readFile(join(PROJECT, "docs/pictures/small-radius.dxf"), "utf8");

export async function drawing(checks: WindowChecks): Promise<void> {
  const settings = { "wedm.server.path": WEDM, "wedm.correction": 0.1, "workbench.editorAssociations": {} };
  const host = await Host.start(settings, { "plate.dxf": PLATE, "small-radius.dxf": SMALL });
  const window = new Window(host.page);
  checks.page = host.page;
  const kept = join(host.folder, "wedm.toml");
  try {
    await checks.check("a file of the Explorer is opened", async () => {
      // VS Code asks no extension before it knows them: in the first moment everything is a text.
      await host.page.locator('.activitybar [aria-label*="Wire EDM"]').first().waitFor();
      await window.open("small-radius.dxf");
      await window.picture();
    });
    const page = await window.pictureOf("small-radius.dxf");
    await checks.check("a drawing opens as its picture, and its correction stands in the status bar", async () => {
      await expectSoon("four faults", async () => (await page.locator("svg .drawing .fault").count()) === 4);
      await expectSoon("0.100 mm", async () => (await window.status.innerText()).includes("0.100 mm"), () => window.status.innerText());
      expectEqual("texts", await host.page.locator(".editor-group-container .view-lines").count(), 0);
      await checks.shot("drawing");
    });
    await checks.check("a fault that is clicked says what and why, and shows what would repair it", async () => {
      const card = page.locator("#card");
      const title = card.locator("h2", { hasText: "is below the correction 0.100 mm" });
      await window.clickDrawnUntil(page.locator("svg .mark").first().locator(".badge"), "the card of the fault", () => title.isVisible());
      await card.locator(".primary", { hasText: "Fix: " }).waitFor();
      await page.locator("svg .ghost").waitFor({ state: "attached" });
      expectEqual("why", ((await card.locator("p").innerText()).length) > 40, true);
      await checks.shot("drawing-card");
    });
    await checks.check("the card makes way for what it is about", async () => {
      for (let index = 0; index < 4; index += 1) {
        const badge = page.locator("svg .mark").nth(index).locator(".badge");
        await page.locator("#card .close").click();
        await window.clickDrawnUntil(badge, "the card of the fault", () => page.locator("#card .primary").isVisible());
        expectEqual(`mark ${index + 1} is covered`, await window.overlap(page.locator("#card"), badge), false);
      }
      await page.locator("#card .close").click();
      await window.clickDrawnUntil(page.locator("svg .mark").first().locator(".badge"), "the card of the fault", () => page.locator("#card .primary").isVisible());
    });
    await checks.check("Fix repairs it, as one edit of the document", async () => {
      await page.locator("#card .primary").click();
      await expectSoon("three faults", async () => (await page.locator("svg .drawing .fault").count()) === 3);
      await page.locator("#stage").click({ position: { x: 5, y: 200 } });
      await host.page.keyboard.press("Control+z");
      await expectSoon("four faults again", async () => (await page.locator("svg .drawing .fault").count()) === 4);
    });
    await checks.check("the text is one click away", async () => {
      const line = host.page.locator(".editor-group-container.active .view-lines .view-line").first();
      await actUntil("the text", () => page.locator("#text").click(), () => line.isVisible());
      await host.page.keyboard.press("Control+w");
    });
    await window.open("plate.dxf");
    const plate = await window.pictureOf("plate.dxf");
    await checks.check("the wire side of a contour is set in the picture and kept in wedm.toml", async () => {
      await expectSoon("why there is no path", async () => (await plate.locator("#alert").innerText()).includes("no wire path: "));
      for (const [handle, role] of [["2A", "Punch"], ["2B", "Opening"]] as const) {
        await window.openContour(plate, handle);
        await plate.locator("#card button", { hasText: role }).click();
        await expectSoon(`${handle} kept`, async () => (await readFile(kept, "utf8").catch(() => "")).includes(`[drawings."plate.dxf".contours.${handle}]\nside = "${role.toLowerCase()}"`));
      }
      await plate.locator("svg .wire").first().waitFor({ state: "attached" });
      await expectSoon("a title", async () => (await plate.locator("#title").innerText()) === "plate.dxf · contours and wire path", () => plate.locator("#title").innerText());
      await checks.shot("drawing-sides");
    });
    await checks.check("thread hole and order are set there, too", async () => {
      await window.openContour(plate, "2B");
      await plate.locator("#card .row", { hasText: "Thread hole" }).getByText("Pick…").click();
      const stage = await host.page.locator("iframe.webview.ready:visible").boundingBox();
      const at = await plate.locator('svg .contour[data-handle="2B"]').first().evaluate((path: SVGGraphicsElement) => {
        const box = path.getBoundingClientRect();
        return { x: box.x + box.width * 0.5, y: box.y + box.height * 0.6 };
      });
      await host.page.mouse.click((stage?.x ?? 0) + at.x, (stage?.y ?? 0) + at.y);
      await expectSoon("a thread hole", async () => /contours\.2B\]\nside = "opening"\nthread = \[[\d.]+, [\d.]+\]/.test(await readFile(kept, "utf8")), () => readFile(kept, "utf8"));
      await window.openContour(plate, "2B");
      await plate.locator("#card input").fill("1");
      await plate.locator("#card input").press("Enter");
      await expectSoon("its place", async () => (await readFile(kept, "utf8")).includes("order = 1"), () => readFile(kept, "utf8"));
      await expectSoon("the contour of the card marked", async () => (await plate.locator('svg .contour.selected[data-handle="2B"]').count()) > 0);
      await checks.shot("drawing-contour");
    });
    await checks.check("the picture is saved as PDF", async () => {
      await plate.locator("#export").click();
      const target = join(host.folder, "plate.pdf");
      await window.path(target);
      await expectSoon("a PDF", async () => (await readFile(target, "latin1")).startsWith("%PDF-"));
    });
  } finally {
    await host.stop();
  }
}

// Makes the picture of the README: the plate of the demonstration, its text, its radii and its picture.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { type WindowChecks, expectSoon } from "./checks";
import { lineOf } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import { Window } from "./window";

/** The bulge of the tightest arc. */
const BULGE = "0.4142135624";
const PICTURE = join(PROJECT, "docs/pictures/vscode.png");

export async function readme(checks: WindowChecks): Promise<void> {
  const plate = await readFile(join(PROJECT, "src/cli/demo/plate.dxf"), "utf8");
  const settings = {
    "wedm.server.path": WEDM,
    "wedm.layers": { PLATE: "ignore" },
    "wedm.side": "opening",
    "editor.stickyScroll.enabled": false,
    "editor.scrollBeyondLastLine": false,
    "breadcrumbs.enabled": false,
    "editor.occurrencesHighlight": "off",
  };
  const view = { viewport: { width: 1280, height: 780 }, deviceScaleFactor: 1.5 };
  const host = await Host.start(settings, { "plate.dxf": plate }, { view });
  const window = new Window(host.page);
  checks.page = host.page;
  const line = lineOf(plate, BULGE, 3);
  try {
    await checks.check("the picture of the README", async () => {
      await window.openOurs("plate.dxf");
      await window.command("Wire EDM: Open Picture Beside");
      const page = await window.picture();
      await window.command("Wire EDM: Show Radius List");
      await window.goToLine(line);
      await expectSoon("the fault selected", async () => (await page.locator("svg .fault.selected").count()) === 1);
      await drag(window, 347, 296);
      await drag(window, 788, 640);
      await page.locator("#fit").evaluate((button: HTMLElement) => {
        button.click();
      });
      await host.page.mouse.move(640, 778);
      await host.page.waitForTimeout(1_000);
      await host.page.screenshot({ path: PICTURE });
    });
  } finally {
    await host.stop();
  }
}

/** Moves the edge between two parts of the window. */
async function drag(window: Window, from: number, to: number): Promise<void> {
  const { mouse } = window.page;
  await mouse.move(from, 300);
  await window.page.waitForTimeout(400);
  await mouse.down();
  await mouse.move(to, 300, { steps: 6 });
  await mouse.up();
}

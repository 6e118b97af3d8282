// A 3B program: colours, diagnostics, the picture with the wire that is played along it.

import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { HOLE } from "./drawings";
import { Host } from "./host";
import { WEDM } from "./paths";
import { Window } from "./window";

/** The hole, counted on the wrong axis. */
const FIXABLE = HOLE.replace("GYNR1", "GXNR1");

/** The same program as somebody types it. */
const LOOSE = HOLE.toLowerCase().replaceAll("b", " b ");
/** The centre of its arc is nowhere near. */
const BROKEN_ISO = "%\nG21\nG90\nG92 X0 Y0\nG01 X5.000 Y0.000\nG02 X9.000 Y3.000 I5.000 J0.000\nM02\n%\n";
const SETTINGS = '[program]\nlayout = "compact"\n';

export async function program(checks: WindowChecks): Promise<void> {
  const host = await Host.start({ "wedm.server.path": WEDM }, { "hole.3b": HOLE, "broken.3b": "B1000B0B1000GXL1\nQQQ\nDD\n", "broken.iso": BROKEN_ISO, "fixable.3b": FIXABLE, "loose.3b": LOOSE, "wedm.toml": SETTINGS });
  const window = new Window(host.page);
  checks.page = host.page;
  try {
    await checks.check("a fault in a program is underlined", async () => {
      await window.openOurs("broken.3b");
      await window.squiggles.first().waitFor();
    });
    await checks.check("a fault in an ISO program is underlined, and said", async () => {
      await window.openOurs("broken.iso");
      await host.page.locator('.statusbar-item[id="status.editor.mode"]', { hasText: "ISO (wire EDM)" }).waitFor();
      await window.squiggles.first().waitFor();
      const said = async (): Promise<boolean> => (await window.problems()).some((row) => row.includes("arc-off-radius"));
      await expectSoon("arc-off-radius", said, async () => (await window.problems()).join("\n"));
      await checks.shot("iso-fault");
      await window.hidePanel();
    });
    await checks.check("a program is repaired by its quick fix", async () => {
      await window.openOurs("fixable.3b");
      await window.squiggles.first().waitFor();
      await window.goToLine(2, 8);
      await window.quickFix();
      await checks.shot("program-quick-fix");
      await host.page.keyboard.press("Enter");
      await window.squiggles.first().waitFor({ state: "hidden" });
      await window.save("the program repaired", async () => (await readFile(join(host.folder, "fixable.3b"), "utf8")) === HOLE);
    });
    await checks.check("a program is formatted in the layout that is set", async () => {
      await window.openOurs("loose.3b");
      await window.command("Format Document");
      await window.save("the same blocks", async () => (await readFile(join(host.folder, "loose.3b"), "utf8")) === HOLE, () =>
        readFile(join(host.folder, "loose.3b"), "utf8"),
      );
    });
    await checks.check("a program is scaled by a factor", async () => {
      await window.command("Wire EDM: Scale Program…");
      const box = host.page.locator(".quick-input-widget");
      await box.getByText("Factor by which every length").waitFor();
      await box.locator("input").fill("2");
      await host.page.keyboard.press("Enter");
      await host.page.locator(".view-lines", { hasText: "B19800" }).waitFor();
    });
    await checks.check("lenses above the first block play the wire and open the picture", async () => {
      await window.openOurs("hole.3b");
      const lens = host.page.locator(".codelens-decoration a", { hasText: "Open picture" });
      await actUntil("the picture", () => lens.click(), () => host.page.locator("iframe.webview.ready:visible").isVisible());
      await window.picture();
      await checks.shot("lenses");
    });
    await checks.check("end points and radii stand after the blocks, a block says what it does, and the contour is in the outline", async () => {
      await window.openOurs("hole.3b");
      await host.page.locator(".view-lines", { hasText: "R 9.900, 360°" }).first().waitFor();
      await window.goToLine(2, 3);
      await window.hover("counter-clockwise");
      const outline = host.page.locator(".quick-input-widget .monaco-list-row");
      await window.press("Control+Shift+o", outline.filter({ hasText: "contour 1" }).first());
      await outline.filter({ hasText: "lead-in" }).first().waitFor();
      await host.page.keyboard.press("Escape");
    });
    await checks.check("the wire is played along the program, and the text follows", async () => {
      await window.openOurs("hole.3b");
      await window.command("Wire EDM: Play Along the Program");
      const page = await window.pictureOf("hole.3b");
      const slider = page.locator("#slider");
      await expectSoon("a wire that moves", async () => Number(await slider.inputValue()) > 0, () => slider.inputValue());
      // So slow that it has not reached the end before it is stopped, however busy the machine is.
      await page.locator("#speed").selectOption("0.25");
      if ((await page.locator("#play.playing").count()) === 0) {
        await page.locator("#play").click();
      }
      await expectSoon("a wire that goes on", async () => Number(await slider.inputValue()) > 20, () => slider.inputValue());
      await page.locator("#play").click();
      // The wire moves until the window has got round to the click.
      await expectSoon("a wire that is stopped", async () => (await page.locator("#play.playing").count()) === 0);
      const stopped = await slider.inputValue();
      await host.page.waitForTimeout(400);
      expectEqual("paused", await slider.inputValue(), stopped);
      await slider.fill("500");
      await expectSoon("the block in the middle", async () => (await page.locator("#where").innerText()).includes("line 2"), () => page.locator("#where").innerText());
      expectEqual("cut", await page.locator("svg .cut").count(), 1);
      await checks.shot("playback");
    });
    await checks.check("cursor and picture follow each other in a program", async () => {
      const page = await window.picture();
      await window.goToLine(3);
      await expectSoon("line 3 selected", async () => (await page.locator("svg .selected").first().getAttribute("data-line")) === "2");
      await expectSoon("the wire at its beginning", async () => (await page.locator("#where").innerText()).includes("line 3"), () => page.locator("#where").innerText());
      await actUntil("the cursor in line 2", () => window.clickPath(page, 'svg path[data-line="1"]'), async () => (await window.line()) === 2);
    });
    await checks.check("a program becomes a drawing again", async () => {
      await window.turnTo("hole.3b");
      await window.command("Wire EDM: Convert Program to DXF…");
      const target = join(host.folder, "hole.dxf");
      await window.path(target);
      await window.tab("hole.dxf");
      // The leads lie upon each other, which is a finding.
      const inspecting = promisify(execFile)(WEDM, ["inspect", "--output", "json", target]);
      const { stdout } = await inspecting.catch((error: unknown) => error as { stdout: string });
      const { entities } = JSON.parse(stdout) as { entities: { layer: string; segments: { radius?: number }[] }[] };
      const cut = entities.filter(({ layer }) => layer === "CUT").flatMap(({ segments }) => segments.map(({ radius }) => radius?.toFixed(2)));
      expectEqual("radii on the layer of the cut", [...new Set(cut)], ["9.90"]);
      await checks.shot("converted");
    });
  } finally {
    await host.stop();
  }
}

// The live picture and the radius list: seen, clicked, and in step with the cursor in both directions; programs generated.

import { readFile, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { actUntil, type WindowChecks, expectEqual, expectSoon } from "./checks";
import { FILLET, lineOf, PLATE } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import { Window } from "./window";

const SMALL = await readFile(join(PROJECT, "docs/pictures/small-radius.dxf"), "utf8");

export async function picture(checks: WindowChecks): Promise<void> {
  const host = await Host.start({ "wedm.server.path": WEDM, "wedm.correction": 0.1 }, { "plate.dxf": FILLET, "plate-with-hole.dxf": PLATE, "small-radius.dxf": SMALL });
  const window = new Window(host.page);
  checks.page = host.page;
  const bulges = [...SMALL.matchAll(/^ *42\r?\n/gm)].map((match) => SMALL.slice(0, match.index).split("\n").length + 1);
  try {
    await window.openOurs("small-radius.dxf");
    await window.squiggles.first().waitFor();
    await window.command("Wire EDM: Open Picture Beside");
    const page = await window.picture();
    await checks.check("the picture stands beside the text, with a mark and a chip for each fault", async () => {
      await expectSoon("four faults", async () => (await page.locator("svg .drawing .fault").count()) === 4);
      expectEqual("marks", await page.locator("svg .mark").count(), 4);
      expectEqual("chips", await page.locator("#faults .chip").count(), 4);
      expectEqual("title", await page.locator("#title").innerText(), "small-radius.dxf · contours, no wire path");
      expectEqual("what is wrong", (await page.locator("#alert").innerText()).startsWith("4 arcs are tighter than the correction · no wire path: "), true);
      expectEqual("by rule", await page.locator("#rules .rule").allInnerTexts().then((rules) => rules.map((rule) => rule.replace(/\s+/g, " "))), ["small-radius 4"]);
      const radii = (await page.locator("#chips .chip").allInnerTexts()).map((chip) => Number(/R ([\d.]+) mm/.exec(chip)?.[1]));
      expectEqual("smallest first", radii.every((radius, index) => radius >= (radii[index - 1] ?? 0)), true);
      await checks.shot("picture");
    });
    await checks.check("a fault that is clicked in the picture is selected in the text", async () => {
      await window.clickDrawnUntil(page.locator("svg .mark").nth(1).locator(".badge"), "the line of the fault", async () => (await window.line()) === bulges[2]);
      expectEqual("selected", await page.locator("svg .fault.selected").getAttribute("data-segment"), "4");
    });
    await checks.check("a line of the contour that is clicked is selected in the text", async () => {
      const beside = (bulges[0] ?? 0) + 2;
      await window.clickDrawnUntil(page.locator('svg .contour[data-segment="1"]'), "the line of the contour", async () => (await window.line()) === beside);
      await expectSoon("segment 1 selected", async () => (await page.locator("svg .contour.selected").getAttribute("data-segment")) === "1");
    });
    await checks.check("the cursor in the text selects in the picture", async () => {
      await window.goToLine(bulges[1] ?? 0);
      await expectSoon("segment 2 selected", async () => (await page.locator("svg .fault.selected").getAttribute("data-segment")) === "2");
      await window.goToLine(lineOf(SMALL, "LWPOLYLINE"));
      await expectSoon("all of the entity selected", async () => (await page.locator("svg .contour.selected").count()) === 14);
    });
    await checks.check("wheel, drag, keys and buttons move the view", async () => {
      const view = async (): Promise<number[]> => ((await page.locator("#stage > svg").getAttribute("viewBox")) ?? "").split(" ").map(Number);
      await page.locator("#fit").click();
      // What the server still says may change the height of the head, and with it the view.
      let all: number[] = [];
      await expectSoon("a view at rest", async () => {
        const before = all.join(" ");
        all = await view();
        await page.waitForTimeout(200);
        return all.join(" ") === before;
      });
      const stage = await page.locator("#stage").boundingBox();
      await host.page.mouse.move((stage?.x ?? 0) + 200, (stage?.y ?? 0) + 200);
      await host.page.mouse.wheel(0, -400);
      await expectSoon("a closer view", async () => ((await view())[2] ?? 0) < (all[2] ?? 0) * 0.5);
      const close = await view();
      await host.page.mouse.down();
      await host.page.mouse.move((stage?.x ?? 0) + 260, (stage?.y ?? 0) + 240, { steps: 4 });
      await host.page.mouse.up();
      await expectSoon("a view that was moved", async () => ((await view())[0] ?? 0) < (close[0] ?? 0));
      await page.locator("#stage").focus();
      await host.page.keyboard.press("0");
      // Texts of marks are measured a hair wider or narrower at another scale.
      const pixel = (all[2] ?? 0) / 500;
      await expectSoon("everything in view", async () => (await view()).every((value, index) => Math.abs(value - (all[index] ?? 0)) < pixel), async () => `${(await view()).join(" ")}, not ${all.join(" ")}`);
    });
    await checks.check("a chip comes close enough to see the circle of the correction", async () => {
      await actUntil("the circle of the correction", () => page.locator("#faults .chip").first().click(), () => page.locator("svg.close .correction.fine").first().isVisible());
      await checks.shot("picture-close");
      await page.locator("#fit").click();
    });
    await checks.check("the radius list has vertex, radius, number of the mark and verdict, and leads to the text", async () => {
      await window.command("Wire EDM: Show Radius List");
      const row = host.page.locator(".pane-body .monaco-list-row", { hasText: "R 0.040" });
      await row.waitFor();
      expectEqual("row", (await row.innerText()).replaceAll(/\s+/g, ""), "4R0.040②·small-radius·3.200,0.983");
      await expectSoon("fifteen rows", async () => (await host.page.locator(".pane-body .monaco-list-row").count()) === 15);
      await actUntil("the line of the row", () => row.click(), async () => (await window.line()) === bulges[2]);
      await checks.shot("radii");
    });
    await checks.check("the list can be narrowed to the faults", async () => {
      await host.page.locator('.pane-header [aria-label="Show Only Faults"], .composite.title [aria-label="Show Only Faults"]').first().click();
      await expectSoon("five rows", async () => (await host.page.locator(".pane-body .monaco-list-row").count()) === 5, async () => String(await host.page.locator(".pane-body .monaco-list-row").count()));
      await host.page.locator('.composite.title [aria-label="Show All Segments"]').first().click();
      await expectSoon("fifteen rows", async () => (await host.page.locator(".pane-body .monaco-list-row").count()) === 15);
    });
    await checks.check("with errors in the drawing a program is refused with a sentence", async () => {
      await window.command("Wire EDM: Generate 3B Program…");
      await window.notification("No program: the drawing has 4 errors").waitFor();
      await checks.shot("refused");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("the picture follows an edit", async () => {
      await window.goToLine(1);
      await window.command("Wire EDM: Fix All That Is Safe to Fix");
      await expectSoon("no faults", async () => (await page.locator("svg .drawing .fault").count()) === 0);
      expectEqual("chips", await page.locator("#faults").isVisible(), false);
    });
    await checks.check("a clean drawing gives its 3B program, once the side is known", async () => {
      await window.command("Wire EDM: Generate 3B Program…");
      const asked = host.page.locator(".quick-input-widget", { hasText: "Which Side Does the Wire Run On?" });
      await asked.getByText("By Nesting").waitFor();
      await expectSoon("the contour marked", async () => (await page.locator("svg .contour.selected").count()) === 14);
      await checks.shot("side-of-one");
      await asked.locator("input").fill("Opening");
      await host.page.keyboard.press("Enter");
      const target = join(host.folder, "made.3b");
      await window.path(target);
      await expectSoon("a program", async () => /^(B\d+B\d+B\d+G[XY](L|SR|NR)[1-4]\n){14}DD\n$/.test(await readFile(target, "utf8")), () => readFile(target, "utf8"));
      await window.tab("made.3b");
      await window.notification("µm from the path; rounding of J, added up").waitFor();
      await checks.shot("generated");
      // Notices come up at the bottom of the window, and go again.
      const player = await (await window.pictureOf("made.3b")).locator("#player").boundingBox();
      const bottom = (player?.y ?? 0) + (player?.height ?? 0);
      expectEqual("the player in the upper half", player !== null && bottom < (host.page.viewportSize()?.height ?? 0) / 2, true);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("of a plate with a hole each contour is asked for, marked in the picture, and the answer can be kept", async () => {
      await window.turnTo("plate-with-hole.dxf");
      await window.command("Wire EDM: Generate 3B Program…");
      const box = host.page.locator(".quick-input-widget");
      await box.getByText("By Nesting").waitFor();
      await box.locator("input").fill("Choose for Each");
      await host.page.keyboard.press("Enter");
      const roles = { "Contour 1 of 2": "Punch", "Contour 2 of 2": "Opening" };
      for (const [title, role] of Object.entries(roles)) {
        await box.getByText(title).waitFor();
        const handle = title.startsWith("Contour 1") ? "2A" : "2B";
        await expectSoon(`${handle} marked`, async () => (await page.locator(`svg .contour.selected[data-handle="${handle}"]`).count()) > 0);
        expectEqual("marked alone", await page.locator(`svg .contour.selected:not([data-handle="${handle}"])`).count(), 0);
        await checks.shot(`side-of-${handle}`);
        await box.locator("input").fill(role);
        await host.page.keyboard.press("Enter");
      }
      const target = join(host.folder, "plate.3b");
      await window.path(target);
      await window.tab("plate.3b");
      // Punch 20 × 10 and hole of R 3 with a correction of 0.1 mm: the hole first, from within; the outline from without.
      await expectSoon("a program", async () => (await readFile(target, "utf8")).includes("B20000B0B20000GXL"), () => readFile(target, "utf8"));
      expectEqual("the hole is cut from within", /B2900B0B11600G[XY]NR/.test(await readFile(target, "utf8")), true);
      await window.notification("Keep these sides").getByRole("button", { name: "Keep in wedm.toml" }).click();
      const kept = join(host.folder, "wedm.toml");
      await expectSoon("the answer kept by layer", async () => (await readFile(kept, "utf8")) === '[layers]\n"DIE" = "punch"\n"HOLES" = "opening"\n', () => readFile(kept, "utf8"));
      await window.command("Notifications: Clear All Notifications");
      await rm(kept);
    });
    await checks.check("wedm.toml wins over the settings, and the status bar says so", async () => {
      await window.turnTo("small-radius.dxf");
      await window.hold(host.folder, "correction = 0.11\n", "0.110");
      await window.squiggles.first().waitFor();
      await writeFile(join(host.folder, "wedm.toml"), 'side = "opening"\n');
      await window.squiggles.first().waitFor({ state: "hidden" });
    });
    await checks.check("a 4B program is generated, with the side that wedm.toml says", async () => {
      await window.command("Wire EDM: Generate 4B Program…");
      const target = join(host.folder, "made.4b");
      await window.path(target);
      await expectSoon("a program", async () => /^B\d+B\d+B\d+B\d+G[XY]D?D?/m.test(await readFile(target, "utf8")), () => readFile(target, "utf8"));
      await window.tab("made.4b");
    });
    await checks.check("an ISO program is generated in the profile that is chosen", async () => {
      await window.turnTo("small-radius.dxf");
      await window.command("Wire EDM: Generate ISO Program…");
      const box = host.page.locator(".quick-input-widget");
      await box.getByText("As the Settings Say").waitFor();
      await checks.shot("profiles");
      await box.locator("input").fill("fast-wire");
      await host.page.keyboard.press("Enter");
      const target = join(host.folder, "made.iso");
      await window.path(target);
      await expectSoon("whole µm from one point to the next", async () => /^G91\nG01 X-?\d+ Y-?\d+$/m.test(await readFile(target, "utf8")), () => readFile(target, "utf8"));
      await window.tab("made.iso");
      await expectSoon("no word of J, which ISO has not", async () => (await window.notification("ISO: 14 blocks").innerText()).includes("µm from the path."), () => window.notification("ISO: 14 blocks").innerText());
      await checks.shot("generated-iso");
    });
    await checks.check("the picture is there again when the window is loaded again, and still follows the cursor", async () => {
      await window.turnTo("small-radius.dxf");
      await host.page.keyboard.press("Control+s");
      await host.page.reload();
      await window.status.waitFor();
      // VS Code may have kept another file in front: it writes that down from time to time.
      await window.turnTo("small-radius.dxf");
      const again = await window.pictureOf("small-radius.dxf");
      await expectSoon("the contour", async () => (await again.locator("svg .contour").count()) > 0);
      await window.goToLine(bulges[1] ?? 0);
      await expectSoon("segment 2 selected", async () => (await again.locator("svg .contour.selected").getAttribute("data-segment")) === "2");
      await checks.shot("reloaded");
    });
  } finally {
    await host.stop();
  }
}

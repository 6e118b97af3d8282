// What belongs to a whole job beside the wire's program: the drill list, the fit, ways beside open contours, milling by an electrode.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { type WindowChecks, expectEqual, expectSoon } from "./checks";
import { drawn, PLATE } from "./drawings";
import { Host } from "./host";
import { WEDM } from "./paths";
import { Window } from "./window";

const WAY = drawn("0", "LWPOLYLINE", "5", "2A", "8", "WAY", "90", "3", "70", "0", "10", "0", "20", "0", "10", "20", "20", "0", "10", "20", "20", "10");
const SLOT = drawn("0", "LINE", "5", "2A", "8", "SLOT", "10", "0", "20", "0", "11", "10", "21", "0");
const POCKET = drawn("0", "CIRCLE", "5", "2A", "8", "POCKET", "10", "10", "20", "5", "40", "3");
const ELECTRODE = "[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.05\ndepth = 0.2\nwear = 0.001\n";

export async function job(checks: WindowChecks): Promise<void> {
  const files = { "plate.dxf": PLATE, "way.dxf": WAY, "slot.dxf": SLOT, "pocket.dxf": POCKET };
  const host = await Host.start({ "wedm.server.path": WEDM }, files);
  const window = new Window(host.page);
  checks.page = host.page;
  const text = (name: string) => (): Promise<string> => readFile(join(host.folder, name), "utf8");
  const kept = text("wedm.toml");
  try {
    await window.openOurs("plate.dxf");
    await checks.check("where the wire is threaded is saved as the drill list, and as a drawing with the holes", async () => {
      await window.hold(host.folder, 'side = "auto"\ncorrection = 0.12\n[program]\nstart-hole = 2\n', "0.120");
      await window.command("Wire EDM: Save Drill List");
      await window.path(join(host.folder, "holes.csv"));
      const list = text("holes.csv");
      const rows = /^drawing,x_mm,y_mm,diameter_mm,contour,hole,number\n(plate.dxf,[\d.-]+,[\d.-]+,2,2[AB],found,[12]\n){2}$/;
      await expectSoon("two holes", async () => rows.test(await list()), list);
      await window.tab("holes.csv");
      await window.turnTo("plate.dxf");
      await window.command("Wire EDM: Save Drill List");
      await window.path(join(host.folder, "drilled.dxf"));
      await window.tab("drilled.dxf");
      const drawing = await text("drilled.dxf")();
      expectEqual("holes on their layer", drawing.match(/\nCIRCLE\r?\n(?:(?! *0\r?\n).*\r?\n.*\r?\n)*? *8\r?\nSTART-HOLES\r?\n/g)?.length, 2);
      await window.turnTo("plate.dxf");
    });
    await checks.check("whether punch and plate fit is shown, and what is missing for that is said", async () => {
      await window.command("Wire EDM: Show Whether Punch and Plate Fit");
      const trouble = async (): Promise<string> => (await window.picture(false)).locator("#trouble").innerText();
      await expectSoon("what is missing", async () => (await trouble()).includes("pair.drawn-as"), trouble);
      await window.hold(host.folder, 'wire-diameter = 0.18\ngap = 0.01\n[pair]\ndrawn-as = "punch"\nclearance = 0.005\n', "0.100");
      const fit = async (): Promise<string> => (await window.picture()).locator("#title, #note").allInnerTexts().then((texts) => texts.join(" "));
      await expectSoon("one outline in the other", async () => (await fit()).includes("clearance missing"), fit);
      const shown = await window.picture();
      const chip = async (): Promise<string> => (await shown.locator("#chips .chip").first().innerText()).replace(/\s+/g, " ");
      await expectSoon("what is left, the tightest first", async () => /^1 2A · \d -[\d.]+ mm left$/.test(await chip()), chip);
      expectEqual("a player", await shown.locator("#player").isVisible(), false);
      await checks.shot("fit");
    });
    await checks.check("a chip of the fit comes close to its place, and marks it", async () => {
      const shown = await window.picture();
      const across = async (): Promise<number> => Number((await shown.locator("#stage > svg").getAttribute("viewBox"))?.split(" ")[2]);
      const all = await across();
      expectEqual("marks", await shown.locator("svg .drawing ~ .mark, svg .figure .mark").count(), await shown.locator("#chips .chip").count());
      await shown.locator("#chips .chip").nth(1).click();
      await expectSoon("a view of less than 1 mm", async () => (await across()) < all / 30, async () => `${await across()} of ${all}`);
      expectEqual("marked", await shown.locator("svg .mark.selected").count(), 1);
      expectEqual("its number", await shown.locator("svg .mark.selected .count").textContent(), "2");
      const [stage, dot] = [await shown.locator("#stage").boundingBox(), await shown.locator("svg .mark.selected .badge").boundingBox()];
      const [x, y] = [(stage?.x ?? 0) + (stage?.width ?? 0) / 2, (stage?.y ?? 0) + (stage?.height ?? 0) / 2];
      const far = Math.hypot((dot?.x ?? 0) - x, (dot?.y ?? 0) - y);
      expectEqual("beside the middle", far < 80, true);
      await checks.shot("fit-close");
      await window.close("Fit of");
    });
    await checks.check("of an open contour the wire's side is set in the picture, left or right of its direction", async () => {
      await window.openOurs("way.dxf");
      await window.hold(host.folder, "correction = 0.13\n", "0.130");
      await window.command("Wire EDM: Open as Picture");
      const page = await window.pictureOf("way.dxf");
      await window.openContour(page, "2A");
      const card = page.locator("#card");
      expectEqual("what it may be", await card.locator(".row", { hasText: "Side" }).getByRole("button").allInnerTexts(), ["Left", "Right", "On the line", "Not cut"]);
      await card.getByRole("button", { name: "Left" }).click();
      await expectSoon("left kept", async () => (await kept()).includes('[drawings."way.dxf".contours.2A]\nside = "left"'), kept);
      await page.locator("svg .wire").first().waitFor({ state: "attached" });
      await expectSoon("left chosen", async () => (await card.getByRole("button", { name: "Left" }).getAttribute("aria-pressed")) === "true");
      await checks.shot("open-contour-left");
      await card.getByRole("button", { name: "Right" }).click();
      await expectSoon("right kept", async () => (await kept()).includes('side = "right"'), kept);
      await expectSoon("right chosen", async () => (await card.getByRole("button", { name: "Right" }).getAttribute("aria-pressed")) === "true");
      await host.page.keyboard.press("Control+w");
    });
    await checks.check("a slot is milled: a program with heights, layers and what comes out are said", async () => {
      await window.openOurs("slot.dxf");
      await window.hold(host.folder, ELECTRODE, "0.550");
      await window.command("Wire EDM: Generate Milling Program…");
      await window.path(join(host.folder, "milled.iso"));
      await window.tab("milled.iso");
      const program = await text("milled.iso")();
      expectEqual("layers", program.match(/^G01 Z-0\.\d+$/gm)?.length, 4);
      const said = window.notification("Milling: ");
      await expectSoon("what it comes to", async () => /; 4 layers of 0\.05 mm; simulated: the floor 0\.\d{4} to 0\.\d{4} mm deep, the electrode 0\.\d{4} mm shorter/.test(await said.innerText()), () => said.innerText());
      expectEqual("nothing is counted", (await said.innerText()).includes("of J"), false);
      await window.command("Wire EDM: Open Picture Beside");
      const page = await window.pictureOf("milled.iso");
      await expectSoon("no wire", async () => (await page.locator("#title").innerText()) === "milled.iso · path of the electrode");
      await checks.shot("milled");
      await window.close("Picture of");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("of a pocket the side of the electrode is asked for", async () => {
      await window.openOurs("pocket.dxf");
      await window.command("Wire EDM: Generate Milling Program…");
      const asked = host.page.locator(".quick-input-widget", { hasText: "Which Side Does the Electrode Run On?" });
      await asked.getByText("Opening: Electrode Inside").waitFor();
      await checks.shot("side-of-electrode");
      await asked.locator("input").fill("Opening");
      await host.page.keyboard.press("Enter");
      await window.path(join(host.folder, "pocket.iso"));
      await window.tab("pocket.iso");
      await window.notification("Keep these sides of the electrode").waitFor();
    });
  } finally {
    await host.stop();
  }
}

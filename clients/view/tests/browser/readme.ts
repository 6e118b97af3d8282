// Makes the picture of the README: the plate of the demonstration beside its findings.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { Bench } from "./bench";
import { type PageChecks, expectSoon } from "./checks";
import { PROJECT } from "./paths";

const PLATE = await readFile(join(PROJECT, "src/cli/demo/plate.dxf"), "utf8");
const SETTINGS = 'wire-diameter = 0.18\ngap = 0.01\nside = "opening"\n\n[layers]\nPLATE = "ignore"\n';

export async function readme(checks: PageChecks): Promise<void> {
  const names = ["die.dxf", "gap.dxf", "notch.dxf", "slot.dxf"];
  const others = await Promise.all(names.map(async (name) => [name, await readFile(join(PROJECT, "docs/pictures", name))] as const));
  const files = { ...Object.fromEntries(others), "plate.dxf": PLATE, "wedm.toml": SETTINGS };
  const bench = await Bench.start(files, { viewport: { width: 1200, height: 680 }, colorScheme: "light" });
  checks.bench = bench;
  await checks.check("the picture of the README", async () => {
    await bench.open("plate.dxf");
    await bench.finding("small-radius").waitFor();
    await expectSoon("all counted", async () => (await bench.page.locator("#left .note").innerText()) === "");
    await bench.page.mouse.move(640, 678);
    await bench.page.waitForTimeout(500);
    await bench.page.screenshot({ path: join(PROJECT, "docs/pictures/view.png") });
  });
}

// A drawing of so many contours that it comes in pieces and is painted.

import { Bench } from "./bench";
import { type PageChecks, expectEqual, expectSoon } from "./checks";

const COLUMNS = 30;
const COUNT = 600;
const SETTINGS = 'wire-diameter = 0.18\ngap = 0.01\nside = "opening"\n';

/** Openings of 8 × 8 mm with a fillet at one corner; the first `tight` of them are too tight. */
function openings(tight: number): string {
  const contours = Array.from({ length: COUNT }, (_, index) => {
    const [x, y] = [(index % COLUMNS) * 12, Math.floor(index / COLUMNS) * 12];
    const r = index < tight ? 0.05 : 1;
    const vertices = [[x, y, 0], [x + 8 - r, y, 0.41421356237309503], [x + 8, y + r, 0], [x + 8, y + 8, 0], [x, y + 8, 0]];
    const written = vertices.map(([a, b, bulge]) => `10\n${a}\n20\n${b}\n42\n${bulge}\n`);
    return `0\nLWPOLYLINE\n5\n${(256 + index).toString(16).toUpperCase()}\n8\n0\n90\n${vertices.length}\n70\n1\n${written.join("")}`;
  });
  return `0\nSECTION\n2\nENTITIES\n${contours.join("")}0\nENDSEC\n0\nEOF\n`;
}

export async function large(checks: PageChecks): Promise<void> {
  const bench = await Bench.start({ "plate.dxf": openings(10), "wedm.toml": SETTINGS });
  checks.bench = bench;
  const { page } = bench;

  await checks.check("many contours are painted, and what is wrong is found in the list", async () => {
    await bench.open("plate.dxf");
    await page.locator("#stage > canvas").waitFor();
    expectEqual("in the tree", await page.locator("svg .drawing .contour").count(), 0);
    await bench.finding("small-radius").click();
    await page.locator("svg .fault.selected").waitFor({ state: "attached" });
    await page.locator("#card h2", { hasText: "R 0.050" }).waitFor();
    await bench.shot("large-close");
  });

  await checks.check("a fault that is clicked on the canvas is marked in the list, a contour has its card", async () => {
    await bench.turnTo("radii");
    await page.keyboard.press("Escape");
    const stage = await page.locator("#stage").boundingBox();
    const middle = { x: (stage?.width ?? 0) / 2, y: (stage?.height ?? 0) / 2 };
    await page.locator("#stage").click({ position: middle });
    await page.locator('#panel-radii .row[aria-selected="true"]', { hasText: "R 0.050" }).waitFor();
    await bench.turnTo("contours");
    await page.locator("#panel-contours .row").nth(1).click();
    await page.locator("svg .contour.selected").first().waitFor({ state: "attached" });
    await bench.turnTo("findings");
  });

  await checks.check("a save is shown, with what is gone, and the wire is played along its path", async () => {
    await page.keyboard.press("Escape");
    await bench.writeOver("plate.dxf", openings(0));
    await bench.notice(/was saved: \d+ new, \d+ gone/).waitFor();
    await page.locator("#fit").click();
    await expectSoon("the length that is cut", async () => /cut 0\.0 of [\d.]{5,} mm/.test(await page.locator("#where").innerText()));
    await page.locator("#slider").fill("500");
    await page.locator("svg .drawing .head").waitFor({ state: "attached" });
    await expectSoon("half of it", async () => !(await page.locator("#where").innerText()).includes("cut 0.0 of"));
    await bench.shot("large");
  });

  await checks.check("the browser had nothing to complain of in a large drawing", () => {
    expectEqual("complaints", bench.complaints, []);
    return Promise.resolve();
  });
}

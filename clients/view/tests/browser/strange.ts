// What is broken, half written, dropped or lost.

import { readFile, unlink } from "node:fs/promises";
import { join } from "node:path";
import { Bench } from "./bench";
import { type PageChecks, expectBytes, expectEqual, expectSoon } from "./checks";
import { PROJECT } from "./paths";

const DIE = await readFile(join(PROJECT, "docs/pictures/die.dxf"), "utf8");
const SETTINGS = 'wire-diameter = 0.18\ngap = 0.01\nside = "opening"\n';
const BINARY = Buffer.concat([Buffer.from("AutoCAD Binary DXF\r\n\x1a\0"), Buffer.alloc(64)]);
/** 凹模, the layer's name in GBK. */
const LAYER = Buffer.from([0xb0, 0xbc, 0xc4, 0xa3]);

export async function strange(checks: PageChecks): Promise<void> {
  const [head = "", rest = ""] = DIE.split(/(?<=\n8\n)/, 2);
  const chinese = Buffer.concat([Buffer.from(head), LAYER, Buffer.from(`\n${rest.split("\n").slice(1).join("\n")}`)]);
  const bench = await Bench.start({ "die.dxf": DIE, "binary.dxf": BINARY, "torn.dxf": DIE.slice(0, DIE.length / 2), "gbk.dxf": chinese, "wedm.toml": SETTINGS });
  checks.bench = bench;
  const { page } = bench;

  await checks.check("a file that was never one says why in the empty space", async () => {
    await bench.open("binary.dxf");
    await page.locator("#trouble", { hasText: "binary" }).waitFor();
    await bench.shot("binary");
  });

  await checks.check("while a file is half written the last picture stays, dimmed", async () => {
    await bench.open("die.dxf");
    await page.locator("#stage > svg .contour").first().waitFor({ state: "attached" });
    const opacity = (): Promise<number> => page.locator("#stage > svg").evaluate((svg) => Number(getComputedStyle(svg).opacity));
    await bench.writeOver("die.dxf", DIE.slice(0, DIE.length / 2));
    await expectSoon("dimmed", async () => (await opacity()) < 0.5);
    expectEqual("the picture", (await page.locator("#stage > svg .contour").count()) > 0, true);
    await bench.writeOver("die.dxf", DIE);
    await expectSoon("in full", async () => (await opacity()) === 1);
  });

  await checks.check("a drawing in GBK is repaired in its own bytes", async () => {
    await bench.open("gbk.dxf");
    await page.locator("#repair-all").click();
    await page.locator("#document", { hasText: "gbk-fixed.dxf" }).waitFor();
    await bench.wedm("fix", "gbk.dxf", "-o", "expected.dxf");
    expectBytes("repaired", await bench.read("gbk-fixed.dxf"), await bench.read("expected.dxf"));
    expectEqual("its name", (await bench.read("gbk-fixed.dxf")).includes(LAYER), true);
  });

  await checks.check("a drawing that is dropped is opened in memory, and what comes of it is downloaded", async () => {
    await page.evaluate((text) => {
      const dropped = new DataTransfer();
      dropped.items.add(new File([text], "dropped.dxf"));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, bubbles: true, cancelable: true }));
    }, DIE);
    await page.locator("#document", { hasText: "dropped.dxf" }).waitFor();
    await bench.finding("small-radius").waitFor();
    await page.locator("#repair-all").click();
    await page.locator("#document", { hasText: "dropped-fixed.dxf" }).waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#keep").click()]);
    await bench.wedm("fix", "die.dxf", "-o", "expected.dxf", "--overwrite");
    expectBytes("downloaded", await readFile(await download.path()), await bench.read("expected.dxf"));
  });

  await checks.check("all of it by keyboard", async () => {
    await page.keyboard.press("/");
    await page.keyboard.type("die.dxf");
    await page.keyboard.press("ArrowDown");
    await page.locator("#document", { hasText: /^die\.dxf$/ }).waitFor();
    await bench.finding("small-radius").waitFor();
    await page.keyboard.press("n");
    await page.locator("#card h2", { hasText: "R 0.080" }).waitFor();
    await page.keyboard.press("f");
    await page.locator("#document", { hasText: "die-fixed.dxf" }).waitFor();
    await page.keyboard.press("3");
    await page.locator("#tab-contours[aria-selected=true]").waitFor();
    await page.keyboard.press("?");
    await page.locator("dialog", { hasText: "The next finding" }).waitFor();
    await page.keyboard.press("Escape");
    await page.locator("dialog").waitFor({ state: "detached" });
    await page.locator("#left input").fill("");
  });

  await checks.check("what is wrong in wedm.toml is said when it is saved", async () => {
    await bench.writeOver("wedm.toml", `${SETTINGS}gapp = 1\n`);
    await bench.notice("wedm.toml: ").waitFor();
    await bench.writeOver("wedm.toml", SETTINGS);
  });

  await checks.check("a file that goes away is said, and its picture stays", async () => {
    await bench.open("torn.dxf");
    await bench.open("gbk.dxf");
    await unlink(bench.path("gbk.dxf"));
    await bench.notice("gbk.dxf is no longer there").waitFor();
    expectEqual("the picture", (await page.locator("#stage > svg .contour").count()) > 0, true);
  });

  await checks.check("a program that ends is said", async () => {
    bench.end();
    await page.locator("#connection", { hasText: "connection is lost" }).waitFor();
    await bench.shot("lost");
  });
}

// The work of a day, as the tutorial has it: opened, seen, fixed, drawn again, generated, saved; compared with the command line.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { Bench } from "./bench";
import { type PageChecks, expectBytes, expectEqual, expectSoon } from "./checks";
import { PROJECT } from "./paths";

/** The drawing of the tutorials: an opening of 20 × 10 mm with one fillet of R 0.08. */
const DIE = await readFile(join(PROJECT, "docs/pictures/die.dxf"), "utf8");
const NOTCH = await readFile(join(PROJECT, "docs/pictures/notch.dxf"), "utf8");
const PLATE = await readFile(join(PROJECT, "src/cli/demo/plate.dxf"), "utf8");

export async function work(checks: PageChecks): Promise<void> {
  const bench = await Bench.start({ "die.dxf": DIE, "notch.dxf": NOTCH, "plate.dxf": PLATE });
  checks.bench = bench;
  const { page } = bench;
  const card = page.locator("#card");

  await checks.check("a folder without wedm.toml asks for wire, gap and machine, and shows the correction that follows", async () => {
    const dialog = page.locator("dialog");
    await dialog.locator("[name=wire]").fill("0.18");
    await dialog.locator("[name=gap]").fill("0.02");
    await dialog.locator(".follows", { hasText: "0.1100 mm" }).waitFor();
    await dialog.locator("[name=gap]").fill("0.01");
    await dialog.locator(".follows", { hasText: "0.1000 mm" }).waitFor();
    await dialog.locator("[data-choice=save]").click();
    await expectSoon("wedm.toml", async () => (await bench.read("wedm.toml")).toString() === "wire-diameter = 0.18\ngap = 0.01\n");
    await page.locator("#said", { hasText: "wedm.toml" }).waitFor();
  });

  await checks.check("the folder's files are listed with what was found in them, the worst first", async () => {
    await expectSoon("counts", async () => (await page.locator("#left .badge.error").count()) >= 2);
    const first = await page.locator("#left .row").first().innerText();
    expectEqual("the worst", first.startsWith("plate.dxf"), true);
    await page.keyboard.press("/");
    await page.keyboard.type("notch");
    await expectSoon("what was searched", async () => (await page.locator("#left .row").count()) === 1);
    await page.locator("#left input").fill("");
  });

  await checks.check("a fault that is clicked in the list is framed in the picture, and one in the picture is marked in the list", async () => {
    await bench.open("die.dxf");
    const whole = await page.locator("#stage > svg").getAttribute("viewBox");
    await bench.finding("small-radius").click();
    await card.locator("h2", { hasText: "R 0.080" }).waitFor();
    await page.locator("svg .fault.selected").first().waitFor();
    expectEqual("the whole drawing is seen", (await page.locator("#stage > svg").getAttribute("viewBox")) === whole, false);
    await page.keyboard.press("Escape");
    await page.locator("#fit").click();
    await page.locator("svg .mark .badge").first().click({ force: true });
    await page.locator('#panel-findings .row.finding[aria-selected="true"]', { hasText: "R 0.080" }).waitFor();
    await bench.turnTo("radii");
    await page.locator('#panel-radii .row[aria-selected="true"]', { hasText: "R 0.080" }).waitFor();
    await bench.turnTo("findings");
    await bench.shot("fault");
  });

  await checks.check("what is saved over the file is shown, and what is new and gone is said; zoom and selection stay", async () => {
    await bench.finding("small-radius").click();
    await page.waitForTimeout(300);
    const before = await page.locator("#stage > svg").getAttribute("viewBox");
    await bench.writeOver("die.dxf", DIE.replaceAll("19.92", "19.95").replaceAll("0.08", "0.05"));
    await bench.notice("die.dxf was saved").waitFor();
    await bench.finding("small-radius").filter({ hasText: "R 0.050" }).waitFor();
    expectEqual("the view", await page.locator("#stage > svg").getAttribute("viewBox"), before);
    expectEqual("selected", await page.locator("svg .fault.selected").count(), 1);
  });

  await checks.check("what is renamed over the file is shown, too", async () => {
    await bench.renameOver("die.dxf", DIE.replaceAll("19.92", "19.5").replaceAll("0.08", "0.5"));
    await bench.notice(/die\.dxf was saved: \d new, \d gone/).last().waitFor();
    await expectSoon("no radius too small", async () => (await bench.finding("small-radius").count()) === 0);
    await bench.renameOver("die.dxf", DIE);
    await bench.finding("small-radius").filter({ hasText: "R 0.080" }).waitFor();
    await page.locator("#panel-findings .badge.new").first().waitFor();
    await bench.shot("saved");
  });

  await checks.check("Fix writes the repaired drawing beside it, and shows it", async () => {
    await bench.finding("small-radius").click();
    await card.locator(".primary").click();
    await page.locator("#document", { hasText: "die-fixed.dxf" }).waitFor();
    await expectSoon("repaired", async () => (await bench.finding("small-radius").count()) === 0);
    expectBytes("the drawing itself", await bench.read("die.dxf"), Buffer.from(DIE));
    await bench.file("die-fixed.dxf").waitFor();
  });

  await checks.check("Fix all writes what wedm fix writes, byte for byte", async () => {
    await bench.open("plate.dxf");
    await page.locator("#repair-all").click();
    await page.locator("#document", { hasText: "plate-fixed.dxf" }).waitFor();
    await bench.wedm("fix", "plate.dxf", "-o", "expected.dxf");
    expectBytes("repaired", await bench.read("plate-fixed.dxf"), await bench.read("expected.dxf"));
  });

  await checks.check("in place when that is chosen, and back by Undo", async () => {
    await bench.open("notch.dxf");
    await page.locator("#where-repairs > button").click();
    await page.locator("#where-repairs [data-name=in-place]").click();
    await page.locator("#repair-all").click();
    await bench.notice("notch.dxf: ").waitFor();
    await bench.wedm("fix", "notch.dxf", "--in-place");
    expectEqual("changed", (await bench.read("notch.dxf")).equals(Buffer.from(NOTCH)), false);
    await bench.notice("notch.dxf: ").getByText("Undo").click();
    await expectSoon("as it was", async () => (await bench.read("notch.dxf")).equals(Buffer.from(NOTCH)));
  });

  await checks.check("the side of a contour is set by a click and kept in wedm.toml", async () => {
    await bench.open("die-fixed.dxf");
    await bench.turnTo("contours");
    await page.locator("#panel-contours .row").first().click();
    await card.getByText("Opening", { exact: true }).click();
    await page.locator("#panel-contours .row", { hasText: "Opening" }).waitFor();
    expectEqual("kept", /\[drawings\."die-fixed\.dxf"\.contours\.2A\]\nside = "opening"/.test((await bench.read("wedm.toml")).toString()), true);
  });

  await checks.check("the thread hole is picked in the picture", async () => {
    await page.keyboard.press("0");
    await card.locator(".row", { hasText: "Thread hole" }).locator("button").first().click();
    const stage = await page.locator("#stage").boundingBox();
    await page.mouse.click((stage?.x ?? 0) + 160, (stage?.y ?? 0) + (stage?.height ?? 0) / 2);
    await expectSoon("kept", async () => /\nthread = \[/.test((await bench.read("wedm.toml")).toString()));
    await page.keyboard.press("Escape");
  });

  for (const [name, ending, words] of [
    ["3b", "3b", []],
    ["iso", "iso", []],
    ["iso-robofil", "iso", ["--profile", "robofil"]],
    ["4b", "4b", []],
  ] as const) {
    await checks.check(`the program (${name}) is shown, and saved as the command line writes it, byte for byte`, async () => {
      await bench.open("die-fixed.dxf");
      await bench.hush();
      await bench.program(name);
      await page.locator("#keep", { hasText: `Save die-fixed.${ending}` }).waitFor();
      await page.locator("#panel-text .row").first().waitFor();
      await page.locator("#keep").click();
      const overwrite = page.locator("dialog [data-choice=overwrite]");
      const saved = bench.notice(`die-fixed.${ending} is saved`);
      await overwrite.or(saved).waitFor();
      if (await overwrite.isVisible()) {
        await overwrite.click();
      }
      await saved.waitFor();
      await bench.wedm("generate", "die-fixed.dxf", ...words, "-o", `expected.${ending}`, "--overwrite");
      expectBytes("the program", await bench.read(`die-fixed.${ending}`), await bench.read(`expected.${ending}`));
    });
  }

  await checks.check("the block under the wire is marked in the text, and one that is clicked is shown in the picture", async () => {
    await bench.open("die-fixed.3b");
    await bench.turnTo("text");
    await page.locator("#play").click();
    await page.locator('#panel-text .row[aria-selected="true"]', { hasText: "B" }).waitFor();
    await page.locator("#play").click();
    await page.locator("#panel-text .row").nth(2).click();
    await page.locator('#stage path[data-line="2"].selected').waitFor({ state: "attached" });
    await page.locator('#panel-text .row[aria-selected="true"]', { hasText: "3  B" }).waitFor();
    await bench.shot("program");
  });

  await checks.check("a drawing with errors makes a program only when that is said; a side that is missing is asked for, and kept", async () => {
    await bench.open("die.dxf");
    await bench.program("3b");
    await page.locator("dialog [data-choice=force]").click();
    await page.locator("dialog [data-choice=opening]").click();
    await expectSoon("kept", async () => /^side = "opening"$/m.test((await bench.read("wedm.toml")).toString()));
    await page.locator("#keep", { hasText: "Save die.3b" }).waitFor();
  });

  await checks.check("the programs of a pair, and how its parts fit", async () => {
    await bench.writeOver("pair.dxf", DIE.replaceAll("19.92", "19.5").replaceAll("0.08", "0.5"));
    await bench.open("pair.dxf");
    await bench.hush();
    await page.locator("#settings").click();
    await page.locator("dialog [name=drawnAs]").selectOption("punch");
    await page.locator("dialog [name=clearance]").fill("0.02");
    await page.locator("dialog [data-choice=save]").click();
    await bench.notice("wedm.toml is saved").last().waitFor();
    await page.locator("#fit-pair").click();
    await page.locator("#fit-pair[aria-pressed=true]").waitFor();
    await page.locator('body[data-kind="fit"] #stage > svg').waitFor();
    await bench.shot("fit");
    await page.locator("#fit-pair").click();
    await page.locator('body[data-kind="drawing"]').waitFor();
    await bench.program("pair");
    // Sharp corners bind: the finding says so, and the programs are made all the same.
    await page.locator("dialog [data-choice=force]").click();
    await bench.file("pair-plate.3b").waitFor();
    await bench.file("pair-punch.3b").waitFor();
  });

  await checks.check("the picture and the report are saved beside the drawing", async () => {
    await bench.open("plate-fixed.dxf");
    for (const [name, file, begin] of [["report", "plate-fixed-report.html", "<!doctype html>"], ["svg", "plate-fixed.svg", "<svg"], ["pdf", "plate-fixed.pdf", "%PDF"], ["png", "plate-fixed.png", "\u0089PNG"]] as const) {
      await page.locator("#exports > button").click();
      await page.locator(`#exports [data-name=${name}]`).click();
      await bench.notice(`${file} is saved`).waitFor();
      expectEqual(file, (await bench.read(file)).toString("latin1").startsWith(begin), true);
    }
  });

  await checks.check("no file that can be looked at says that it cannot", async () => {
    expectEqual("marks", await page.locator("#left .badge").filter({ hasText: "!" }).count(), 0);
  });

  await checks.check("no two parts of the page have one name", async () => {
    const ids = await page.locator("[id]").evaluateAll((all) => all.filter((each) => each.closest("svg") === null).map(({ id }) => id));
    expectEqual("names", ids.filter((id, index) => ids.indexOf(id) !== index), []);
  });

  await checks.check("the browser had nothing to complain of", () => {
    expectEqual("complaints", bench.complaints.filter((each) => !each.includes("404") && !each.includes("412")), []);
    return Promise.resolve();
  });
}

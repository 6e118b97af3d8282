// What a job begins and ends with: the wedm.toml, the programs of a pair, the report, and the walkthrough that leads to them.

import { readdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { type WindowChecks, expectEqual, expectSoon } from "./checks";
import { drawn, FILLET } from "./drawings";
import { Host } from "./host";
import { PROJECT, WEDM } from "./paths";
import { Window } from "./window";

const WASHER = drawn("0", "CIRCLE", "5", "2A", "8", "WASHER", "10", "0", "20", "0", "40", "5");
/** Its corners are sharp: as the plate they stay round, and the punch binds there. */
const DIE = await readFile(join(PROJECT, "docs/pictures/die.dxf"), "utf8");
const PAIR = 'wire-diameter = 0.18\ngap = 0.01\n[pair]\ndrawn-as = "plate"\nclearance = 0.02\n';

export async function deliver(checks: WindowChecks): Promise<void> {
  const host = await Host.start({ "wedm.server.path": WEDM }, { "washer.dxf": WASHER, "tight.dxf": FILLET, "die.dxf": DIE });
  const window = new Window(host.page);
  checks.page = host.page;
  const text = (name: string) => (): Promise<string> => readFile(join(host.folder, name), "utf8");
  const quick = host.page.locator(".quick-input-widget");
  /** A question: the placeholder of a list, the prompt of a box. */
  const asked = (question: string): Promise<void> => quick.getByPlaceholder(question).or(quick.getByText(question)).first().waitFor();
  const answer = async (question: string, text?: string): Promise<void> => {
    await asked(question);
    if (text !== undefined) {
      await quick.locator("input").fill(text);
    }
    await host.page.keyboard.press("Enter");
  };
  const page = (): ReturnType<Window["picture"]> => window.picture(false);
  const read = async (): Promise<string> => (await page()).locator("body").innerText();
  try {
    await checks.check("of a pair that is not set the server says what is missing, and a wedm.toml is made for it", async () => {
      await window.openOurs("washer.dxf");
      await window.command("Wire EDM: Generate the Programs of the Pair…");
      await answer("What the machine reads");
      const refused = window.notification("No program: the corrections of a pair are not known: set pair.drawn-as");
      await refused.waitFor();
      await checks.shot("pair-not-set");
      await refused.getByRole("button", { name: "Create wedm.toml…" }).click();
      await answer("Diameter of the wire, mm", "0,2");
      await asked("Spark gap, mm");
      await quick.locator("input").fill("0");
      await quick.getByText("expected a number above 0, in mm").waitFor();
      await checks.shot("settings-gap");
      await quick.locator("input").fill("0.02");
      await host.page.keyboard.press("Enter");
      await answer("Passes along each contour", "3");
      await quick.getByText("ISO: robofil").waitFor();
      await checks.shot("settings-machine");
      await answer("What the machine reads", "robofil");
      await window.tab("wedm.toml");
      expectEqual("wire", (await text("wedm.toml")()).includes("\nwire-diameter = 0.2\n"), true);
      expectEqual("passes", (await text("wedm.toml")()).includes("\ncorrections = [0.1800, 0.1400, 0.1100]\n"), true);
      expectEqual("profile", (await text("wedm.toml")()).includes('\nprofile = "robofil"\n'), true);
      await host.page.locator(".view-lines", { hasText: "[pair]" }).waitFor();
      await checks.shot("settings-made");
    });
    await checks.check("where a wedm.toml is there it is opened, and not made anew", async () => {
      const before = await text("wedm.toml")();
      await window.close("wedm.toml");
      await window.turnTo("washer.dxf");
      await window.command("Wire EDM: Create wedm.toml…");
      await window.tab("wedm.toml");
      expectEqual("as it was", await text("wedm.toml")(), before);
    });
    await checks.check("the programs of a pair are written beside the drawing, and told in one message", async () => {
      await window.turnTo("washer.dxf");
      await window.hold(host.folder, PAIR, "0.100");
      await window.command("Wire EDM: Generate the Programs of the Pair…");
      await asked("What the machine reads");
      await checks.shot("pair-format");
      await answer("What the machine reads", "3B");
      await asked("The folder that it is written to");
      await checks.shot("pair-folder");
      await host.page.keyboard.press("Enter");
      await window.tab("washer-punch.3b");
      const said = window.notification("3B: punch: correction 0.0800 mm, ");
      await expectSoon("both parts", async () => /plate: correction 0\.1000 mm, \d+ blocks, cut [\d.]+ mm\./.test(await said.innerText()), () => said.innerText());
      await checks.shot("pair-made");
      expectEqual("programs", (await readdir(host.folder)).filter((name) => name.endsWith(".3b")).sort(), ["washer-plate.3b", "washer-punch.3b"]);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("programs that are there are only overwritten when that is said", async () => {
      await writeFile(join(host.folder, "washer-plate.3b"), "mine\n");
      const again = async (button: string): Promise<void> => {
        await window.turnTo("washer.dxf");
        await window.command("Wire EDM: Generate the Programs of the Pair…");
        await answer("What the machine reads", "3B");
        await answer("The folder that it is written to");
        const dialog = host.page.locator(".monaco-dialog-box", { hasText: "washer-punch.3b, washer-plate.3b are there already" });
        await dialog.waitFor();
        await checks.shot("pair-overwrite");
        await dialog.getByRole("button", { name: button }).click();
        await dialog.waitFor({ state: "detached" });
      };
      await again("Cancel");
      expectEqual("kept", await text("washer-plate.3b")(), "mine\n");
      await again("Overwrite");
      await expectSoon("the program", async () => (await text("washer-plate.3b")()).startsWith("B"), text("washer-plate.3b"));
      await window.notification("3B: punch").waitFor();
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("an ISO program of each part is written by the profile that is chosen", async () => {
      await window.turnTo("washer.dxf");
      await window.command("Wire EDM: Generate the Programs of the Pair…");
      await answer("What the machine reads", "ISO");
      await answer("How the ISO program is written", "generic");
      await answer("The folder that it is written to");
      await window.tab("washer-punch.iso");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("parts that do not fit are refused, and written all the same when that is said", async () => {
      await window.openOurs("die.dxf");
      await window.command("Wire EDM: Generate the Programs of the Pair…");
      await answer("What the machine reads", "3B");
      const refused = window.notification("No program: ");
      await refused.getByRole("button", { name: "Show Problems" }).waitFor();
      await checks.shot("pair-refused");
      expectEqual("nothing written", (await readdir(host.folder)).filter((name) => name.startsWith("die-")), []);
      await refused.getByRole("button", { name: "Generate All the Same" }).click();
      await answer("The folder that it is written to");
      await window.tab("die-punch.3b");
      const said = window.notification("3B: punch");
      await expectSoon("what stands in the drawing", async () => /The drawing has \d+ findings?\./.test(await said.innerText()), () => said.innerText());
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a report of the drawing in front is made of what stands in its text, and shown", async () => {
      await window.turnTo("washer.dxf");
      const line = WASHER.split("\n").indexOf("40") + 2;
      await window.goToLine(line);
      await host.page.keyboard.press("Shift+End");
      await host.page.keyboard.type("6");
      await window.command("Wire EDM: Make a Report…");
      await asked("The folder that it is written to");
      await checks.shot("report-folder");
      await host.page.keyboard.press("Enter");
      await window.notification("the report is written: report/index.html").waitFor();
      await expectSoon("the index", async () => (await read()).includes("Report of 1 drawing"), read);
      expectEqual("its name", await (await page()).locator("a").innerText(), "washer.dxf");
      await checks.shot("report-index");
      await (await page()).locator("a", { hasText: "washer" }).click();
      await expectSoon("its page", async () => (await read()).includes("6.0000"), read);
      await checks.shot("report-page");
      expectEqual("saved", (await text("washer.dxf")()).includes("\n40\n6\n"), true);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("a report is made where VS Code saves the drawing by itself at that very moment, too", async () => {
      // A second after the last key auto save begins: the command asks for its save shortly before, in its midst, and after it.
      for (const after of [860, 900, 940, 980, 1020]) {
        await window.turnTo("washer.dxf");
        await window.goToLine(WASHER.split("\n").indexOf("40") + 2);
        await host.page.keyboard.press("Shift+End");
        await host.page.keyboard.type("5");
        const typed = Date.now();
        await window.command("Wire EDM: Make a Report…");
        await asked("The folder that it is written to");
        await host.page.waitForTimeout(Math.max(0, typed + after - Date.now()));
        await host.page.keyboard.press("Enter");
        await window.notification("the report is written: report/index.html").waitFor();
        await window.command("Notifications: Clear All Notifications");
      }
    });
    await checks.check("a report of a drawing is made from the Explorer, and says that there are errors", async () => {
      await writeFile(join(host.folder, "wedm.toml"), 'side = "opening"\n');
      await host.page.locator(".explorer-folders-view .monaco-list-row", { hasText: "tight.dxf" }).first().click({ button: "right" });
      await checks.shot("report-menu");
      await host.page.locator(".monaco-menu .action-label", { hasText: "Make a Report…" }).click();
      await answer("The folder that it is written to");
      await window.notification("There are errors in a drawing.").waitFor();
      await expectSoon("the index", async () => (await read()).includes("tight"), read);
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("what the command says of a page that it would destroy is said", async () => {
      await writeFile(join(host.folder, "report/index.html"), "mine");
      await window.turnTo("washer.dxf");
      await window.command("Wire EDM: Make a Report…");
      await answer("The folder that it is written to");
      const said = window.notification("it already exists and is not from an earlier run");
      await said.waitFor();
      await checks.shot("report-refused");
      expectEqual("kept", await text("report/index.html")(), "mine");
      await window.command("Notifications: Clear All Notifications");
    });
    await checks.check("the walkthrough leads from a drawing to a program", async () => {
      await window.command("Welcome: Open Walkthrough...");
      await answer("Wire EDM", "Get Started with Wire EDM");
      const steps = host.page.locator(".gettingStartedContainer .getting-started-step");
      await expectSoon("five steps", async () => (await steps.count()) === 5, async () => String(await steps.count()));
      for (const title of ["Open a Drawing", "See an Arc", "Write a Proved Program", "Punch and Plate", "Set Wire, Gap and Machine"]) {
        await steps.filter({ hasText: title }).first().click();
        await expectSoon(`the page of ${title}`, async () => (await read()).trim() !== "");
        await host.page.waitForTimeout(1_000);
        const images = (await page()).locator("img");
        expectEqual(`pictures of ${title}`, await images.evaluateAll((all) => all.filter((image) => (image as HTMLImageElement).naturalWidth === 0).length), 0);
        await checks.shot(`walkthrough-${title.replaceAll(/\W+/g, "-")}`);
      }
      await steps.locator("a, .button", { hasText: "Create wedm.toml…" }).first().click();
      await window.tab("wedm.toml");
      await window.turnTo("washer.dxf");
      await window.command("Wire EDM: Open Picture Beside");
      await window.pictureOf("washer.dxf");
      await host.page.locator(".tabs-container .tab", { hasText: "Walkthrough" }).click();
      const done = steps.filter({ has: host.page.locator(".codicon.complete") });
      const ticked = async (): Promise<string> => (await done.locator(".step-title").allInnerTexts()).join(", ");
      await expectSoon("what has been done is ticked", async () => (await ticked()) === "Open a Drawing, Set Wire, Gap and Machine", ticked);
      await checks.shot("walkthrough-ticked");
    });
  } finally {
    await host.stop();
  }
}

// A 3B program: colours, diagnostics, the picture with the wire that is played along it.

import { type Checks, expectEqual, expectSoon } from "./checks";
import { HOLE } from "./drawings";
import { Host } from "./host";
import { WEDM } from "./paths";
import { Window } from "./window";

export async function program(checks: Checks): Promise<void> {
  const host = await Host.start({ "wedm.server.path": WEDM }, { "hole.3b": HOLE, "broken.3b": "B1000B0B1000GXL1\nQQQ\nDD\n" });
  const window = new Window(host.page);
  checks.page = host.page;
  try {
    await checks.check("a fault in a program is underlined", async () => {
      await window.openOurs("broken.3b");
      await window.squiggles.first().waitFor();
    });
    await checks.check("the wire is played along the program, and the text follows", async () => {
      await window.openOurs("hole.3b");
      await window.command("Wire EDM: Play the Wire Along the Program");
      const page = await window.picture();
      const slider = page.locator("#slider");
      await expectSoon("a wire that moves", async () => Number(await slider.inputValue()) > 100, () => slider.inputValue());
      await page.locator("#play").click();
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
      await page.locator('svg path[data-line="1"]').first().dispatchEvent("pointerdown", { button: 0, pointerId: 1 });
      const box = await page.locator('svg path[data-line="1"]').first().boundingBox();
      if (box === null) {
        throw new Error("block 2 has no place");
      }
      await host.page.mouse.click(box.x + box.width / 2, box.y + 1);
      await window.expectLine(2);
    });
  } finally {
    await host.stop();
  }
}

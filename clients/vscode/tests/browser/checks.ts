// What holds of the window, and what does not.

import { join } from "node:path";
import type { Page } from "playwright-core";
import { Checks, type Holds, type Seen, until } from "../../../checks";
import { ARTIFACTS } from "./paths";

export { expectEqual } from "../../../checks";

/** Longer than anything here takes on a busy machine, ms. */
export const PATIENCE = Number(process.env["PATIENCE"] ?? 300_000);

/** How long VS Code takes to show a notice in full, ms. */
const FADING = 400;

export class WindowChecks extends Checks {
  page: Page | undefined;

  protected async keep(name: string): Promise<void> {
    console.log(`  what stands there: ${JSON.stringify(await this.#said())}`);
    await this.shot(name);
  }

  /** What the window says to its user: notices, the question that is asked, the tab in front. */
  async #said(): Promise<string[] | undefined> {
    const said = this.page?.locator(".notification-list-item:visible, .quick-input-widget:visible, .tabs-container .tab.active");
    return said?.allInnerTexts().catch(() => []);
  }

  async shot(name: string): Promise<void> {
    // Notices fade in.
    await this.page?.waitForTimeout(FADING);
    await this.page?.screenshot({ path: join(ARTIFACTS, `${name}.png`) }).catch(() => undefined);
  }
}

export async function expectSoon(what: string, holds: Holds, seen?: Seen, patience = PATIENCE): Promise<void> {
  await until(patience, what, holds, seen);
}

/** Acts until something holds: a window that is laid out anew just then loses a key or a click, and a person does it again. */
export async function actUntil(what: string, act: () => Promise<unknown>, holds: Holds, seen?: Seen): Promise<void> {
  const deadline = Date.now() + PATIENCE;
  for (let patience = 8_000; ; patience *= 2) {
    await act();
    const left = deadline - Date.now();
    try {
      await expectSoon(what, holds, seen, Math.min(patience, left));
      return;
    } catch (error) {
      if (left <= patience) {
        throw error;
      }
    }
  }
}

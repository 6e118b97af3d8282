// Counts what holds and what does not.

import { join } from "node:path";
import type { Page } from "playwright-core";
import { ARTIFACTS } from "./paths";

/** Longer than anything here takes on a busy machine, ms. */
export const PATIENCE = Number(process.env["PATIENCE"] ?? 300_000);

/** How long VS Code takes to show a notice in full, ms. */
const FADING = 400;

export class Checks {
  passed = 0;
  failed = 0;
  page: Page | undefined;

  async check(name: string, act: () => Promise<void>): Promise<void> {
    const began = Date.now();
    try {
      await act();
      this.passed += 1;
      console.log(`  ok      ${name} (${Date.now() - began} ms)`);
    } catch (error) {
      await this.fail(name, error);
    }
  }

  async fail(name: string, error: unknown): Promise<void> {
    this.failed += 1;
    console.log(`  FAILED  ${name}: ${error instanceof Error ? (error.stack ?? error.message) : String(error)}`);
    console.log(`  what stands there: ${JSON.stringify(await this.#said())}`);
    await this.shot(`failed-${name.replaceAll(/\W+/g, "-")}`);
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

type Holds = () => Promise<boolean>;
type Seen = () => Promise<string>;

/** Waits until something holds; `seen` tells what is there instead. */
export async function expectSoon(what: string, holds: Holds, seen: Seen = () => Promise.resolve("not so"), patience = PATIENCE): Promise<void> {
  const deadline = Date.now() + patience;
  for (;;) {
    if (await holds().catch(() => false)) {
      return;
    }
    if (Date.now() > deadline) {
      throw new Error(`expected ${what}, seen: ${await seen().catch(String)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
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

export function expectEqual(what: string, seen: unknown, expected: unknown): void {
  const [a, b] = [JSON.stringify(seen), JSON.stringify(expected)];
  if (a !== b) {
    throw new Error(`${what}: expected ${b}, seen ${a}`);
  }
}

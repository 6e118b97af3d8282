// Counts what holds and what does not.

import type { Bench } from "./bench";
import { PATIENCE } from "./bench";

export class Checks {
  passed = 0;
  failed = 0;
  bench: Bench | undefined;

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
    await this.bench?.shot(`failed-${name.replaceAll(/\W+/g, "-")}`).catch(() => undefined);
  }
}

/** Waits until something holds; `seen` tells what is there instead. */
export async function expectSoon(what: string, holds: () => Promise<boolean>, seen: () => Promise<string> = () => Promise.resolve("not so")): Promise<void> {
  const deadline = Date.now() + PATIENCE;
  while (!(await holds().catch(() => false))) {
    if (Date.now() > deadline) {
      throw new Error(`expected ${what}, seen: ${await seen().catch(String)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 30));
  }
}

export function expectEqual(what: string, seen: unknown, expected: unknown): void {
  const [a, b] = [JSON.stringify(seen), JSON.stringify(expected)];
  if (a !== b) {
    throw new Error(`${what}: expected ${b}, seen ${a}`);
  }
}

export function expectBytes(what: string, seen: Buffer, expected: Buffer): void {
  if (!seen.equals(expected)) {
    throw new Error(`${what}: ${seen.length} bytes are not those ${expected.length} that were expected`);
  }
}

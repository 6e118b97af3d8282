// Counts what holds and what does not, for the tests of pages in a real browser.

export abstract class Checks {
  passed = 0;
  failed = 0;

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
    await this.keep(`failed-${name.replaceAll(/\W+/g, "-")}`);
  }

  /** Keeps what is seen when a check has failed. */
  protected abstract keep(name: string): Promise<void>;
}

export type Holds = () => Promise<boolean>;
export type Seen = () => Promise<string>;

/** Waits until something holds, so many ms; `seen` tells what is there instead. */
export async function until(patience: number, what: string, holds: Holds, seen: Seen = () => Promise.resolve("not so")): Promise<void> {
  const deadline = Date.now() + patience;
  while (!(await holds().catch(() => false))) {
    if (Date.now() > deadline) {
      throw new Error(`expected ${what}, seen: ${await seen().catch(String)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

export function expectEqual(what: string, seen: unknown, expected: unknown): void {
  const [a, b] = [JSON.stringify(seen), JSON.stringify(expected)];
  if (a !== b) {
    throw new Error(`${what}: expected ${b}, seen ${a}`);
  }
}

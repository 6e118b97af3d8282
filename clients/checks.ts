// Counts what holds and what does not, for the tests of pages in a real browser.

export abstract class Checks {
  passed = 0;
  failed = 0;

  /** `scenario` stands before the name of each check: scenarios may run beside each other. */
  constructor(private readonly scenario: string) {}

  async check(name: string, act: () => Promise<void>): Promise<void> {
    const began = Date.now();
    try {
      await act();
      this.passed += 1;
      console.log(`  ok      ${this.scenario}: ${name} (${Date.now() - began} ms)`);
    } catch (error) {
      await this.fail(name, error);
    }
  }

  async fail(name: string, error: unknown): Promise<void> {
    this.failed += 1;
    console.log(`  FAILED  ${this.scenario}: ${name}: ${error instanceof Error ? (error.stack ?? error.message) : String(error)}`);
    await this.keep(`failed-${this.scenario}-${name.replaceAll(/\W+/g, "-")}`);
  }

  /** Keeps what is seen when a check has failed. */
  protected abstract keep(name: string): Promise<void>;

  /** Closes what a scenario has left open. */
  async end(): Promise<void> {}
}

/**
 * Runs the scenarios that the command line names, without a name all that are not `onlyByName`, so many at a time; prints their sum,
 * which is the exit code, too.
 */
export async function runScenarios<C extends Checks>(
  scenarios: Record<string, (checks: C) => Promise<void>>,
  begin: (scenario: string) => C,
  onlyByName: string,
  atOnce: number,
): Promise<void> {
  const named = process.argv.slice(2);
  const waiting = Object.entries(scenarios).filter(([name]) => (named.length === 0 ? name !== onlyByName : named.includes(name)));
  let [passed, failed] = [0, 0];
  const runNext = async (): Promise<void> => {
    for (let next = waiting.shift(); next !== undefined; next = waiting.shift()) {
      const [name, scenario] = next;
      const checks = begin(name);
      await scenario(checks).catch((error: unknown) => checks.fail("it starts and ends", error));
      await checks.end();
      passed += checks.passed;
      failed += checks.failed;
    }
  };
  await Promise.all(Array.from({ length: atOnce }, runNext));
  console.log(`${passed} passed, ${failed} failed`);
  process.exitCode = failed === 0 ? 0 : 1;
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

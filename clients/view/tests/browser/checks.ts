// What holds of the page, and what does not.

import { Checks, type Holds, type Seen, until } from "../../../checks";
import type { Bench } from "./bench";
import { PATIENCE } from "./bench";

export { expectEqual } from "../../../checks";

export class PageChecks extends Checks {
  bench: Bench | undefined;

  protected async keep(name: string): Promise<void> {
    await this.bench?.shot(name).catch(() => undefined);
  }

  override async end(): Promise<void> {
    await this.bench?.stop();
  }
}

export async function expectSoon(what: string, holds: Holds, seen?: Seen): Promise<void> {
  await until(PATIENCE, what, holds, seen);
}

export function expectBytes(what: string, seen: Buffer, expected: Buffer): void {
  if (!seen.equals(expected)) {
    throw new Error(`${what}: ${seen.length} bytes are not those ${expected.length} that were expected`);
  }
}

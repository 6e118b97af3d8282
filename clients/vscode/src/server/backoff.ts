// How long to wait before a server that died is started again, and when to stop trying.

/** Waits in ms, one after another. */
const WAITS = [250, 1_000, 3_000, 8_000, 20_000];
/** A server that lived this long was sound: what comes next is a new trouble. */
const SOUND = 60_000;

export class Backoff {
  #deaths = 0;
  #started = 0;

  started(now: number): void {
    this.#started = now;
  }

  /** The wait before the next try in ms, or null when the server has died too often. */
  died(now: number): number | null {
    if (this.#started > 0 && now - this.#started >= SOUND) {
      this.#deaths = 0;
    }
    this.#started = 0;
    const wait = WAITS[this.#deaths] ?? null;
    this.#deaths += 1;
    return wait;
  }

  /** The user asked for a new start. */
  reset(): void {
    this.#deaths = 0;
    this.#started = 0;
  }
}

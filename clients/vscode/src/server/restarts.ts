// How often a server that ends is started again, and after what pause: "When the server ends" in docs/protocol.md.

/** The pauses before the starts in a row, in ms. */
const PAUSES = [0, 500, 1_000, 2_000, 4_000];
/** A server that lived this long was sound: its end is the first of a new row. */
const SOUND_LIFE = 60_000;

export class Restarts {
  #ends = 0;

  /** The pause in ms after a server that ended `life` ms after its answer to `initialize` (0: none came); null when it ended too often. */
  afterLifeOf(life: number): number | null {
    if (life >= SOUND_LIFE) {
      this.#ends = 0;
    }
    const pause = PAUSES[this.#ends] ?? null;
    if (pause !== null) {
      this.#ends += 1;
    }
    return pause;
  }

  /** The user asked for a new start: earlier ends no longer count. */
  reset(): void {
    this.#ends = 0;
  }
}

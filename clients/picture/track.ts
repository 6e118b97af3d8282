// The way of the wire as a list of pieces with their lengths: where it is after which distance.

export interface Spot {
  /** Index of the piece. */
  piece: number;
  /** From the beginning of the piece. */
  along: number;
}

export class Track {
  /** Distance at which each piece ends. */
  readonly #ends: number[] = [];

  constructor(lengths: readonly number[]) {
    let end = 0;
    for (const length of lengths) {
      end += Number.isFinite(length) ? Math.max(length, 0) : 0;
      this.#ends.push(end);
    }
  }

  get length(): number {
    return this.#ends.at(-1) ?? 0;
  }

  /** Distances before the beginning or after the end count as the ends. Null for a way without pieces. */
  at(distance: number): Spot | null {
    if (this.#ends.length === 0) {
      return null;
    }
    const wanted = Math.min(Math.max(distance, 0), this.length);
    let [low, high] = [0, this.#ends.length - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#ends[middle] ?? 0) < wanted) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return { piece: low, along: wanted - this.startOf(low) };
  }

  startOf(piece: number): number {
    return piece === 0 ? 0 : (this.#ends[piece - 1] ?? 0);
  }
}

// What of a picture stands for which segment of an entity, or for which line of a program.

export interface Picked {
  handle?: string;
  segment?: number;
  line?: number;
}

/** What an element of the server's SVG stands for. */
export function namesOf({ dataset: { handle, segment, line } }: SVGElement): Picked {
  return {
    ...(handle === undefined ? {} : { handle }),
    ...(segment === undefined ? {} : { segment: Number(segment) }),
    ...(line === undefined ? {} : { line: Number(line) }),
  };
}

export class Named<T> {
  readonly #bySegment = new Map<string, T[]>();
  readonly #byLine = new Map<number, T[]>();

  add({ handle, segment, line }: Picked, one: T): void {
    if (handle !== undefined) {
      add(this.#bySegment, key(handle, null), one);
      if (segment !== undefined) {
        add(this.#bySegment, key(handle, segment), one);
      }
    }
    if (line !== undefined) {
      add(this.#byLine, line, one);
    }
  }

  /** All that stands for the segment; for the entity with null, or where nothing stands for that segment alone. */
  ofSegment(handle: string, segment: number | null): readonly T[] {
    return this.#bySegment.get(key(handle, segment)) ?? this.#bySegment.get(key(handle, null)) ?? [];
  }

  ofLine(line: number): readonly T[] {
    return this.#byLine.get(line) ?? [];
  }
}

function key(handle: string, segment: number | null): string {
  return `${handle}\n${segment ?? ""}`;
}

function add<K, T>(map: Map<K, T[]>, at: K, one: T): void {
  const list = map.get(at);
  if (list === undefined) {
    map.set(at, [one]);
  } else {
    list.push(one);
  }
}

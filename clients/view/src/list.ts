// A list of rows of one height, of which only those that are seen are in the page; chosen by the pointer or by the keys.

import { make } from "./dom";

export interface Row {
  /** By which the row is found again when the list is put anew. */
  key: string;
  text: string;
  detail?: string;
  /** Beside the text, as counts are. */
  badges?: { text: string; kind: string; title?: string }[];
  /** Classes of the row. */
  kind?: string;
  title?: string;
}

/** Rows beyond those that are seen, above and below. */
const SPARE = 8;

export class List {
  readonly element: HTMLElement;
  readonly #room = make("div", { class: "room" });
  #rows: readonly Row[] = [];
  #chosen = -1;
  /** The row that is to be marked; it may come later. */
  #wanted: string | null = null;
  #height = 0;

  constructor(
    label: string,
    /** `opened`: by Enter or a double click. */
    private readonly choose: (row: Row, opened: boolean) => void,
    private readonly empty: string,
  ) {
    this.element = make("div", { class: "list", role: "listbox", tabindex: 0, "aria-label": label }, this.#room);
    this.element.addEventListener("scroll", () => {
      this.#draw();
    });
    new ResizeObserver(() => {
      this.#draw();
    }).observe(this.element);
    this.element.addEventListener("click", (event) => {
      this.#pointed(event, false);
    });
    this.element.addEventListener("dblclick", (event) => {
      this.#pointed(event, true);
    });
    this.element.addEventListener("keydown", (event) => {
      this.#key(event);
    });
  }

  get rows(): readonly Row[] {
    return this.#rows;
  }

  put(rows: readonly Row[]): void {
    this.#rows = rows;
    this.#chosen = rows.findIndex((row) => row.key === this.#wanted);
    this.#draw();
  }

  /** Marks a row and brings it into view; nothing is told. */
  mark(key: string | null): void {
    this.#wanted = key;
    this.#chosen = this.#rows.findIndex((row) => row.key === key);
    this.#bring();
  }

  #bring(): void {
    const [top, height] = [this.#chosen * this.#height, this.#height];
    const { scrollTop, clientHeight } = this.element;
    if (this.#chosen >= 0 && (top < scrollTop || top + height > scrollTop + clientHeight)) {
      this.element.scrollTop = top - (clientHeight - height) / 2;
    }
    this.#draw();
  }

  /** Goes on to the next row, or back, among those that are no heads. */
  step(by: number): void {
    let at = this.#chosen;
    do {
      at += by;
    } while (this.#rows[at]?.kind?.includes("head") === true && this.#rows[at + by] !== undefined);
    if (this.#rows[at] !== undefined) {
      this.#choose(at, false);
    }
  }

  #choose(at: number, opened: boolean): void {
    const row = this.#rows[Math.min(Math.max(at, 0), this.#rows.length - 1)];
    if (row !== undefined) {
      this.#chosen = this.#rows.indexOf(row);
      this.#wanted = row.key;
      this.#bring();
      this.choose(row, opened);
    }
  }

  #pointed(event: Event, opened: boolean): void {
    const row = event.target instanceof Element ? event.target.closest<HTMLElement>(".row") : null;
    if (row !== null) {
      this.#choose(Number(row.dataset["at"]), opened);
    }
  }

  #key(event: KeyboardEvent): void {
    const page = Math.max(Math.floor(this.element.clientHeight / Math.max(this.#height, 1)) - 1, 1);
    const acts: Record<string, () => void> = {
      ArrowDown: () => { this.#choose(this.#chosen + 1, false); },
      ArrowUp: () => { this.#choose(this.#chosen - 1, false); },
      PageDown: () => { this.#choose(this.#chosen + page, false); },
      PageUp: () => { this.#choose(this.#chosen - page, false); },
      Home: () => { this.#choose(0, false); },
      End: () => { this.#choose(this.#rows.length - 1, false); },
      Enter: () => { this.#choose(this.#chosen, true); },
      " ": () => { this.#choose(this.#chosen, true); },
    };
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : acts[event.key];
    if (act !== undefined) {
      event.preventDefault();
      event.stopPropagation();
      act();
    }
  }

  #draw(): void {
    this.#height = Number.parseFloat(getComputedStyle(this.element).getPropertyValue("--row")) || 24;
    const { scrollTop, clientHeight } = this.element;
    this.#room.style.height = `${this.#rows.length * this.#height}px`;
    const first = Math.max(Math.floor(scrollTop / this.#height) - SPARE, 0);
    const seen = this.#rows.slice(first, first + Math.ceil(clientHeight / this.#height) + 2 * SPARE);
    this.#room.replaceChildren(...seen.map((row, index) => this.#rowOf(row, first + index)));
    this.element.classList.toggle("empty", this.#rows.length === 0);
    this.element.dataset["empty"] = this.empty;
    const active = `${this.element.getAttribute("aria-label") ?? ""}-${this.#chosen}`;
    this.element.setAttribute("aria-activedescendant", this.#chosen >= 0 ? active : "");
  }

  #rowOf({ text, detail, badges = [], kind = "", title }: Row, at: number): HTMLElement {
    const marks = badges.map((badge) => make("b", { class: `badge ${badge.kind}`, text: badge.text, title: badge.title ?? null }));
    const row = make(
      "div",
      {
        class: `row ${kind}`, role: "option", "data-at": at, title: title ?? text, id: `${this.element.getAttribute("aria-label") ?? ""}-${at}`,
        "aria-selected": String(at === this.#chosen), "aria-setsize": this.#rows.length, "aria-posinset": at + 1,
      },
      make("span", { class: "text", text }),
      ...marks,
      detail === undefined ? null : make("span", { class: "detail", text: detail }),
    );
    row.style.top = `${at * this.#height}px`;
    return row;
  }
}

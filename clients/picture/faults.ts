// The findings below the picture: rules with their counts, of which one may be chosen, and each finding as a button to its place.

import type { Contour, Fault, Severity } from "./messages";
import { element } from "./host";
import { markNumbers } from "./numbers";
import { byHandle } from "./shown";
import { t } from "./words";

/** More chips than this nobody reads; all of them are under Problems. */
const MOST = 200;
const WORST: readonly Severity[] = ["error", "warning", "information", "hint"];

export class Faults {
  #all: readonly Fault[] = [];
  #contours: ReadonlyMap<string, Contour> = new Map();
  /** The number of the mark of each finding. */
  #numbers: readonly (number | undefined)[] = [];
  /** The only rule that is shown, if one is chosen. */
  #only: string | null = null;

  constructor(private readonly chosen: (index: number) => void) {}

  put(faults: readonly Fault[], contours: readonly Contour[]): void {
    this.#all = faults;
    this.#contours = byHandle(contours);
    this.#numbers = markNumbers(faults);
    if (!faults.some(({ rule }) => rule === this.#only)) {
      this.#only = null;
    }
    this.#show();
  }

  /** Indices of the findings: the worst first, among those the smallest radius first, else as they came. */
  static sorted(faults: readonly Fault[]): number[] {
    const rank = ({ severity }: Fault): number => WORST.indexOf(severity);
    const radius = (fault: Fault): number => fault.radius ?? Number.POSITIVE_INFINITY;
    const far = (a: number, b: number): number => (a === b ? 0 : a - b);
    const all = faults.map((fault, index) => ({ fault, index }));
    all.sort((a, b) => rank(a.fault) - rank(b.fault) || far(radius(a.fault), radius(b.fault)) || a.index - b.index);
    return all.map(({ index }) => index);
  }

  #show(): void {
    const strip = element("faults", HTMLElement);
    const order = Faults.sorted(this.#all);
    const rules = new Map<string, { count: number; severity: Severity }>();
    for (const index of order) {
      const fault = this.#all[index];
      if (fault !== undefined) {
        const rule = rules.get(fault.rule) ?? { count: 0, severity: fault.severity };
        rules.set(fault.rule, { ...rule, count: rule.count + 1 });
      }
    }
    strip.hidden = order.length === 0;
    const bar = element("rules", HTMLElement);
    bar.hidden = rules.size < 2 && order.length < 2;
    bar.replaceChildren(...[...rules].map(([rule, { count, severity }]) => this.#rule(rule, count, severity)));
    const shown = order.filter((index) => this.#only === null || this.#all[index]?.rule === this.#only);
    const chips = shown.slice(0, MOST).flatMap((index) => {
      const fault = this.#all[index];
      return fault === undefined ? [] : [this.#chip(fault, index)];
    });
    const more = document.createElement("span");
    more.className = "more";
    more.textContent = shown.length > MOST ? t("and {0} more, under Problems", shown.length - MOST) : "";
    element("chips", HTMLElement).replaceChildren(...chips, more);
  }

  #rule(rule: string, count: number, severity: Severity): HTMLButtonElement {
    const button = document.createElement("button");
    button.className = `rule ${severity}`;
    button.setAttribute("aria-pressed", String(this.#only === rule));
    const number = document.createElement("b");
    number.textContent = String(count);
    button.append(rule, number);
    button.addEventListener("click", () => {
      this.#only = this.#only === rule ? null : rule;
      this.#show();
    });
    return button;
  }

  #chip(fault: Fault, index: number): HTMLButtonElement {
    const button = document.createElement("button");
    button.className = `chip ${fault.severity}`;
    button.title = fault.message;
    const name = document.createElement("b");
    name.textContent = this.#placeOf(fault);
    const what = document.createElement("span");
    const radius = fault.radius !== undefined && fault.rule === "small-radius" ? `R ${fault.radius.toFixed(3)} mm` : null;
    what.textContent = fault.left ?? radius ?? fault.rule;
    const number = this.#numbers[index];
    if (number !== undefined) {
      const mark = document.createElement("i");
      mark.textContent = String(number);
      button.append(mark);
    }
    button.append(name, what);
    button.addEventListener("click", () => {
      this.chosen(index);
    });
    return button;
  }

  /** A contour by its number, an entity in none by its handle, a block by its line. */
  #placeOf({ handle, segment, line }: Fault): string {
    if (handle === undefined) {
      return line === undefined ? "" : t("line {0}", line + 1);
    }
    const contour = this.#contours.get(handle);
    if (contour !== undefined) {
      return t("contour {0}", contour.number);
    }
    return segment === undefined ? handle : `${handle} · ${segment}`;
  }
}

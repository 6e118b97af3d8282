// The card of what is picked: a finding with its reason and its repairs, or a contour with its settings.

import type { Card, Contour, Fault, Said } from "./messages";
import type { Repair, Role } from "./protocol";
import { element, type Host } from "./host";
import { t } from "./words";

/** What the next click in the picture sets. */
export interface Asking {
  key: "thread" | "entry";
  contour: Contour;
}

export class Cards {
  readonly #card = element("card", HTMLElement);
  #asking: Asking | null = null;
  #open: Contour | null = null;

  constructor(
    private readonly host: Host,
    /** Shows what a repair would bring; null for nothing. */
    private readonly ghost: (repair: Repair | null) => void,
    private readonly asked: (asking: Asking | null) => void,
  ) {
    this.#card.addEventListener("pointerdown", (event) => {
      event.stopPropagation();
    });
    this.#card.addEventListener("dblclick", (event) => {
      event.stopPropagation();
    });
    this.#card.addEventListener("wheel", (event) => {
      event.stopPropagation();
    });
  }

  /** The contour whose card is open. */
  get open(): Contour | null {
    return this.#open;
  }

  get asking(): Asking | null {
    return this.#asking;
  }

  /** Another picture: the card of a contour stays, with its present settings; that of a finding goes. */
  refresh(contours: readonly Contour[], keeps: boolean): void {
    const name = this.#open?.handles[0];
    const contour = contours.find(({ handles }) => name !== undefined && handles.includes(name));
    if (contour === undefined) {
      this.close();
    } else if (this.#asking === null) {
      this.showContour(contour, keeps);
    }
  }

  close(): void {
    this.#open = null;
    this.#ask(null);
    this.ghost(null);
    this.#card.hidden = true;
    this.#card.replaceChildren();
  }

  showFault(fault: Fault, { fault: index, why, repairs }: Card, contour: Contour | undefined, keeps: boolean): void {
    this.#open = null;
    this.#ask(null);
    this.ghost(repairs[0] ?? null);
    const buttons = repairs.map((repair, which) => {
      const button = made("button", which === 0 ? t("Fix: {0}", repair.title) : repair.title, which === 0 ? "primary" : "");
      button.addEventListener("pointerenter", () => {
        this.ghost(repair);
      });
      button.addEventListener("click", () => {
        this.host.hear({ type: "fix", fault: index, repair: which });
        this.close();
      });
      return button;
    });
    const explain = made("button", t("About {0}", fault.rule), "link");
    explain.addEventListener("click", () => {
      this.host.hear({ type: "explain", rule: fault.rule });
    });
    const heading = made("h2", fault.message, fault.severity);
    const links = [explain];
    if (contour !== undefined) {
      const lead = made("button", t("Contour {0}", contour.number), "link");
      lead.addEventListener("click", () => {
        this.showContour(contour, keeps);
      });
      links.push(lead);
    }
    this.#show(heading, made("p", why, "why"), ...buttons, ...links);
  }

  showContour(contour: Contour, keeps: boolean): void {
    // What is being typed stays where the same contour is shown again, since something else has changed.
    const field = this.#card.querySelector("input");
    const isSame = this.#open?.handles.join() === contour.handles.join();
    const typed = isSame && field !== null && field === document.activeElement ? field.value : null;
    this.#open = contour;
    this.#ask(null);
    this.ghost(null);
    const shape = contour.closed ? t("closed") : t("open");
    const heading = made("h2", t("Contour {0}", contour.number), "");
    const facts = made("p", `${shape} · ${t("contour {0} mm", contour.length.toFixed(1))} · ${contour.handles.slice(0, 4).join(", ")}${contour.handles.length > 4 ? " …" : ""}`, "why");
    if (!keeps) {
      this.#show(heading, facts);
      return;
    }
    const say = (said: Said): void => {
      this.host.hear({ type: "say", handles: contour.handles, said });
    };
    // An open contour has no inside: its sides are those of the direction in which it is drawn.
    const shapes: [Role, string][] = contour.closed ? [["opening", t("Opening")], ["punch", t("Punch")]] : [["left", t("Left")], ["right", t("Right")]];
    const roles: [Role, string][] = [...shapes, ["line", t("On the line")], ["ignore", t("Not cut")]];
    const sides = row(t("Side"), ...roles.map(([role, name]) => {
      const button = made("button", name, "");
      button.setAttribute("aria-pressed", String(contour.role === role));
      button.addEventListener("click", () => {
        say({ side: contour.said.side === role ? null : role });
      });
      return button;
    }));
    const point = (key: "thread" | "entry", name: string): HTMLElement => {
      const said = contour.said[key];
      const pick = made("button", said === undefined ? t("Pick…") : said.map((number) => Number(number.toFixed(3))).join(", "), "");
      pick.addEventListener("click", () => {
        this.#ask({ key, contour });
      });
      return row(name, pick, ...(said === undefined ? [] : [this.#clear(() => { say({ [key]: null }); })]));
    };
    const order = document.createElement("input");
    Object.assign(order, { type: "number", min: "1", step: "1", value: String(contour.said.order ?? ""), placeholder: String(contour.number) });
    order.setAttribute("aria-label", t("Order"));
    let kept = order.value;
    const keep = (): void => {
      if (order.value !== kept) {
        kept = order.value;
        const number = Math.round(Number(kept));
        say({ order: kept === "" || !(number > 0) ? null : number });
      }
    };
    order.addEventListener("change", keep);
    order.addEventListener("keydown", (pressed) => {
      if (pressed.key === "Enter") {
        keep();
      }
    });
    this.#show(heading, facts, sides, point("thread", t("Thread hole")), point("entry", t("Entry")), row(t("Order"), order));
    if (typed !== null) {
      order.value = typed;
      order.focus();
    }
  }

  #clear(act: () => void): HTMLButtonElement {
    const button = made("button", "×", "");
    button.title = t("Take it back");
    button.addEventListener("click", act);
    return button;
  }

  #ask(asking: Asking | null): void {
    this.#asking = asking;
    this.asked(asking);
  }

  #show(...parts: HTMLElement[]): void {
    const close = made("button", "×", "close");
    close.title = t("Close (Esc)");
    close.addEventListener("click", () => {
      this.close();
    });
    this.#card.replaceChildren(close, ...parts);
    this.#card.hidden = false;
    this.#card.classList.remove("aside");
    const own = this.#card.getBoundingClientRect();
    const covers = ({ left, right, top, bottom }: DOMRect): boolean =>
      left < own.right && right > own.left && top < own.bottom && bottom > own.top;
    const about = [...document.querySelectorAll("svg :is(.mark, .fault).selected")];
    this.#card.classList.toggle("aside", about.some((part) => covers(part.getBoundingClientRect())));
  }
}

function made<K extends "button" | "h2" | "p" | "div" | "span">(name: K, text: string, className: string): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  made.textContent = text;
  made.className = className;
  return made;
}

function row(name: string, ...parts: HTMLElement[]): HTMLElement {
  const line = made("div", "", "row");
  line.append(made("span", name, "name"), ...parts);
  return line;
}

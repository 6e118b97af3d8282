// The lists beside the picture: findings, radii and contours of a drawing, the text of a program; one is seen at a time.

import type { Contour, Fault } from "../../picture/messages";
import type { Contours, Inspection } from "../../picture/protocol";
import { t } from "../../picture/words";
import { complain } from "./ask";
import { button, make } from "./dom";
import { List } from "./list";
import { contourRows, findingRows, lineRows, radiusRows } from "./rows";

export type Tab = "findings" | "radii" | "contours" | "text";

export interface Listed {
  isDrawing: boolean;
  faults: readonly Fault[];
  contours: readonly Contour[];
  fresh: ReadonlySet<string>;
  lines: readonly string[];
}

interface Acts {
  fault: (index: number) => void;
  /** `opened`: it is gone near to. */
  segment: (handle: string, segment: number | null, opened: boolean) => void;
  contour: (handle: string) => void;
  line: (line: number) => void;
  /** The radii are asked for when they are looked at. */
  radii: () => Promise<{ inspection: Inspection; contours: Contours }>;
}

export class Right {
  readonly element: HTMLElement;
  readonly #findings: List;
  readonly #radii: List;
  readonly #contours: List;
  readonly #text: List;
  readonly #only = make("input", { type: "checkbox", id: "only-faults" });
  readonly #tabs = new Map<Tab, { tab: HTMLButtonElement; panel: HTMLElement }>();
  readonly #folded = new Set<string>();
  #tab: Tab = "findings";
  #listed: Listed = { isDrawing: true, faults: [], contours: [], fresh: new Set(), lines: [] };
  #radiiAreOld = true;

  constructor(private readonly acts: Acts) {
    this.#findings = new List(t("Findings"), ({ key }) => { this.#finding(key); }, t("Nothing found."));
    this.#radii = new List(t("Radii"), ({ key }, opened) => { this.#segment(key, opened); }, t("Every radius is ok."));
    this.#contours = new List(t("Contours"), ({ key }) => { acts.contour(key.slice("contour ".length)); }, t("There is nothing to cut."));
    this.#text = new List(t("Program"), ({ key }) => { acts.line(Number(key.slice("line ".length))); }, "");
    this.#only.addEventListener("change", () => {
      this.#radiiAreOld = true;
      this.#show();
    });
    const only = make("label", { class: "note" }, this.#only, t("only what is not ok"));
    const bar = make("div", { class: "tabs", role: "tablist", "aria-label": t("Lists") });
    const panels: [Tab, string, Node[]][] = [
      ["findings", t("Findings"), [this.#findings.element]],
      ["radii", t("Radii"), [only, this.#radii.element]],
      ["contours", t("Contours"), [this.#contours.element]],
      ["text", t("Program"), [this.#text.element]],
    ];
    this.element = make("aside", { id: "right", class: "pane", "aria-label": t("Lists") }, bar);
    for (const [name, title, content] of panels) {
      const tab = button(title, () => { this.turnTo(name); }, { role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}` });
      const panel = make("div", { class: "panel", role: "tabpanel", id: `panel-${name}`, "aria-labelledby": `tab-${name}` }, ...content);
      this.#tabs.set(name, { tab, panel });
      bar.append(tab);
      this.element.append(panel);
    }
    bar.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step !== undefined) {
        const there = this.#there();
        const next = there[(there.indexOf(this.#tab) + step + there.length) % there.length] ?? "findings";
        this.turnTo(next);
        this.#tabs.get(next)?.tab.focus();
      }
    });
    this.#show();
  }

  put(listed: Listed): void {
    const isOther = listed.isDrawing !== this.#listed.isDrawing;
    this.#listed = listed;
    this.#radiiAreOld = true;
    this.#findings.put(findingRows(listed.faults, listed.contours, listed.fresh, this.#folded));
    this.#contours.put(contourRows(listed.contours));
    this.#text.put(lineRows(listed.lines, listed.faults));
    if (isOther) {
      this.turnTo(listed.isDrawing ? "findings" : "text");
    }
    this.#show();
  }

  #there(): Tab[] {
    return this.#listed.isDrawing ? ["findings", "radii", "contours"] : ["findings", "text"];
  }

  /** By its name, or by its number from 0 among those that are there. */
  turnTo(tab: Tab | number): void {
    const there = this.#there();
    const wanted = typeof tab === "number" ? there[tab] : tab;
    if (wanted !== undefined && there.includes(wanted)) {
      this.#tab = wanted;
      this.#show();
    }
  }

  /** Goes to the next finding, or back. */
  step(by: number): void {
    this.turnTo("findings");
    this.#findings.step(by);
  }

  markFault(index: number): void {
    this.#findings.mark(`fault ${index}`);
  }

  markSegment(handle: string, segment: number | null): void {
    const fault = this.#listed.faults.findIndex((each) => each.handle === handle && each.segment === (segment ?? undefined));
    this.#findings.mark(fault < 0 ? null : `fault ${fault}`);
    this.#radii.mark(segment === null ? `entity ${handle}` : `segment ${handle} ${segment}`);
    const contour = this.#listed.contours.find(({ handles }) => handles.includes(handle));
    this.#contours.mark(contour === undefined ? null : `contour ${contour.handles[0] ?? ""}`);
  }

  markLine(line: number | null): void {
    this.#text.mark(line === null ? null : `line ${line}`);
  }

  #finding(key: string): void {
    if (!key.startsWith("rule ")) {
      this.acts.fault(Number(key.slice("fault ".length)));
      return;
    }
    const rule = key.slice("rule ".length);
    if (!this.#folded.delete(rule)) {
      this.#folded.add(rule);
    }
    const { faults, contours, fresh } = this.#listed;
    this.#findings.put(findingRows(faults, contours, fresh, this.#folded));
  }

  #segment(key: string, opened: boolean): void {
    const [kind, handle = "", segment] = key.split(" ");
    this.acts.segment(handle, kind === "entity" ? null : Number(segment), opened);
  }

  #show(): void {
    const there = this.#there();
    for (const [name, { tab, panel }] of this.#tabs) {
      const isShown = name === this.#tab;
      tab.hidden = !there.includes(name);
      tab.setAttribute("aria-selected", String(isShown));
      tab.tabIndex = isShown ? 0 : -1;
      panel.hidden = !isShown;
    }
    const count = this.#listed.faults.length;
    const { tab } = this.#tabs.get("findings") ?? {};
    if (tab !== undefined) {
      tab.textContent = count === 0 ? t("Findings") : `${t("Findings")} ${count}`;
    }
    if (this.#tab === "radii" && this.#radiiAreOld && this.#listed.isDrawing) {
      this.#radiiAreOld = false;
      this.acts.radii().then(({ inspection, contours }) => {
        this.#radii.put(radiusRows(inspection, contours, this.#only.checked, this.#listed.faults));
      }, complain);
    }
  }
}

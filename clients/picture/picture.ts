// The picture: what its host sends is shown, what is pointed at is told to it.

import { forgetColours } from "./canvas";
import { type Asking, Cards } from "./card";
import { Faults } from "./faults";
import { element, type Host } from "./host";
import { MADE, type Shown, type ToPage } from "./messages";
import type { Picked } from "./named";
import { Player } from "./player";
import type { Repair } from "./protocol";
import { Sheet } from "./sheet";
import { Stage } from "./stage";
import { t } from "./words";

/** What takes keys of its own. */
const CONTROLS = "button, select, input, textarea, summary, dialog, [role=listbox]";

type Marked = { handle: string; segment: number | null } | { line: number };

export class Picture {
  #uri = "";
  #shown: Shown | null = null;
  /** What is marked, so that it is marked in the next picture of the document, too. */
  #marked: Marked | null = null;
  readonly #stage = new Stage((picked, twice, event) => {
    this.#pick(picked, twice, event);
  });
  readonly #faults = new Faults((index) => {
    this.lookAt(index, true);
  });
  readonly #player: Player;
  readonly #cards: Cards;

  constructor(private readonly host: Host) {
    this.#player = new Player(host);
    const ghost = (repair: Repair | null): void => {
      this.#stage.sheet?.ghost(repair?.segments ?? null);
    };
    this.#cards = new Cards(host, ghost, (asking) => {
      this.#ask(asking);
    });
    this.#listen();
    host.hear({ type: "ready" });
  }

  receive(message: ToPage): void {
    const sheet = this.#stage.sheet;
    switch (message.type) {
      case "picture":
        this.#show(message);
        break;
      case "segment":
        this.#follow(this.#select(message.handle === null ? null : { handle: message.handle, segment: message.segment }));
        break;
      case "contour":
        if (message.handles.length > 0) {
          this.fit();
        }
        this.#follow(message.handles.flatMap((handle) => sheet?.ofSegment(handle, null) ?? []));
        break;
      case "line":
        this.#follow(this.#select({ line: message.line }));
        this.#player.toLine(message.line);
        break;
      case "trouble":
        this.#trouble(message.message);
        break;
      case "busy":
        element("busy", HTMLElement).hidden = !message.busy;
        break;
      case "card": {
        const fault = this.#shown?.faults[message.card.fault];
        if (fault !== undefined) {
          const contour = this.#shown?.contours.find(({ handles }) => fault.handle !== undefined && handles.includes(fault.handle));
          this.#cards.showFault(fault, message.card, contour, this.#shown?.keeps === true);
        }
        break;
      }
      case "play":
        this.#player.play();
        break;
      case "approach":
        this.#approachAll(message.handles, message.segment);
        break;
      case "look":
        this.lookAt(message.fault, true);
        break;
    }
  }

  /** Marks a segment, with null an entity, and goes near it. */
  approach(handle: string, segment: number | null): void {
    const sheet = this.#stage.sheet;
    if (sheet !== null) {
      this.#select({ handle, segment });
      this.#stage.approach(sheet.boxOf(sheet.ofSegment(handle, segment)));
    }
  }

  /** Marks a contour by an entity of it, and opens its card. */
  openContour(handle: string): void {
    this.#showCardOf(handle, null);
  }

  zoom(factor: number): void {
    this.#stage.zoom(factor);
  }

  fit(): void {
    this.#stage.fit();
  }

  /** Draws again in the colours of another theme. */
  recolour(): void {
    forgetColours();
    this.#stage.redraw();
  }

  #listen(): void {
    const acts: Record<string, () => void> = {
      in: () => { this.zoom(1.5); },
      out: () => { this.zoom(1 / 1.5); },
      fit: () => { this.fit(); },
      text: () => { this.host.hear({ type: "text" }); },
      export: () => { this.host.hear({ type: "export" }); },
      "fix-all": () => { this.host.hear({ type: "fixAll" }); },
    };
    for (const [id, act] of Object.entries(acts)) {
      element(id, HTMLElement).addEventListener("click", act);
    }
    const program = element("program", HTMLSelectElement);
    program.addEventListener("change", () => {
      const format = MADE.find((each) => each === program.value);
      // It is a menu: it says its name again.
      program.value = "";
      if (format !== undefined) {
        this.host.hear({ type: "program", format });
      }
    });
    document.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        this.#cards.close();
      }
      const inControl = event.target instanceof HTMLElement && event.target.closest(CONTROLS) !== null;
      if (event.key === " " && !inControl) {
        event.preventDefault();
        this.#player.toggle();
      }
    });
  }

  /** A click in the picture is the answer. */
  #ask(asking: Asking | null): void {
    const wasAsking = document.body.classList.contains("asking");
    document.body.classList.toggle("asking", asking !== null);
    const thread = t("Click where the wire is to be threaded. Esc: as it was.");
    const entry = t("Click the point of the contour where the cut is to begin. Esc: as it was.");
    if (asking !== null) {
      this.#trouble(asking.key === "thread" ? thread : entry, false);
    } else if (wasAsking) {
      this.#trouble("");
    }
  }

  #pick(picked: Picked | null, twice: boolean, event?: MouseEvent): void {
    const sheet = this.#stage.sheet;
    if (sheet !== null && this.#cards.asking !== null && event !== undefined) {
      this.#answer(sheet, event);
      return;
    }
    if (sheet === null || picked === null) {
      if (!twice) {
        this.#cards.close();
      }
      return;
    }
    if (picked.line !== undefined) {
      this.#select({ line: picked.line });
      this.host.hear({ type: "line", line: picked.line });
      if (twice) {
        this.#stage.approach(sheet.boxOf(sheet.ofLine(picked.line)));
      }
    } else if (picked.handle !== undefined) {
      this.#pickSegment(sheet, picked.handle, picked.segment ?? null, twice);
      this.#showCardOf(picked.handle, picked.segment ?? null);
    }
  }

  /** The point that a contour's thread hole or entry is asked for. */
  #answer(sheet: Sheet, event: MouseEvent): void {
    const asking = this.#cards.asking;
    const at = sheet.inDrawing(event.clientX, event.clientY);
    if (asking === null || at === null) {
      return;
    }
    const { key, contour } = asking;
    const round = (number: number): number => Number(number.toFixed(3));
    const point = key === "entry" ? sheet.nearest(contour.handles, at) : ([round(at[0]), round(at[1])] as [number, number]);
    if (point !== null) {
      this.host.hear({ type: "say", handles: contour.handles, said: { [key]: point } });
    }
    this.#cards.showContour(contour, true);
  }

  #pickSegment(sheet: Sheet, handle: string, segment: number | null, close: boolean): void {
    const elements = this.#select({ handle, segment });
    this.host.hear({ type: "segment", handle, segment });
    if (close) {
      this.#stage.approach(sheet.boxOf(elements));
    }
  }

  #approachAll(handles: readonly string[], segment: number | null): void {
    const sheet = this.#stage.sheet;
    const elements = handles.flatMap((handle) => sheet?.ofSegment(handle, segment) ?? []);
    sheet?.select(elements);
    this.#stage.approach(sheet?.boxOf(elements) ?? null);
  }

  /** For a segment its finding is shown, where it has one, else its contour. */
  #showCardOf(handle: string, segment: number | null): void {
    if (this.#shown?.isEditor !== true) {
      return;
    }
    const of = this.#shown.faults.findIndex((fault) => fault.handle === handle && fault.segment === segment && ["error", "warning"].includes(fault.severity));
    const contour = this.#shown.contours.find(({ handles }) => handles.includes(handle));
    if (of >= 0 && segment !== null) {
      this.host.hear({ type: "fault", fault: of });
    } else if (contour !== undefined) {
      this.#stage.sheet?.select(contour.handles.flatMap((each) => this.#stage.sheet?.ofSegment(each, null) ?? []));
      this.#cards.showContour(contour, this.#shown.keeps);
    } else {
      this.#cards.close();
    }
  }

  /** Looks at the finding with this index; `close` goes near it. */
  lookAt(index: number, close: boolean): void {
    const fault = this.#shown?.faults[index];
    if (fault === undefined) {
      return;
    }
    const sheet = this.#stage.sheet;
    if (fault.handle === undefined) {
      this.#pick({ line: fault.line ?? 0 }, close);
    } else if (sheet !== null) {
      this.#pickSegment(sheet, fault.handle, fault.segment ?? 0, close && fault.at === undefined);
      if (fault.at !== undefined) {
        const place = sheet.about(fault.at, fault.reach ?? 0);
        sheet.select(sheet.markAt(place));
        this.#stage.approach(place);
      }
    }
    if (this.#shown?.isEditor === true) {
      this.host.hear({ type: "fault", fault: index });
    }
  }

  #show(message: Shown): void {
    const same = message.uri === this.#uri || (message.madeOf !== undefined && message.madeOf === this.#uri);
    const sheet = new Sheet(message.svg, message.pieces);
    const broken = message.faults.find(({ rule, severity }) => rule === "syntax" && severity === "error");
    const before = this.#shown;
    this.#uri = message.uri;
    this.host.shows?.(message.uri);
    this.#faults.put(message.faults, message.contours);
    element("program", HTMLSelectElement).hidden = message.makes !== true || message.kind !== "drawing";
    element("fix-all", HTMLElement).hidden = message.makes !== true || message.faults.length === 0;
    // The last good picture stays while the text is broken.
    if (same && (this.#stage.sheet?.drawing ?? null) !== null && (sheet.drawing === null || broken !== undefined)) {
      this.#trouble(broken?.message ?? sheet.reason);
      this.#shown = before === null ? message : { ...before, faults: message.faults };
      return;
    }
    this.#shown = message;
    document.body.dataset["kind"] = message.kind;
    element("text", HTMLElement).hidden = !message.isEditor;
    this.#stage.put(sheet, same);
    this.#player.put(sheet, message.blocks, message.lines, same);
    const { title, note, alert, severity } = sheet.heading();
    element("title", HTMLElement).textContent = title;
    const [notes, place] = [element("note", HTMLElement), element("alert", HTMLElement)];
    notes.textContent = notes.title = note;
    place.textContent = place.title = alert;
    place.className = severity;
    if (sheet.drawing === null) {
      this.#trouble(broken?.message ?? sheet.reason, false);
    } else if (this.#cards.asking === null) {
      this.#trouble("");
    }
    this.#select(same ? this.#marked : null);
    this.#cards.refresh(same ? message.contours : [], message.keeps);
    if (this.#cards.open !== null) {
      sheet.select(this.#cards.open.handles.flatMap((each) => sheet.ofSegment(each, null)));
    }
  }

  #select(marked: Marked | null): SVGElement[] {
    const sheet = this.#stage.sheet;
    this.#marked = marked;
    const line = marked !== null && "line" in marked ? marked.line : null;
    const elements = line !== null ? sheet?.ofLine(line) : marked !== null && "handle" in marked ? sheet?.ofSegment(marked.handle, marked.segment) : [];
    sheet?.select(elements ?? []);
    return elements ?? [];
  }

  #trouble(message: string, stale = true): void {
    const place = element("trouble", HTMLElement);
    place.hidden = message === "";
    place.textContent = message;
    document.body.classList.toggle("stale", message !== "" && stale);
  }

  #follow(elements: SVGElement[]): void {
    const sheet = this.#stage.sheet;
    if (sheet !== null) {
      sheet.select(elements);
      this.#stage.bring(sheet.boxOf(elements));
    }
  }
}

// The window through which the sheet is seen: pan by dragging, zoom by the wheel, the keys and the buttons.

import { type Box, centred, fitted, moved, roundLength, sees, unitsPerPixel, zoomed } from "./frame";
import { boxOfItems } from "./canvas";
import type { Picked } from "./named";
import { pickedFrom, type Sheet } from "./sheet";
import { element } from "./host";

/** Pixels about a thin line that count as upon it. */
const REACH = 6;
/** A pointer that has moved less has clicked. */
const CLICK = 4;
/** Pixels about what is drawn. */
const MARGIN = { width: 24, height: 28 };
/** Marks keep their size while the drawing grows into the room that they leave: a few rounds settle that. */
const LOOKS = 4;
/** A part that is zoomed to fills this share of the window. */
const SHARE = 0.22;

export class Stage {
  readonly #stage = element("stage", HTMLElement);
  #sheet: Sheet | null = null;
  #view: Box = { x: 0, y: 0, width: 1, height: 1 };
  #all: Box = this.#view;
  /** The user has not moved the view: it follows the drawing. */
  #isFitted = true;

  constructor(private readonly picked: (picked: Picked | null, twice: boolean, event: MouseEvent) => void) {
    new ResizeObserver(() => {
      this.#resized();
    }).observe(this.#stage);
    this.#listen();
  }

  get sheet(): Sheet | null {
    return this.#sheet;
  }

  /** Another picture; of the same document the view stays as it is. */
  put(sheet: Sheet, sameDocument: boolean): void {
    this.#sheet?.svg.remove();
    this.#sheet?.canvas?.element.remove();
    this.#sheet = sheet;
    this.#stage.prepend(...(sheet.canvas === null ? [] : [sheet.canvas.element]), sheet.svg);
    sheet.svg.setAttribute("preserveAspectRatio", "xMidYMid meet");
    this.#all = this.#everything(sheet);
    if (!sameDocument || this.#isFitted) {
      this.fit();
    } else {
      this.#show(this.#view);
    }
  }

  fit(): void {
    if (this.#sheet !== null) {
      this.#all = this.#everything(this.#sheet);
      this.#isFitted = true;
      this.#show(this.#all);
    }
  }

  #everything(sheet: Sheet): Box {
    const size = this.#size();
    let view = fitted(sheet.extent(0), size, MARGIN);
    for (let look = 0; look < LOOKS; look += 1) {
      view = fitted(sheet.extent(unitsPerPixel(view, size)), size, MARGIN);
    }
    return view;
  }

  redraw(): void {
    this.#show(this.#view);
  }

  zoom(factor: number): void {
    const { x, y, width, height } = this.#view;
    this.#zoomAt(factor, x + width / 2, y + height / 2);
  }

  /** Brings a part into view where it is not; the scale stays. Of the whole drawing every part is in view. */
  bring(box: Box | null): void {
    if (box !== null && !this.#isFitted && !sees(this.#view, box)) {
      this.#show(centred(this.#view, box.x + box.width / 2, box.y + box.height / 2));
    }
  }

  /** Zooms in on a part so far that it can be judged. */
  approach(box: Box | null): void {
    if (box === null) {
      return;
    }
    const size = this.#size();
    const scale = Math.max(unitsPerPixel(box, size) / SHARE, this.#all.width * 1e-5 / Math.max(size.width, 1));
    const [width, height] = [size.width * scale, size.height * scale];
    this.#isFitted = false;
    this.#show(centred({ x: 0, y: 0, width, height }, box.x + box.width / 2, box.y + box.height / 2));
  }

  #size(): { width: number; height: number } {
    return { width: this.#stage.clientWidth, height: this.#stage.clientHeight };
  }

  #resized(): void {
    if (this.#isFitted) {
      this.fit();
    } else {
      const size = this.#size();
      const scale = unitsPerPixel(this.#view, size);
      const middle = { x: this.#view.x + this.#view.width / 2, y: this.#view.y + this.#view.height / 2 };
      this.#show(centred({ x: 0, y: 0, width: size.width * scale, height: size.height * scale }, middle.x, middle.y));
    }
  }

  #show(view: Box): void {
    this.#view = view;
    const svg = this.#sheet?.svg;
    if (svg === undefined) {
      return;
    }
    this.#sheet?.canvas?.show(view, this.#size());
    svg.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${view.height}`);
    const scale = unitsPerPixel(view, this.#size());
    // Marks keep their size on the screen.
    svg.style.setProperty("--pixel", String(scale));
    svg.classList.toggle("close", view.width < this.#all.width / 4);
    this.#showScale(scale);
  }

  #showScale(scale: number): void {
    const perMm = (this.#sheet?.unitsPerMm ?? 0) / scale;
    const length = perMm > 0 ? roundLength(120 / perMm) : 0;
    element("scale", HTMLElement).hidden = length === 0;
    element("scale-bar", HTMLElement).style.width = `${length * perMm}px`;
    element("scale-text", HTMLElement).textContent = length >= 0.001 ? `${Number(length.toPrecision(1))} mm` : `${Number((length * 1000).toPrecision(1))} µm`;
  }

  #zoomAt(factor: number, x: number, y: number): void {
    this.#isFitted = false;
    this.#show(zoomed(this.#view, factor, x, y, this.#all));
  }

  #onSheet(event: MouseEvent): DOMPoint {
    const matrix = this.#sheet?.svg.getScreenCTM();
    const point = new DOMPoint(event.clientX, event.clientY);
    return matrix === null || matrix === undefined ? point : point.matrixTransform(matrix.inverse());
  }

  /** What lies under the pointer, or near it. */
  #under(event: MouseEvent): Picked | null {
    const canvas = this.#sheet?.canvas ?? null;
    if (canvas !== null) {
      const { x, y } = this.#onSheet(event);
      const pixel = unitsPerPixel(this.#view, this.#size());
      const cluster = canvas.clusterAt(x, y, pixel);
      if (cluster !== null && cluster.items.length > 1) {
        this.approach(boxOfItems(cluster.items));
        return null;
      }
      return cluster?.items[0]?.piece ?? canvas.at(x, y, REACH * pixel);
    }
    const ring = [0, 1, 2, 3, 4, 5, 6, 7].map((step) => (step * Math.PI) / 4);
    const about = [REACH / 2, REACH].flatMap((far) => ring.map((angle) => [Math.cos(angle) * far, Math.sin(angle) * far] as const));
    for (const [dx, dy] of [[0, 0] as const, ...about]) {
      const picked = pickedFrom(document.elementFromPoint(event.clientX + dx, event.clientY + dy));
      if (picked !== null) {
        return picked;
      }
    }
    return null;
  }

  #listen(): void {
    const stage = this.#stage;
    let from: { x: number; y: number; moved: boolean } | null = null;
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      const { x, y } = this.#onSheet(event);
      const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * 16 : event.deltaY;
      this.#zoomAt(Math.exp(-pixels / 400), x, y);
    }, { passive: false });
    stage.addEventListener("pointerdown", (event) => {
      if (event.button === 0 || event.button === 1) {
        from = { x: event.clientX, y: event.clientY, moved: false };
        stage.setPointerCapture(event.pointerId);
      }
    });
    stage.addEventListener("pointermove", (event) => {
      this.#showPlace(event);
      if (from === null) {
        return;
      }
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      if (from.moved || Math.hypot(dx, dy) > CLICK) {
        const scale = unitsPerPixel(this.#view, this.#size());
        this.#isFitted = false;
        this.#show(moved(this.#view, -dx * scale, -dy * scale));
        from = { x: event.clientX, y: event.clientY, moved: true };
        stage.classList.add("dragging");
      }
    });
    stage.addEventListener("pointerup", (event) => {
      if (from !== null && !from.moved && event.button === 0) {
        this.picked(this.#under(event), event.detail > 1, event);
      }
      from = null;
      stage.classList.remove("dragging");
    });
    stage.addEventListener("pointercancel", () => {
      from = null;
      stage.classList.remove("dragging");
    });
    stage.addEventListener("dblclick", (event) => {
      this.picked(this.#under(event), true, event);
    });
    stage.addEventListener("pointerleave", () => {
      element("place", HTMLElement).textContent = "";
    });
    stage.addEventListener("keydown", (event) => {
      this.#key(event);
    });
  }

  #showPlace(event: MouseEvent): void {
    const place = this.#sheet?.inMm(event.clientX, event.clientY);
    element("place", HTMLElement).textContent = place ? `x ${place.x.toFixed(3)}   y ${place.y.toFixed(3)} mm` : "";
  }

  #key(event: KeyboardEvent): void {
    const step = 0.1;
    const acts: Record<string, () => void> = {
      "+": () => { this.zoom(1.5); },
      "=": () => { this.zoom(1.5); },
      "-": () => { this.zoom(1 / 1.5); },
      "0": () => { this.fit(); },
      ArrowLeft: () => { this.#pan(-step, 0); },
      ArrowRight: () => { this.#pan(step, 0); },
      ArrowUp: () => { this.#pan(0, -step); },
      ArrowDown: () => { this.#pan(0, step); },
    };
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : acts[event.key];
    if (act !== undefined) {
      event.preventDefault();
      act();
    }
  }

  #pan(across: number, down: number): void {
    this.#isFitted = false;
    this.#show(moved(this.#view, this.#view.width * across, this.#view.height * down));
  }
}

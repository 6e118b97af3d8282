// Takes the server's SVG into the page, and knows which of its elements stand for which segment or line.

import type { Piece, SegmentShape } from "./protocol";
import { Canvas } from "./canvas";
import type { Box } from "./frame";
import { Named, namesOf, type Picked } from "./named";
import { dataOf, lengthOf, taken } from "./pieces";

/** A piece of the wire's way. */
export interface Way {
  length: number;
  /** The wire does not cut there. */
  isJump: boolean;
  /** In a program. */
  line: number | undefined;
  data: () => string;
  /** What shows it, where it is an element. */
  element?: SVGPathElement;
}

export class Sheet {
  readonly svg: SVGSVGElement;
  readonly drawing: SVGGElement | null;
  readonly #named = new Named<SVGElement>();
  /** Draws what is too large for the page's own tree. */
  readonly canvas: Canvas | null;
  #selected: SVGElement[] = [];
  #ghost: SVGPathElement | null = null;

  /** Throws when the text is no SVG. What the server has sent in pieces is drawn on a canvas below it. */
  constructor(text: string, pieces?: readonly Piece[]) {
    // The page has its own colours, those of the theme. A policy that allows no style complains of the server's, so it goes first.
    const parsed = new DOMParser().parseFromString(text.replace(/<style>[^<]*<\/style>/, ""), "image/svg+xml");
    const root = parsed.documentElement;
    if (!(root instanceof SVGSVGElement)) {
      throw new Error("the server's picture is no SVG");
    }
    // Nothing runs that came with a drawing.
    for (const foreign of root.querySelectorAll("style, script, foreignObject")) {
      foreign.remove();
    }
    this.svg = document.adoptNode(root);
    this.svg.removeAttribute("width");
    this.svg.removeAttribute("height");
    this.drawing = this.svg.querySelector<SVGGElement>("g.drawing");
    const place = this.drawing?.transform.baseVal.consolidate()?.matrix;
    const many = pieces ?? (this.drawing === null ? null : taken(this.drawing));
    this.canvas = many === null || place === undefined ? null : new Canvas(many, place.e, place.f);
    if (this.canvas === null) {
      this.#index();
    } else {
      // The canvas has marks of its own, with counts.
      for (const mark of this.svg.querySelectorAll(".mark, .lens")) {
        mark.remove();
      }
    }
  }

  #index(): void {
    for (const element of this.svg.querySelectorAll<SVGElement>("[data-handle], [data-line]")) {
      this.#named.add(namesOf(element), element);
    }
    // The style gives these a scale of their own, which would take the place of the attribute.
    for (const symbol of this.svg.querySelectorAll<SVGElement>(":is(.dot, .thread, .arrow)[transform]")) {
      const holder = document.createElementNS(this.svg.namespaceURI ?? "", "g");
      holder.setAttribute("transform", symbol.getAttribute("transform") ?? "");
      symbol.removeAttribute("transform");
      symbol.replaceWith(holder);
      holder.append(symbol);
    }
    for (const mark of this.svg.querySelectorAll<SVGElement>("[data-at]")) {
      const [x, y] = (mark.dataset["at"] ?? "").split(" ").map(Number);
      mark.style.transformOrigin = `${x ?? 0}px ${y ?? 0}px`;
    }
  }

  /** The length that is cut, mm, by the server; 0 where there is no path of the wire. */
  get cut(): number {
    return Number(this.drawing?.dataset["cut"] ?? 0);
  }

  /** What is written about the picture, for the page's own head. */
  heading(): { title: string; note: string; alert: string; severity: string } {
    const text = (selector: string): string => this.svg.querySelector(`.chrome ${selector}`)?.textContent ?? "";
    const alert = this.svg.querySelector(".chrome .alert");
    return {
      title: text(".heading") || (this.svg.querySelector("title")?.textContent ?? ""),
      note: text(".note"),
      // The full text, which the sheet may have had to shorten.
      alert: alert?.querySelector("title")?.textContent ?? "",
      severity: [...(alert?.classList ?? [])].find((name) => name !== "alert") ?? "",
    };
  }

  /** Why there is nothing to draw, on a sheet without a drawing. */
  get reason(): string {
    return this.svg.querySelector("text.note")?.textContent ?? "";
  }

  /** Draws what a repair would bring; null takes it away. */
  ghost(segments: readonly SegmentShape[] | null): SVGPathElement | null {
    this.#ghost?.remove();
    this.#ghost = null;
    if (segments === null || segments.length === 0 || this.drawing === null) {
      return null;
    }
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    path.classList.add("ghost");
    // The neighbours of an arc that is replaced merely become shorter: they are not shown.
    const arcs = segments.filter(({ radius }) => radius !== undefined);
    path.setAttribute("d", (arcs.length > 0 ? arcs : segments).map((segment) => this.#dataOf(segment)).join(""));
    this.drawing.append(path);
    this.#ghost = path;
    return path;
  }

  #dataOf({ start, end, center, radius, sweep = 0 }: SegmentShape): string {
    const scale = Number(this.drawing?.dataset["scale"] ?? 1);
    const local = ([x, y]: readonly [number, number]): string => {
      const [originX, originY] = (this.drawing?.dataset["origin"] ?? "0 0").split(" ").map(Number);
      return `${(x - (originX ?? 0)) * scale} ${(y - (originY ?? 0)) * scale}`;
    };
    if (radius === undefined || center === undefined) {
      return `M${local(start)}L${local(end)}`;
    }
    // In halves, so that a full turn is drawn, too.
    const begin = Math.atan2(start[1] - center[1], start[0] - center[0]);
    const half = begin + (sweep * Math.PI) / 360;
    const middle = [center[0] + radius * Math.cos(half), center[1] + radius * Math.sin(half)] as const;
    const arc = `A${radius * scale} ${radius * scale} 0 0 ${sweep > 0 ? 1 : 0} `;
    return `M${local(start)}${arc}${local(middle)}${arc}${local(end)}`;
  }

  /** A point of the window in units of the drawing. */
  inDrawing(x: number, y: number): [number, number] | null {
    const place = this.inMm(x, y);
    const toMm = Number(this.drawing?.dataset["unitMm"] ?? 1);
    return place === null ? null : [place.x / toMm, place.y / toMm];
  }

  /** The point of a contour that lies nearest to a point of the drawing. */
  nearest(handles: readonly string[], [x, y]: readonly [number, number]): [number, number] | null {
    const scale = Number(this.drawing?.dataset["scale"] ?? 1);
    const [originX, originY] = (this.drawing?.dataset["origin"] ?? "0 0").split(" ").map(Number);
    const wanted = { x: (x - (originX ?? 0)) * scale, y: (y - (originY ?? 0)) * scale };
    const isContour = (element: SVGElement): element is SVGPathElement =>
      element instanceof SVGPathElement && element.classList.contains("contour");
    const paths = handles.flatMap((handle) => this.ofSegment(handle, null)).filter(isContour);
    let best: { x: number; y: number; far: number } | null = null;
    for (const path of paths) {
      const total = path.getTotalLength();
      const far = (along: number): number => {
        const point = path.getPointAtLength(along);
        return Math.hypot(point.x - wanted.x, point.y - wanted.y);
      };
      const steps = 64;
      const step = total / steps;
      let along = Array.from({ length: steps + 1 }, (_, index) => index * step).reduce((a, b) => (far(b) < far(a) ? b : a));
      for (let width = step; width > 1e-6; width /= 2) {
        const beside = [along - width, along + width].map((each) => Math.min(Math.max(each, 0), total));
        along = beside.reduce((a, b) => (far(b) < far(a) ? b : a), along);
      }
      const point = path.getPointAtLength(along);
      if (best === null || far(along) < best.far) {
        best = { x: point.x, y: point.y, far: far(along) };
      }
    }
    return best === null ? null : [(originX ?? 0) + best.x / scale, (originY ?? 0) + best.y / scale];
  }

  /** The box about a point of the drawing that reaches this many mm to each side. */
  about([x, y]: readonly [number, number], mm: number): Box {
    const scale = Number(this.drawing?.dataset["scale"] ?? 1);
    const [originX, originY] = (this.drawing?.dataset["origin"] ?? "0 0").split(" ").map(Number);
    const at = new DOMPoint((x - (originX ?? 0)) * scale, (y - (originY ?? 0)) * scale);
    const [matrix, own] = [this.drawing?.getCTM(), this.svg.getCTM()];
    const middle = matrix && own ? at.matrixTransform(own.inverse().multiply(matrix)) : at;
    const reach = mm * this.unitsPerMm;
    return { x: middle.x - reach, y: middle.y - reach, width: 2 * reach, height: 2 * reach };
  }

  /** The mark whose place lies nearest to the middle of a box. */
  markAt({ x, y, width, height }: Box): SVGElement[] {
    const far = (mark: SVGElement): number => {
      const [atX, atY] = (mark.dataset["at"] ?? "").split(" ").map(Number);
      return Math.hypot((atX ?? 0) - x - width / 2, (atY ?? 0) - y - height / 2);
    };
    const marks = [...this.svg.querySelectorAll<SVGElement>(".mark[data-at]")];
    return marks.sort((a, b) => far(a) - far(b)).slice(0, 1);
  }

  /** The box of all that is drawn, in units of the sheet; with the marks as large as they are where a pixel is `pixel` units. */
  extent(pixel: number): Box {
    if (this.canvas !== null) {
      return this.canvas.extent;
    }
    const box = this.drawing?.getBBox();
    if (this.drawing === null || box === undefined || (box.width === 0 && box.height === 0)) {
      const { x, y, width, height } = this.svg.viewBox.baseVal;
      return { x, y, width, height };
    }
    return this.#marks().reduce((all, { at, own }) => {
      const [x, y] = [at.x + (own.x - at.x) * pixel, at.y + (own.y - at.y) * pixel];
      return joined(all, { x, y, width: own.width * pixel, height: own.height * pixel });
    }, this.#onSheet(this.drawing, box));
  }

  /** Each mark's point on the sheet, and its box where a pixel is one unit. */
  #marks(): { at: { x: number; y: number }; own: Box }[] {
    return [...this.svg.querySelectorAll<SVGGraphicsElement>(".mark[data-at]")].map((mark) => {
      const [x, y] = (mark.dataset["at"] ?? "").split(" ").map(Number);
      return { at: { x: x ?? 0, y: y ?? 0 }, own: mark.getBBox() };
    });
  }

  /** Every element that stands for the segment; with null, for the entity. */
  ofSegment(handle: string, segment: number | null): SVGElement[] {
    return this.canvas?.ofSegment(handle, segment) ?? [...this.#named.ofSegment(handle, segment)];
  }

  ofLine(line: number): SVGElement[] {
    return this.canvas?.ofLine(line) ?? [...this.#named.ofLine(line)];
  }

  select(elements: SVGElement[]): void {
    for (const element of this.#selected) {
      element.classList.remove("selected");
      if (this.canvas !== null && element.parentNode === this.drawing) {
        element.remove();
      }
    }
    this.#selected = elements;
    for (const element of elements) {
      element.classList.add("selected");
      // What the canvas draws is lent to the tree for as long as it is selected.
      if (this.canvas !== null && !element.isConnected) {
        this.drawing?.append(element);
      }
    }
  }

  /** The box of the parts of the drawing among these. */
  boxOf(elements: readonly SVGElement[]): Box | null {
    if (this.canvas !== null) {
      return this.canvas.boxOf(elements);
    }
    const parts = elements.filter((element): element is SVGGraphicsElement => element instanceof SVGGraphicsElement);
    const drawn = parts.filter((element) => this.drawing?.contains(element) === true && !element.classList.contains("fine"));
    const boxes = drawn.map((element) => this.#onSheet(element, element.getBBox()));
    return boxes.reduce<Box | null>((all, box) => (all === null ? box : joined(all, box)), null);
  }

  #onSheet(element: SVGGraphicsElement, box: DOMRect): Box {
    const matrix = element.getCTM();
    const own = this.svg.getCTM();
    if (matrix === null || own === null) {
      return box;
    }
    const toSheet = own.inverse().multiply(matrix);
    const corners = [
      [box.x, box.y],
      [box.x + box.width, box.y + box.height],
    ].map(([x, y]) => new DOMPoint(x, y).matrixTransform(toSheet));
    const [a, b] = [corners[0] ?? new DOMPoint(), corners[1] ?? new DOMPoint()];
    return { x: Math.min(a.x, b.x), y: Math.min(a.y, b.y), width: Math.abs(a.x - b.x), height: Math.abs(a.y - b.y) };
  }

  /** A point of the window in mm of the drawing. */
  inMm(x: number, y: number): { x: number; y: number } | null {
    const matrix = this.drawing?.getScreenCTM();
    const { origin, scale, unitMm } = this.drawing?.dataset ?? {};
    if (matrix === null || matrix === undefined || origin === undefined) {
      return null;
    }
    const local = new DOMPoint(x, y).matrixTransform(matrix.inverse());
    const [originX, originY] = origin.split(" ").map(Number);
    const toMm = Number(unitMm ?? 1);
    return { x: ((originX ?? 0) + local.x / Number(scale)) * toMm, y: ((originY ?? 0) + local.y / Number(scale)) * toMm };
  }

  /** Units of the sheet in 1 mm; 0 where that is not known. */
  get unitsPerMm(): number {
    const { scale, unitMm } = this.drawing?.dataset ?? {};
    return scale === undefined ? 0 : Number(scale) / Number(unitMm ?? 1);
  }

  /** The wire's way, in the order in which it is travelled. */
  wire(): Way[] {
    if (this.canvas !== null) {
      return this.canvas.wire().map(({ at, line, class: kind }) => ({ length: lengthOf(at), isJump: kind.startsWith("jump"), line, data: () => dataOf(at) }));
    }
    const blocks = [...this.svg.querySelectorAll<SVGPathElement>("g.drawing path[data-line]")];
    const way = blocks.length > 0 ? blocks : [...this.svg.querySelectorAll<SVGPathElement>("g.drawing :is(path.wire, path.lead, path.jump)")];
    return way.map((element) => ({
      length: element.getTotalLength(),
      isJump: element.classList.contains("jump"),
      line: element.dataset["line"] === undefined ? undefined : Number(element.dataset["line"]),
      data: () => element.getAttribute("d") ?? "",
      element,
    }));
  }
}

/** What an element, or one that holds it, stands for. */
export function pickedFrom(element: Element | null): Picked | null {
  const named = element?.closest<SVGElement>("[data-handle], [data-line]");
  return named === null || named === undefined ? null : namesOf(named);
}

function joined(a: Box, b: Box): Box {
  const [x, y] = [Math.min(a.x, b.x), Math.min(a.y, b.y)];
  return { x, y, width: Math.max(a.x + a.width, b.x + b.width) - x, height: Math.max(a.y + a.height, b.y + b.height) - y };
}

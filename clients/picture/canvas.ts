// A drawing of many contours on a canvas: elements are batched by tile, and findings that lie close together become one mark with a count.

import type { Box, Size } from "./frame";

/** From this many elements on the page draws on the canvas instead of holding each in its tree. */
export const MANY = 2_000;
/** The number of tiles along each side of the drawing. */
const TILES = 32;
/** A frame may take this long, ms: while somebody moves a drawing that takes longer, its last picture is moved. */
const FRAME = 12;
/** After this long without movement the drawing is drawn sharp, ms. */
const REST = 90;
/** Findings nearer than this on the screen are one mark, pixels. */
const NEAR = 26;
const SEVERITIES = ["error", "warning", "remark", "hint"] as const;

interface Item {
  element: SVGGraphicsElement;
  /** The width of a line that is drawn to scale, in units of the sheet; else 0. */
  width: number;
  path: Path2D;
  box: Box;
  kind: string;
}

interface Batch {
  kind: string;
  width: number;
  path: Path2D;
  box: Box;
}

export interface Cluster {
  x: number;
  y: number;
  count: number;
  /** Index into [`SEVERITIES`]. */
  worst: number;
  items: Item[];
}

/** The order of drawing, from the bottom up. */
const ORDER = ["part", "lost", "void", "kerf", "aside", "contour", "jump", "wire", "lead", "hint", "remark", "warning", "error"] as const;

export class Canvas {
  readonly #canvas = document.createElement("canvas");
  readonly #last = document.createElement("canvas");
  #items: Item[] = [];
  #grid = new Map<number, Item[]>();
  #batches: Batch[] = [];
  #threads: { x: number; y: number; order: string }[] = [];
  #matrix = new DOMMatrix();
  #extent: Box = { x: 0, y: 0, width: 1, height: 1 };
  #lastView: Box | null = null;
  #clusters: Cluster[] = [];
  #cost = 0;
  #timer = 0;
  #isAwaited = false;
  #view: Box = this.#extent;
  #size: Size = { width: 1, height: 1 };

  get element(): HTMLCanvasElement {
    return this.#canvas;
  }

  /** Takes the elements of a drawing out of the tree. False where they are few. */
  take(drawing: SVGGElement): boolean {
    const elements = [...drawing.querySelectorAll<SVGGraphicsElement>(":scope > path, :scope > rect, :scope > circle, :scope > g.thread, :scope > g.turned, :scope > text")];
    this.#items = [];
    this.#threads = [];
    this.#lastView = null;
    if (elements.length < MANY) {
      return false;
    }
    const { a, b, c, d, e, f } = drawing.transform.baseVal.consolidate()?.matrix ?? new DOMMatrix();
    this.#matrix = new DOMMatrix([a, b, c, d, e, f]);
    for (const element of elements) {
      this.#takeOne(element);
    }
    // All at once: some browsers take the longer for each one the more of them there are.
    const taken = new Set<Node>(elements);
    drawing.replaceChildren(...[...drawing.childNodes].filter((node) => !taken.has(node)));
    this.#arrange();
    return true;
  }

  #takeOne(element: SVGGraphicsElement): void {
    const at = (x: number, y: number): { x: number; y: number } => new DOMPoint(x, y).matrixTransform(this.#matrix);
    const attribute = (name: string): number => Number(element.getAttribute(name));
    const kind = ORDER.findLast((kind) => element.classList.contains(kind));
    if (element.classList.contains("thread")) {
      const circle = element.querySelector("circle");
      const own = /translate\(([-\d.]+)[ ,]([-\d.]+)\)/.exec(element.getAttribute("transform") ?? "");
      const local = own === null ? [Number(circle?.getAttribute("cx")), Number(circle?.getAttribute("cy"))] : [Number(own[1]), Number(own[2])];
      this.#threads.push({ ...at(local[0] ?? 0, local[1] ?? 0), order: "" });
    } else if (element.classList.contains("turned")) {
      const thread = this.#threads.at(-1);
      const number = element.textContent;
      if (thread !== undefined && /^\d+$/.test(number)) {
        thread.order = number;
      }
    } else if (element.tagName === "circle" && kind !== undefined && !element.classList.contains("fine")) {
      const { x, y } = at(attribute("cx"), attribute("cy"));
      this.#items.push({ element, path: new Path2D(), box: { x, y, width: 0, height: 0 }, kind, width: 0 });
    } else if (element.tagName === "rect" && kind !== undefined) {
      const [left, low, width, height] = [attribute("x"), attribute("y"), attribute("width"), attribute("height")];
      const own = new Path2D();
      own.roundRect(left, low, width, height, attribute("rx"));
      const path = new Path2D();
      path.addPath(own, this.#matrix);
      const [from, to] = [at(left, low), at(left + width, low + height)];
      const box = { x: Math.min(from.x, to.x), y: Math.min(from.y, to.y), width: Math.abs(from.x - to.x), height: Math.abs(from.y - to.y) };
      this.#items.push({ element, path, box, kind, width: 0 });
    } else if (element.tagName === "path" && kind !== undefined && !element.classList.contains("back")) {
      const data = element.getAttribute("d") ?? "";
      const path = new Path2D();
      path.addPath(new Path2D(data), this.#matrix);
      const box = boxOf(data);
      const [from, to] = [at(box.x, box.y), at(box.x + box.width, box.y + box.height)];
      const [x, y] = [Math.min(from.x, to.x), Math.min(from.y, to.y)];
      const width = kind === "kerf" ? Number(element.getAttribute("stroke-width")) : 0;
      this.#items.push({ element, path, box: { x, y, width: Math.abs(from.x - to.x), height: Math.abs(from.y - to.y) }, kind, width });
    }
  }

  #arrange(): void {
    const boxes = this.#items.map(({ box }) => box);
    // There may be more of them than a call takes arguments.
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { x, y, width, height } of boxes) {
      [left, top] = [Math.min(left, x), Math.min(top, y)];
      [right, bottom] = [Math.max(right, x + width), Math.max(bottom, y + height)];
    }
    this.#extent = { x: left, y: top, width: Math.max(right - left, 1e-9), height: Math.max(bottom - top, 1e-9) };
    this.#grid = new Map();
    this.#batches = [];
    for (const kind of ORDER) {
      const tiles = new Map<number, Batch>();
      for (const item of this.#items.filter((item) => item.kind === kind)) {
        const tile = this.#tileOf(item.box.x + item.box.width / 2, item.box.y + item.box.height / 2);
        const here = this.#grid.get(tile) ?? [];
        here.push(item);
        this.#grid.set(tile, here);
        const batch = tiles.get(tile) ?? { kind, width: item.width, path: new Path2D(), box: item.box };
        batch.path.addPath(item.path);
        batch.box = joined(batch.box, item.box);
        tiles.set(tile, batch);
      }
      for (const batch of tiles.values()) {
        this.#batches.push(batch);
      }
    }
  }

  #tileOf(x: number, y: number): number {
    const at = (share: number): number => Math.min(Math.max(Math.floor(share * TILES), 0), TILES - 1);
    return at((y - this.#extent.y) / this.#extent.height) * TILES + at((x - this.#extent.x) / this.#extent.width);
  }

  get extent(): Box {
    return this.#extent;
  }

  /** Shows a part of the sheet, in the next frame. */
  show(view: Box, size: Size): void {
    this.#view = view;
    this.#size = size;
    if (!this.#isAwaited) {
      this.#isAwaited = true;
      requestAnimationFrame(() => {
        this.#isAwaited = false;
        this.#draw();
      });
    }
  }

  #draw(): void {
    clearTimeout(this.#timer);
    if (this.#cost <= FRAME || this.#lastView === null) {
      this.#sharp();
      return;
    }
    this.#move();
    this.#timer = window.setTimeout(() => {
      this.#sharp();
    }, REST);
  }

  /** The last picture, moved and scaled to where it would lie. */
  #move(): void {
    const [last, view] = [this.#lastView, this.#view];
    const context = this.#canvas.getContext("2d");
    if (last === null || context === null) {
      return;
    }
    const scale = this.#canvas.width / view.width;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colour("--ground");
    context.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.drawImage(this.#last, (last.x - view.x) * scale, (last.y - view.y) * scale, last.width * scale, last.height * scale);
  }

  #sharp(): void {
    const began = performance.now();
    const dense = window.devicePixelRatio || 1;
    const { width, height } = this.#size;
    const [across, down] = [Math.max(Math.round(width * dense), 1), Math.max(Math.round(height * dense), 1)];
    if (this.#canvas.width !== across || this.#canvas.height !== down) {
      Object.assign(this.#canvas, { width: across, height: down });
      Object.assign(this.#last, { width: across, height: down });
    }
    const context = this.#canvas.getContext("2d", { alpha: false });
    if (context === null) {
      return;
    }
    const view = this.#view;
    const scale = across / view.width;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colour("--ground");
    context.fillRect(0, 0, across, down);
    context.setTransform(scale, 0, 0, scale, -view.x * scale, -view.y * scale);
    context.lineCap = context.lineJoin = "round";
    const pixel = dense / scale;
    for (const { kind, path, box, width } of this.#batches) {
      if (meet(box, view)) {
        paint(context, kind, path, pixel, width);
      }
    }
    this.#drawThreads(context, pixel);
    this.#drawClusters(context, pixel);
    context.setTransform(1, 0, 0, 1, 0, 0);
    this.#last.getContext("2d")?.drawImage(this.#canvas, 0, 0);
    // Time that the browser still needs to paint counts too: reading a pixel waits for it.
    context.getImageData(0, 0, 1, 1);
    this.#lastView = view;
    this.#cost = performance.now() - began;
  }

  #drawThreads(context: CanvasRenderingContext2D, pixel: number): void {
    const seen = this.#threads.filter(({ x, y }) => holds(this.#view, x, y));
    if (seen.length > 400) {
      return;
    }
    context.strokeStyle = context.fillStyle = colour("--thread");
    context.lineWidth = 1.3 * pixel;
    context.font = `700 ${12 * pixel}px ${getComputedStyle(document.body).fontFamily}`;
    context.textAlign = "start";
    for (const { x, y, order } of seen) {
      context.beginPath();
      context.arc(x, y, 5 * pixel, 0, 2 * Math.PI);
      context.moveTo(x - 8 * pixel, y);
      context.lineTo(x + 8 * pixel, y);
      context.moveTo(x, y - 8 * pixel);
      context.lineTo(x, y + 8 * pixel);
      context.stroke();
      if (order !== "") {
        context.fillText(order, x + 9 * pixel, y - 7 * pixel);
      }
    }
  }

  #drawClusters(context: CanvasRenderingContext2D, pixel: number): void {
    const cells = new Map<string, Cluster>();
    for (const item of this.#items) {
      const worst = SEVERITIES.findIndex((severity) => severity === item.kind);
      const [x, y] = [item.box.x + item.box.width / 2, item.box.y + item.box.height / 2];
      if (worst < 0 || !holds(this.#view, x, y)) {
        continue;
      }
      const cell = `${Math.floor((x - this.#view.x) / pixel / NEAR)} ${Math.floor((y - this.#view.y) / pixel / NEAR)}`;
      const known = cells.get(cell) ?? { x, y, count: 0, worst, items: [] };
      known.items.push(item);
      known.worst = Math.min(known.worst, worst);
      known.x += (x - known.x) / known.items.length;
      known.y += (y - known.y) / known.items.length;
      known.count += 1;
      cells.set(cell, known);
    }
    this.#clusters = [...cells.values()];
    context.textAlign = "center";
    for (const { x, y, count, worst } of this.#clusters) {
      const radius = (count > 1 ? 9 + Math.min(String(count).length - 1, 3) * 2 : 5) * pixel;
      context.fillStyle = colour(`--${SEVERITIES[worst] ?? "hint"}`);
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fill();
      if (count > 1) {
        context.fillStyle = colour("--ground");
        context.font = `700 ${11 * pixel}px ${getComputedStyle(document.body).fontFamily}`;
        context.fillText(String(count), x, y + 4 * pixel);
      }
    }
  }

  /** The mark of findings at a place of the sheet. */
  clusterAt(x: number, y: number, pixel: number): Cluster | null {
    return this.#clusters.find((cluster) => Math.hypot(cluster.x - x, cluster.y - y) <= 14 * pixel) ?? null;
  }

  /** The element that is drawn nearest above a place of the sheet, within `reach`. */
  at(x: number, y: number, reach: number): SVGGraphicsElement | null {
    const context = this.#canvas.getContext("2d");
    if (context === null) {
      return null;
    }
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.lineWidth = 2 * reach;
    const [low, high] = [{ x: x - reach, y: y - reach }, { x: x + reach, y: y + reach }];
    const around: Box = { x: low.x, y: low.y, width: high.x - low.x, height: high.y - low.y };
    const named = this.#items.filter(({ element, box }) => meet(box, around) && (element.dataset["handle"] !== undefined || element.dataset["line"] !== undefined));
    const found = named.findLast(({ path }) => context.isPointInStroke(path, x, y));
    context.restore();
    return found?.element ?? null;
  }

  boxOf(elements: readonly Element[]): Box | null {
    const wanted = new Set(elements);
    const boxes = this.#items.filter(({ element }) => wanted.has(element)).map(({ box }) => box);
    return boxes.reduce<Box | null>((all, box) => (all === null ? box : joined(all, box)), null);
  }
}

function paint(context: CanvasRenderingContext2D, kind: string, path: Path2D, pixel: number, scaled: number): void {
  const fill = FILLS[kind];
  if (fill !== undefined) {
    context.fillStyle = colour(fill);
    context.fill(path);
    return;
  }
  const [name, width, dash]: [string, number, number[]] = STROKES[kind] ?? ["--ink", 1.5, []];
  context.strokeStyle = colour(name);
  context.lineWidth = scaled > 0 ? scaled : width * pixel;
  context.setLineDash(dash.map((length) => length * pixel));
  context.stroke(path);
  context.setLineDash([]);
}

const FILLS: Partial<Record<string, string>> = { part: "--material", lost: "--lost", void: "--ground" };

const STROKES: Record<string, [string, number, number[]]> = {
  kerf: ["--kerf", 1, []],
  contour: ["--ink", 1.5, []],
  aside: ["--faint", 1, []],
  wire: ["--wire", 1.5, []],
  lead: ["--wire", 1.2, [5, 4]],
  jump: ["--faint", 1, [1, 4]],
  error: ["--error", 3.5, []],
  warning: ["--warning", 3, []],
  remark: ["--remark", 3, []],
  hint: ["--hint", 1.6, []],
};

const colours = new Map<string, string>();

function colour(name: string): string {
  const known = colours.get(name);
  if (known !== undefined) {
    return known;
  }
  // The browser resolves the value of a variable.
  const probe = document.createElement("span");
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const found = getComputedStyle(probe).color;
  probe.remove();
  colours.set(name, found);
  return found;
}

/** Another theme has other colours. */
export function forgetColours(): void {
  colours.clear();
}

/** The box of path data as the server writes it: M, L, A and Z with absolute coordinates. */
export function boxOf(data: string): Box {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  let [lastX, lastY] = [0, 0];
  const include = (x: number, y: number, about: number): void => {
    left = Math.min(left, x - about);
    right = Math.max(right, x + about);
    top = Math.min(top, y - about);
    bottom = Math.max(bottom, y + about);
  };
  for (const [, letter, numbers] of data.matchAll(/([MLA])([^MLAZ]*)/g)) {
    const values = (numbers ?? "").trim().split(/[ ,]+/).map(Number);
    const [x, y] = values.slice(-2) as [number, number];
    // An arc of less than a half turn keeps within its chord of its ends.
    const about = letter === "A" ? Math.min(values[0] ?? 0, Math.hypot(x - lastX, y - lastY)) : 0;
    include(x, y, about);
    [lastX, lastY] = [x, y];
  }
  return left <= right ? { x: left, y: top, width: right - left, height: bottom - top } : { x: 0, y: 0, width: 0, height: 0 };
}

function meet(a: Box, b: Box): boolean {
  return a.x <= b.x + b.width && b.x <= a.x + a.width && a.y <= b.y + b.height && b.y <= a.y + a.height;
}

function holds(box: Box, x: number, y: number): boolean {
  return x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;
}

function joined(a: Box, b: Box): Box {
  const [x, y] = [Math.min(a.x, b.x), Math.min(a.y, b.y)];
  return { x, y, width: Math.max(a.x + a.width, b.x + b.width) - x, height: Math.max(a.y + a.height, b.y + b.height) - y };
}

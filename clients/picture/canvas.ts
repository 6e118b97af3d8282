// A drawing of many contours on a canvas: elements are batched by tile, and findings that lie close together become one mark with a count.

import type { Box, Size } from "./frame";
import { Named } from "./named";
import { boxOf, dataOf, trace } from "./pieces";
import type { Piece } from "./protocol";

/** The number of tiles along each side of the drawing. */
const TILES = 32;
/** A frame may take this long, ms: while somebody moves a drawing that takes longer, its last picture is moved. */
const FRAME = 12;
/** After this long without movement the drawing is drawn sharp, ms. */
const REST = 90;
/** Findings nearer than this on the screen are one mark, pixels. */
const NEAR = 26;
const SEVERITIES = ["error", "warning", "remark", "hint"] as const;
const SVG = "http://www.w3.org/2000/svg";

export interface Item {
  piece: Piece;
  kind: string;
  box: Box;
  /** Made when somebody asks for it. */
  element?: SVGGraphicsElement;
}

interface Batch {
  kind: string;
  /** The width of a line that is drawn to scale, in units of the sheet; else 0. */
  width: number;
  path: Path2D;
  box: Box;
}

export interface Cluster {
  x: number;
  y: number;
  /** Index into [`SEVERITIES`]. */
  worst: number;
  items: Item[];
}

/** The order of drawing, from the bottom up. */
const ORDER = ["part", "lost", "void", "kerf", "aside", "contour", "upper", "jump", "wire", "lead", "hint", "remark", "warning", "error"] as const;

export class Canvas {
  readonly #canvas = document.createElement("canvas");
  readonly #last = document.createElement("canvas");
  readonly #items: Item[] = [];
  readonly #named = new Named<Item>();
  readonly #ofElement = new Map<Element, Item>();
  #batches: Batch[] = [];
  readonly #threads: { x: number; y: number; order: string }[] = [];
  #extent: Box = { x: 0, y: 0, width: 1, height: 1 };
  #lastView: Box | null = null;
  #clusters: Cluster[] = [];
  #cost = 0;
  #timer = 0;
  #isAwaited = false;
  #view: Box = this.#extent;
  #size: Size = { width: 1, height: 1 };

  /** `left` and `bottom` are the place of the drawing on the sheet. */
  constructor(
    pieces: readonly Piece[],
    private readonly left: number,
    private readonly bottom: number,
  ) {
    for (const piece of pieces) {
      const { at, order } = piece;
      const classes = piece.class.split(" ");
      const kind = ORDER.findLast((kind) => classes.includes(kind));
      const box = boxOf(at, left, bottom);
      if (piece.class === "thread") {
        this.#threads.push({ x: box.x, y: box.y, order: order === undefined ? "" : String(order) });
      } else if (kind !== undefined) {
        const item = { piece, kind, box };
        this.#items.push(item);
        this.#named.add(piece, item);
      }
    }
    this.#arrange();
  }

  get element(): HTMLCanvasElement {
    return this.#canvas;
  }

  /** Elements that stand for the segment; with null, for the entity. */
  ofSegment(handle: string, segment: number | null): SVGElement[] {
    return this.#named.ofSegment(handle, segment).map((item) => this.#elementOf(item));
  }

  ofLine(line: number): SVGElement[] {
    return this.#named.ofLine(line).map((item) => this.#elementOf(item));
  }

  #elementOf(item: Item): SVGGraphicsElement {
    if (item.element === undefined) {
      const { piece, kind } = item;
      const isDot = piece.at.length < 3;
      const element = document.createElementNS(SVG, isDot ? "circle" : "path");
      element.setAttribute("class", piece.class);
      const [x, y] = piece.at.map((each) => String(each / 1000));
      const shape = isDot ? { cx: x ?? "", cy: y ?? "", r: kind === "error" ? "4.5" : "3.6" } : { d: dataOf(piece.at) };
      for (const [name, value] of Object.entries(shape)) {
        element.setAttribute(name, value);
      }
      for (const name of ["handle", "segment", "line"] as const) {
        if (piece[name] !== undefined) {
          element.dataset[name] = String(piece[name]);
        }
      }
      item.element = element;
      this.#ofElement.set(element, item);
    }
    return item.element;
  }

  #arrange(): void {
    // There may be more of them than a call takes arguments.
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { box } of this.#items) {
      [left, top] = [Math.min(left, box.x), Math.min(top, box.y)];
      [right, bottom] = [Math.max(right, box.x + box.width), Math.max(bottom, box.y + box.height)];
    }
    this.#extent = { x: left, y: top, width: Math.max(right - left, 1e-9), height: Math.max(bottom - top, 1e-9) };
    const batches = new Map<string, Map<string, Batch>>(ORDER.map((kind) => [kind, new Map<string, Batch>()]));
    const put = (kind: string, { piece, box }: Item, width = 0): void => {
      const tile = `${this.#tileOf(box.x + box.width / 2, box.y + box.height / 2)} ${width}`;
      const tiles = batches.get(kind);
      let batch = tiles?.get(tile);
      if (batch === undefined) {
        batch = { kind, width: width / 1000, path: new Path2D(), box };
        tiles?.set(tile, batch);
      }
      trace(batch.path, piece.at, this.left, this.bottom);
      batch.box = joined(batch.box, box);
    };
    for (const item of this.#items) {
      const { piece, kind } = item;
      // Dashes upon dashes of the other way would look solid.
      if (piece.class === "lead back") {
        continue;
      }
      if (piece.width !== undefined) {
        put("kerf", item, piece.width);
      }
      if (kind !== "kerf") {
        put(kind, item);
      }
    }
    this.#batches = [...batches.values()].flatMap((tiles) => [...tiles.values()]);
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
      if (worst < 0) {
        continue;
      }
      const [x, y] = [item.box.x + item.box.width / 2, item.box.y + item.box.height / 2];
      if (!holds(this.#view, x, y)) {
        continue;
      }
      const cell = `${Math.floor((x - this.#view.x) / pixel / NEAR)} ${Math.floor((y - this.#view.y) / pixel / NEAR)}`;
      const known = cells.get(cell) ?? { x, y, worst, items: [] };
      known.items.push(item);
      known.worst = Math.min(known.worst, worst);
      known.x += (x - known.x) / known.items.length;
      known.y += (y - known.y) / known.items.length;
      cells.set(cell, known);
    }
    this.#clusters = [...cells.values()];
    context.textAlign = "center";
    for (const { x, y, items, worst } of this.#clusters) {
      const count = items.length;
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

  /** What is drawn on top at a place of the sheet, within `reach`. */
  at(x: number, y: number, reach: number): Piece | null {
    const context = this.#canvas.getContext("2d");
    if (context === null) {
      return null;
    }
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.lineWidth = 2 * reach;
    const around: Box = { x: x - reach, y: y - reach, width: 2 * reach, height: 2 * reach };
    const found = this.#items.findLast(({ piece, box }) => {
      if ((piece.handle === undefined && piece.line === undefined) || !meet(box, around)) {
        return false;
      }
      const path = new Path2D();
      trace(path, piece.at, this.left, this.bottom);
      return context.isPointInStroke(path, x, y);
    });
    context.restore();
    return found?.piece ?? null;
  }

  /** The pieces of the wire's way, in the order in which it is travelled. */
  wire(): Piece[] {
    const blocks = this.#items.filter(({ piece }) => piece.line !== undefined);
    const way = blocks.length > 0 ? blocks : this.#items.filter(({ kind }) => kind === "wire" || kind === "lead" || kind === "jump");
    return way.map(({ piece }) => piece);
  }

  boxOf(elements: readonly Element[]): Box | null {
    return boxOfItems(elements.flatMap((element) => this.#ofElement.get(element) ?? []));
  }
}

export function boxOfItems(items: readonly Item[]): Box | null {
  return items.reduce<Box | null>((all, { box }) => (all === null ? box : joined(all, box)), null);
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
  upper: ["--remark", 1.2, []],
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

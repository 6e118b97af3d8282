// Moves the wire along its way: slider, play and pause, speed, and the figures of the block that is being cut.

import type { SimulatedBlock } from "./protocol";
import { element, type Host } from "./host";
import type { Sheet, Way } from "./sheet";
import { type Spot, Track } from "./track";
import { t } from "./words";

/** How long the whole way takes at speed 1, in seconds: so that a short program can be followed, and a long one seen. */
const SHORTEST = 6;
const LONGEST = 60;
/** Seconds for one piece of the way. */
const PER_PIECE = 0.35;
const SVG = "http://www.w3.org/2000/svg";

export class Player {
  readonly #section = element("player", HTMLElement);
  readonly #slider = element("slider", HTMLInputElement);
  readonly #speed = element("speed", HTMLSelectElement);
  readonly #button = element("play", HTMLButtonElement);
  readonly #where = element("where", HTMLElement);
  readonly #motion = element("motion", HTMLElement);
  readonly #block = element("block", HTMLElement);
  #sheet: Sheet | null = null;
  #pieces: Way[] = [];
  #track = new Track([]);
  #blocks = new Map<number, SimulatedBlock>();
  #lines: readonly string[] = [];
  /** The length that is cut up to the end of each piece, without jumps. */
  #cut: number[] = [];
  #mmPerUnit = 0;
  #distance = 0;
  #playing = false;
  #last = 0;
  /** Index of the piece shown last, so that each piece since then is coloured once. */
  #shown = -1;
  #toldLine: number | null = null;
  #wire: SVGCircleElement | null = null;
  #trail: SVGPathElement | null = null;
  /** Knows the points of the present piece. */
  readonly #place = document.createElementNS(SVG, "path");

  constructor(private readonly host: Host) {
    this.#button.addEventListener("click", () => {
      this.toggle();
    });
    this.#slider.addEventListener("input", () => {
      this.#pause();
      this.#go((Number(this.#slider.value) / Number(this.#slider.max)) * this.#track.length);
    });
    this.#showButton();
  }

  get playing(): boolean {
    return this.#playing;
  }

  /** A new picture: the wire stays at its share of the way where it is the same document. */
  put(sheet: Sheet, blocks: readonly SimulatedBlock[], lines: readonly string[], sameDocument: boolean): void {
    const share = sameDocument && this.#track.length > 0 ? this.#distance / this.#track.length : 0;
    if (!sameDocument) {
      this.#pause();
    }
    this.#sheet = sheet;
    this.#pieces = sheet.wire();
    this.#blocks = new Map(blocks.map((block) => [block.line, block]));
    this.#lines = lines;
    this.#track = new Track(this.#pieces.map(({ length }) => length));
    let cut = 0;
    this.#cut = this.#pieces.map(({ length, isJump }) => (cut += isJump ? 0 : length));
    // The sheet is drawn with few digits: the length that is cut is the server's, and the picture only gives the shares of the pieces.
    this.#mmPerUnit = cut > 0 && sheet.cut > 0 ? sheet.cut / cut : sheet.unitsPerMm > 0 ? 1 / sheet.unitsPerMm : 0;
    this.#section.hidden = this.#track.length === 0;
    this.#shown = -1;
    this.#wire = this.#trail = null;
    if (share > 0) {
      this.#go(share * this.#track.length);
    } else {
      this.#distance = 0;
      this.#slider.value = "0";
      this.#showFigures(this.#track.at(0));
    }
  }

  toggle(): void {
    if (this.#playing) {
      this.#pause();
    } else {
      this.play();
    }
  }

  play(): void {
    if (this.#track.length === 0 || this.#playing) {
      return;
    }
    if (this.#distance >= this.#track.length) {
      this.#go(0);
    }
    this.#playing = true;
    this.#last = performance.now();
    this.#showButton();
    requestAnimationFrame((now) => {
      this.#step(now);
    });
  }

  /** Goes to the beginning of the block in a line of the program. */
  toLine(line: number): void {
    const piece = this.#playing ? -1 : this.#pieces.findIndex((each) => each.line === line);
    if (piece >= 0) {
      // The end of the piece before is the same place, and another block.
      this.#put(this.#track.startOf(piece), { piece, along: 0 });
      this.#tell(null);
    }
  }

  #pause(): void {
    this.#playing = false;
    this.#showButton();
  }

  #step(now: number): void {
    if (!this.#playing) {
      return;
    }
    const seconds = Math.min(Math.max(this.#pieces.length * PER_PIECE, SHORTEST), LONGEST);
    const way = (Math.min(now - this.#last, 250) / 1000 / seconds) * this.#track.length * Number(this.#speed.value);
    this.#last = now;
    this.#go(this.#distance + way);
    if (this.#distance >= this.#track.length) {
      this.#pause();
      this.#tell(null);
      return;
    }
    requestAnimationFrame((next) => {
      this.#step(next);
    });
  }

  #go(distance: number): void {
    const spot = this.#track.at(distance);
    if (spot === null) {
      return;
    }
    this.#put(Math.min(Math.max(distance, 0), this.#track.length), spot);
    const line = this.#pieces[spot.piece]?.line;
    if (line !== undefined) {
      this.#tell(line);
    }
  }

  #put(distance: number, spot: Spot): void {
    this.#distance = distance;
    this.#slider.value = String(Math.round((this.#distance / this.#track.length) * Number(this.#slider.max)));
    const piece = this.#pieces[spot.piece];
    if (piece === undefined) {
      return;
    }
    this.#colour(spot.piece);
    this.#mark(piece, spot.along);
    this.#showFigures(spot);
  }

  /** Marks the pieces before the wire as cut. */
  #colour(piece: number): void {
    const [from, to] = [Math.min(this.#shown, piece), Math.max(this.#shown, piece)];
    for (let index = Math.max(from, 0); index <= to; index += 1) {
      this.#pieces[index]?.element?.classList.toggle("cut", index < piece);
    }
    this.#shown = piece;
  }

  /** The wire itself, and what of the present piece is cut. */
  #mark(piece: Way, along: number): void {
    const parent = this.#sheet?.drawing;
    if (this.#wire === null || this.#trail === null) {
      this.#trail = document.createElementNS(SVG, "path");
      this.#trail.classList.add("trail");
      this.#wire = document.createElementNS(SVG, "circle");
      this.#wire.classList.add("head");
    }
    if (this.#wire.parentElement !== parent) {
      parent?.append(this.#trail, this.#wire);
    }
    const { length } = piece;
    this.#place.setAttribute("d", piece.data());
    this.#trail.setAttribute("d", piece.data());
    this.#trail.setAttribute("pathLength", "1");
    this.#trail.setAttribute("stroke-dasharray", `${length > 0 ? along / length : 1} 2`);
    const { x, y } = this.#place.getPointAtLength(along);
    this.#wire.setAttribute("cx", String(x));
    this.#wire.setAttribute("cy", String(y));
  }

  #showFigures(spot: Spot | null): void {
    const piece = spot === null ? undefined : this.#pieces[spot.piece];
    if (spot === null || piece === undefined) {
      this.#where.textContent = this.#motion.textContent = this.#block.textContent = "";
      return;
    }
    const jumps = piece.isJump;
    const before = this.#cut[spot.piece - 1] ?? 0;
    const cut = jumps ? before : before + spot.along;
    const mm = (length: number): string => (length * this.#mmPerUnit).toFixed(1);
    const travelled = this.#mmPerUnit > 0 ? t("cut {0} of {1} mm", mm(cut), mm(this.#cut.at(-1) ?? 0)) : "";
    const { line } = piece;
    this.#motion.className = jumps ? "jumps" : "cuts";
    this.#motion.textContent = jumps ? t("Jump") : t("Cut");
    this.#block.textContent = line === undefined ? "" : (this.#lines[line]?.trim() ?? "");
    const block = line === undefined ? undefined : this.#blocks.get(line);
    const facts = [line === undefined ? "" : t("line {0}", line + 1), travelled];
    if (block !== undefined) {
      const [x, y] = block.end;
      facts.splice(1, 0, t("to {0}, {1}", (x / 1000).toFixed(3), (y / 1000).toFixed(3)));
      if (block.deviation !== 0) {
        facts.push(t("{0} µm off", block.deviation.toFixed(2)));
      }
    }
    this.#where.textContent = facts.filter((fact) => fact !== "").join(" · ");
  }

  #tell(line: number | null): void {
    if (line !== this.#toldLine) {
      this.#toldLine = line;
      this.host.hear({ type: "playing", line });
    }
  }

  #showButton(): void {
    this.#button.classList.toggle("playing", this.#playing);
    this.#button.setAttribute("aria-label", this.#playing ? t("Pause") : t("Play"));
    this.#button.title = this.#playing ? t("Pause (space)") : t("Play (space)");
  }
}

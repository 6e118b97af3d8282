// The pieces of a drawing in numbers: `x, y` where one begins, then `x, y, radius` of each line and arc of it, in thousandths, y upwards.

import type { Box } from "./frame";
import { namesOf } from "./named";
import type { Piece } from "./protocol";

const THOUSAND = 1000;

interface Part {
  from: [number, number];
  to: [number, number];
  /** 0 for a line; below 0 for an arc that runs clockwise. */
  radius: number;
}

function* partsOf(at: readonly number[]): Generator<Part> {
  let from: [number, number] = [(at[0] ?? 0) / THOUSAND, (at[1] ?? 0) / THOUSAND];
  for (let index = 2; index < at.length; index += 3) {
    const to: [number, number] = [(at[index] ?? 0) / THOUSAND, (at[index + 1] ?? 0) / THOUSAND];
    yield { from, to, radius: (at[index + 2] ?? 0) / THOUSAND };
    from = to;
  }
}

/** The distance of an arc's middle from its chord; of a line none. */
function rise(chord: number, radius: number): number {
  return Math.abs(radius) - fromCenter(chord, radius);
}

/** An arc is less than a half turn. */
function fromCenter(chord: number, radius: number): number {
  return Math.sqrt(Math.max(radius * radius - (chord * chord) / 4, 0));
}

export function lengthOf(at: readonly number[]): number {
  let length = 0;
  for (const { from, to, radius } of partsOf(at)) {
    const chord = Math.hypot(to[0] - from[0], to[1] - from[1]);
    length += radius === 0 ? chord : 2 * Math.abs(radius) * Math.asin(Math.min(chord / 2 / Math.abs(radius), 1));
  }
  return length;
}

/** As the data of a path. */
export function dataOf(at: readonly number[]): string {
  let data = `M${(at[0] ?? 0) / THOUSAND} ${(at[1] ?? 0) / THOUSAND}`;
  for (const { to, radius } of partsOf(at)) {
    const size = Math.abs(radius);
    data += radius === 0 ? `L${to[0]} ${to[1]}` : `A${size} ${size} 0 0 ${radius > 0 ? 1 : 0} ${to[0]} ${to[1]}`;
  }
  return data;
}

/** Where a piece lies on the sheet, whose y points down; `left` and `bottom` are the place of the drawing there. */
export function boxOf(at: readonly number[], left: number, bottom: number): Box {
  const [x, y] = [(at[0] ?? 0) / THOUSAND, (at[1] ?? 0) / THOUSAND];
  let [least, low, most, high] = [x, y, x, y];
  for (const { from, to, radius } of partsOf(at)) {
    // An arc keeps within its rise of its chord.
    const about = radius === 0 ? 0 : rise(Math.hypot(to[0] - from[0], to[1] - from[1]), radius);
    least = Math.min(least, to[0] - about, from[0] - about);
    most = Math.max(most, to[0] + about, from[0] + about);
    low = Math.min(low, to[1] - about, from[1] - about);
    high = Math.max(high, to[1] + about, from[1] + about);
  }
  return { x: left + least, y: bottom - high, width: most - least, height: high - low };
}

/** Draws a piece on the sheet. */
export function trace(path: Path2D, at: readonly number[], left: number, bottom: number): void {
  path.moveTo(left + (at[0] ?? 0) / THOUSAND, bottom - (at[1] ?? 0) / THOUSAND);
  for (const { from, to, radius } of partsOf(at)) {
    const [across, up] = [to[0] - from[0], to[1] - from[1]];
    const chord = Math.hypot(across, up);
    if (radius === 0 || chord === 0) {
      path.lineTo(left + to[0], bottom - to[1]);
      continue;
    }
    // The centre lies to the left of an arc that runs counter-clockwise.
    const far = (fromCenter(chord, radius) * Math.sign(radius)) / chord;
    const [x, y] = [(from[0] + to[0]) / 2 - up * far, (from[1] + to[1]) / 2 + across * far];
    const angle = (point: [number, number]): number => -Math.atan2(point[1] - y, point[0] - x);
    path.arc(left + x, bottom - y, Math.abs(radius), angle(from), angle(to), radius > 0);
  }
}

/** From this many elements on a drawing is drawn in pieces, as from the server. */
const MANY = 2_000;

/** Takes the pieces out of a drawing that came as SVG, as the command line writes it; null where they are few. */
export function taken(drawing: SVGGElement): Piece[] | null {
  const elements = Array.from(drawing.querySelectorAll<SVGElement>(":scope > :is(path, rect, circle, text), :scope > g:is(.thread, .turned), :scope > g > .thread"));
  if (elements.length < MANY) {
    return null;
  }
  // All at once: some browsers take the longer for each one the more of them there are.
  drawing.replaceChildren();
  const pieces: Piece[] = [];
  for (const element of elements) {
    const number = (name: string): number => Math.round(Number(element.getAttribute(name)) * THOUSAND);
    const named = {
      class: element.getAttribute("class") ?? "",
      ...namesOf(element),
      ...(element.hasAttribute("stroke-width") ? { width: number("stroke-width") } : {}),
    };
    if (element.classList.contains("turned")) {
      const [thread, order] = [pieces.at(-1), Number(element.textContent)];
      if (thread?.class === "thread" && order > 0) {
        thread.order = order;
      }
    } else if (element.classList.contains("thread")) {
      const circle = element.querySelector("circle");
      const moved = /translate\(([-\d.]+)[ ,]([-\d.]+)\)/.exec(element.parentElement?.getAttribute("transform") ?? "");
      const [x, y] = moved === null ? [circle?.getAttribute("cx"), circle?.getAttribute("cy")] : [moved[1], moved[2]];
      pieces.push({ ...named, at: [x, y].map((each) => Math.round(Number(each) * THOUSAND)) });
    } else if (element.tagName === "circle" && !element.classList.contains("fine")) {
      pieces.push({ ...named, at: [number("cx"), number("cy")] });
    } else if (element.tagName === "rect") {
      const [x, y, width, height] = [number("x"), number("y"), number("width"), number("height")];
      pieces.push({ ...named, at: [x, y, x + width, y, 0, x + width, y + height, 0, x, y + height, 0, x, y, 0] });
    } else if (element.tagName === "path") {
      pieces.push(...runsOf(element.getAttribute("d") ?? "").map((at) => ({ ...named, at })));
    }
  }
  return pieces;
}

/** Path data as the server writes it, M, L, A and Z with absolute coordinates, as runs. */
export function runsOf(data: string): number[][] {
  const runs: number[][] = [];
  for (const [, letter, numbers] of data.matchAll(/([MLA])([^MLAZ]*)/g)) {
    const values = (numbers ?? "").trim().split(/[ ,]+/).map(Number);
    const [x, y] = values.slice(-2).map((each) => Math.round(each * THOUSAND)) as [number, number];
    if (letter === "M") {
      runs.push([x, y]);
    } else {
      const radius = letter === "A" ? Math.round((values[0] ?? 0) * THOUSAND) : 0;
      runs.at(-1)?.push(x, y, values[4] === 0 ? -radius : radius);
    }
  }
  return runs;
}

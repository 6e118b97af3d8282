// Which part of the sheet is seen: pure arithmetic of pan and zoom. Lengths are the sheet's units unless a name says pixels.

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Size {
  width: number;
  height: number;
}

/** A wire of 0.02 mm in a plate of a metre can still be looked at. */
const CLOSEST = 1e-5;
const FARTHEST = 6;

/** Sheet units in one pixel, where all of `box` is to be seen in `size`. */
export function unitsPerPixel(box: Box, size: Size): number {
  return Math.max(box.width / Math.max(size.width, 1), box.height / Math.max(size.height, 1));
}

/** `content` with a margin in pixels at each side, in the window's proportions. */
export function fitted(content: Box, size: Size, margin: Size): Box {
  const free = { width: Math.max(size.width - 2 * margin.width, 1), height: Math.max(size.height - 2 * margin.height, 1) };
  const scale = unitsPerPixel(content, free) || 1;
  const [width, height] = [size.width * scale, size.height * scale];
  return { x: content.x + content.width / 2 - width / 2, y: content.y + content.height / 2 - height / 2, width, height };
}

/** `factor` above 1 comes closer; the point (`x`, `y`) stays where it is. `all` is the view of everything. */
export function zoomed(view: Box, factor: number, x: number, y: number, all: Box): Box {
  const width = Math.min(Math.max(view.width / factor, all.width * CLOSEST), all.width * FARTHEST);
  const real = view.width / width;
  return { x: x - (x - view.x) / real, y: y - (y - view.y) / real, width, height: view.height / real };
}

export function moved(view: Box, dx: number, dy: number): Box {
  return { ...view, x: view.x + dx, y: view.y + dy };
}

/** The same scale, with the point in the middle. */
export function centred(view: Box, x: number, y: number): Box {
  return { ...view, x: x - view.width / 2, y: y - view.height / 2 };
}

/** Whether a box is seen, apart from the outermost tenth of the view. */
export function sees(view: Box, box: Box): boolean {
  const [dx, dy] = [view.width / 10, view.height / 10];
  const across = box.x + box.width >= view.x + dx && box.x <= view.x + view.width - dx;
  return across && box.y + box.height >= view.y + dy && box.y <= view.y + view.height - dy;
}

/** The largest of 1, 2, 5 × 10ⁿ that is not above `length`; 0 where there is none. */
export function roundLength(length: number): number {
  if (!(length > 0) || !Number.isFinite(length)) {
    return 0;
  }
  const decade = 10 ** Math.floor(Math.log10(length));
  return (([5, 2, 1] as const).find((step) => step * decade <= length) ?? 1) * decade;
}

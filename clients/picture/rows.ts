// The radius list as rows: a contour and the segments in it, then the entities that are in none. Knows nothing of VS Code.

import type { ContoursContour, InspectedEntity, InspectedSegment, Inspection } from "./protocol";
import type { Fault } from "./messages";
import { circled, markNumbers } from "./numbers";
import { handlesOf } from "./shown";
import { t } from "./words";

export interface SegmentRow {
  kind: "segment";
  handle: string;
  segment: InspectedSegment;
  label: string;
  description: string;
  faulty: boolean;
}

/** A contour, or an entity that is in none. */
export interface EntityRow {
  kind: "entity";
  /** The handle of its first entity, by which it is named. */
  handle: string;
  handles: string[];
  label: string;
  description: string;
  faults: number;
  segments: SegmentRow[];
}

export type Row = EntityRow | SegmentRow;

/** What the rows need beside the segments. */
interface Read {
  toMm: number;
  /** The numbers of the marks on each segment, by handle and segment. */
  marks: ReadonlyMap<string, readonly number[]>;
}

/** Contours in the order in which they are cut. With `onlyFaults`, those without a fault are left out. */
export function rows(
  inspection: Inspection,
  onlyFaults: boolean,
  contours: readonly ContoursContour[] = [],
  faults: readonly Fault[] = [],
): EntityRow[] {
  const read: Read = { toMm: inspection.unitsToMm, marks: marksOf(faults) };
  const entities = new Map(inspection.entities.map((entity) => [entity.handle, entity]));
  const numbered = contours.map((contour, index) => ({ contour, number: (contour.order ?? index) + 1 }));
  numbered.sort((a, b) => a.number - b.number);
  const listed = numbered.map(({ contour, number }) => contourRow(contour, number, entities, read, onlyFaults));
  const held = new Set(listed.flatMap(({ handles }) => handles));
  const loose = inspection.entities.filter(({ handle }) => !held.has(handle));
  const all = [...listed, ...loose.map((entity) => entityRow(entity, read, onlyFaults))];
  return onlyFaults ? all.filter((entity) => entity.faults > 0) : all;
}

function contourRow(
  contour: ContoursContour,
  number: number,
  entities: ReadonlyMap<string, InspectedEntity>,
  read: Read,
  onlyFaults: boolean,
): EntityRow {
  const handles = handlesOf(contour);
  const segments = handles.flatMap((handle) => {
    const own = entities.get(handle)?.segments ?? [];
    return own.map((segment) => segmentRow(handle, segment, read, handles.length > 1));
  });
  const layers = [...new Set(handles.map((handle) => entities.get(handle)?.layer ?? ""))];
  const row = { handle: handles[0] ?? "", handles, label: t("Contour {0}", number), layer: layers.join(", ") };
  return withSegments(row, segments, onlyFaults);
}

function entityRow(entity: InspectedEntity, read: Read, onlyFaults: boolean): EntityRow {
  const segments = entity.segments.map((segment) => segmentRow(entity.handle, segment, read, false));
  const row = { handle: entity.handle, handles: [entity.handle], label: `${entity.type} ${entity.handle}`, layer: entity.layer };
  return withSegments(row, segments, onlyFaults);
}

function withSegments(row: Pick<EntityRow, "handle" | "handles" | "label"> & { layer: string }, segments: SegmentRow[], onlyFaults: boolean): EntityRow {
  const { layer, ...named } = row;
  const faults = segments.filter((segment) => segment.faulty).length;
  const count = segments.length === 1 ? t("1 segment") : t("{0} segments", segments.length);
  return {
    kind: "entity",
    ...named,
    description: `${layer} · ${faults === 0 ? count : t("{0} of {1} not ok", faults, count)}`,
    faults,
    segments: onlyFaults ? segments.filter((segment) => segment.faulty) : segments,
  };
}

function segmentRow(handle: string, segment: InspectedSegment, { toMm, marks }: Read, isNamed: boolean): SegmentRow {
  const mm = (length: number): string => (length * toMm).toFixed(3);
  const what = segment.radius === undefined ? `${t("line")} ${mm(segment.length)}` : `R ${mm(segment.radius)}`;
  const [x, y] = segment.start;
  const numbers = (marks.get(`${handle}/${segment.index}`) ?? []).map(circled);
  return {
    kind: "segment",
    handle,
    segment,
    label: `${isNamed ? `${handle} · ` : ""}${segment.index}   ${what}`,
    description: [...numbers, ...(segment.verdict === "ok" ? [] : [segment.verdict]), `${mm(x)}, ${mm(y)}`].join(" · "),
    faulty: segment.verdict !== "ok",
  };
}

function marksOf(faults: readonly Fault[]): Map<string, number[]> {
  const marks = new Map<string, number[]>();
  for (const [index, number] of markNumbers(faults).entries()) {
    const { handle, segment } = faults[index] ?? {};
    if (number !== undefined && handle !== undefined && segment !== undefined) {
      const place = `${handle}/${segment}`;
      marks.set(place, [...(marks.get(place) ?? []), number]);
    }
  }
  return marks;
}

/** The totals above the list. */
export function summary(list: EntityRow[]): string {
  const faults = list.reduce((sum, entity) => sum + entity.faults, 0);
  return faults === 0 ? t("all ok") : t("{0} not ok", faults);
}

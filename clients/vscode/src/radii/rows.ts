// The radius list as rows: an entity and the segments in it. Knows nothing of VS Code.

import type { InspectedEntity, InspectedSegment, Inspection } from "../protocol";
import { t } from "../words";

export interface SegmentRow {
  kind: "segment";
  handle: string;
  segment: InspectedSegment;
  label: string;
  description: string;
  faulty: boolean;
}

export interface EntityRow {
  kind: "entity";
  handle: string;
  label: string;
  description: string;
  faults: number;
  segments: SegmentRow[];
}

export type Row = EntityRow | SegmentRow;

/** Entities in machining order. With `onlyFaults`, what is sound is left out. */
export function rows(inspection: Inspection, onlyFaults: boolean): EntityRow[] {
  const all = inspection.entities.map((entity) => entityRow(entity, inspection.unitsToMm, onlyFaults));
  return onlyFaults ? all.filter((entity) => entity.faults > 0) : all;
}

function entityRow(entity: InspectedEntity, toMm: number, onlyFaults: boolean): EntityRow {
  const segments = entity.segments.map((segment) => segmentRow(entity.handle, segment, toMm));
  const faults = segments.filter((segment) => segment.faulty).length;
  const count = segments.length === 1 ? t("1 segment") : t("{0} segments", segments.length);
  return {
    kind: "entity",
    handle: entity.handle,
    label: `${entity.type} ${entity.handle}`,
    description: `${entity.layer} · ${faults === 0 ? count : t("{0} of {1} not ok", faults, count)}`,
    faults,
    segments: onlyFaults ? segments.filter((segment) => segment.faulty) : segments,
  };
}

function segmentRow(handle: string, segment: InspectedSegment, toMm: number): SegmentRow {
  const mm = (length: number): string => (length * toMm).toFixed(3);
  const what = segment.radius === undefined ? t("line {0}", mm(segment.length)) : `R ${mm(segment.radius)}`;
  const [x, y] = segment.start;
  return {
    kind: "segment",
    handle,
    segment,
    label: `${segment.index}   ${what}`,
    description: segment.verdict === "ok" ? `${mm(x)}, ${mm(y)}` : `${segment.verdict} · ${mm(x)}, ${mm(y)}`,
    faulty: segment.verdict !== "ok",
  };
}

/** The totals above the list. */
export function summary(list: EntityRow[]): string {
  const faults = list.reduce((sum, entity) => sum + entity.faults, 0);
  return faults === 0 ? t("all ok") : t("{0} not ok", faults);
}

// What the lists show, as rows: files, findings, radii, contours, the lines of a program.

import { Faults } from "../../picture/faults";
import type { Contour, Fault, Severity } from "../../picture/messages";
import type { Contours, Inspection } from "../../picture/protocol";
import { circled, markNumbers } from "../../picture/numbers";
import { rows as radii } from "../../picture/rows";
import { byHandle } from "../../picture/shown";
import { t } from "../../picture/words";
import type { FileEntry } from "./api";
import { keyOf } from "./doc";
import type { Row } from "./list";

const KINDS: Record<FileEntry["language"], string> = { dxf: "DXF", "3b": "3B", "wire-iso": "ISO", toml: "TOML" };

function badge(count: number, kind: string, title: string): { text: string; kind: string; title: string }[] {
  return count > 0 ? [{ text: String(count), kind, title }] : [];
}

/** The worst first; those that hold what is searched. */
export function fileRows(files: readonly FileEntry[], searched: string): Row[] {
  const wanted = searched.toLowerCase().split(/\s+/).filter((word) => word !== "");
  const found = files.filter(({ path }) => wanted.every((word) => path.toLowerCase().includes(word)));
  // What cannot be looked at comes after what has errors, settings last.
  const rank = ({ errors, trouble, language }: FileEntry): number => {
    if (language === "toml") {
      return 3;
    }
    return (errors ?? 0) > 0 ? 0 : trouble === null ? 2 : 1;
  };
  const count = (a: number | null, b: number | null): number => (b ?? 0) - (a ?? 0);
  found.sort((a, b) => rank(a) - rank(b) || count(a.errors, b.errors) || count(a.warnings, b.warnings) || a.path.localeCompare(b.path));
  return found.map(({ uri, path, language, errors, warnings, trouble }) => ({
    key: uri,
    text: path,
    kind: `file ${language}`,
    title: trouble === null ? path : `${path}: ${trouble}`,
    badges: [
      ...(trouble === null ? [] : [{ text: "!", kind: "error", title: trouble }]),
      ...badge(errors ?? 0, "error", t("{0} errors", errors ?? 0)),
      ...badge(warnings ?? 0, "warning", t("{0} warnings", warnings ?? 0)),
      { text: KINDS[language], kind: "kind" },
    ],
  }));
}

/** Rules with their findings, the worst first; of a folded rule only the head. */
export function findingRows(
  faults: readonly Fault[],
  contours: readonly Contour[],
  fresh: ReadonlySet<string>,
  folded: ReadonlySet<string>,
): Row[] {
  const groups = new Map<string, number[]>();
  for (const index of Faults.sorted(faults)) {
    const rule = faults[index]?.rule ?? "";
    const group = groups.get(rule) ?? [];
    group.push(index);
    groups.set(rule, group);
  }
  const [ofHandle, marks] = [byHandle(contours), markNumbers(faults)];
  return [...groups].flatMap(([rule, indices]) => {
    const severity: Severity = faults[indices[0] ?? 0]?.severity ?? "hint";
    const isFolded = folded.has(rule);
    const head: Row = { key: `rule ${rule}`, text: `${isFolded ? "▸" : "▾"} ${rule}`, kind: `head ${severity}`, badges: badge(indices.length, severity, "") };
    return [head, ...(isFolded ? [] : indices.flatMap((index) => findingRow(faults[index], index, marks[index], ofHandle, fresh)))];
  });
}

function findingRow(
  fault: Fault | undefined,
  index: number,
  mark: number | undefined,
  contours: ReadonlyMap<string, Contour>,
  fresh: ReadonlySet<string>,
): Row[] {
  if (fault === undefined) {
    return [];
  }
  const { severity, message, handle, segment, line } = fault;
  const contour = contours.get(handle ?? "");
  const entity = segment === undefined ? (handle ?? "") : `${handle ?? ""} · ${segment}`;
  const place = handle === undefined ? t("line {0}", (line ?? 0) + 1) : contour === undefined ? entity : `${t("contour {0}", contour.number)} · ${entity}`;
  const isNew = fresh.has(keyOf(fault));
  const badges = isNew ? [{ text: t("new"), kind: "new" }] : [];
  return [{ key: `fault ${index}`, text: message, detail: mark === undefined ? place : `${circled(mark)} ${place}`, kind: `finding ${severity}${isNew ? " new" : ""}`, badges }];
}

export function radiusRows(inspection: Inspection, contours: Contours, onlyFaults: boolean, faults: readonly Fault[]): Row[] {
  return radii(inspection, onlyFaults, contours.contours, faults).flatMap((entity) => [
    { key: `entity ${entity.handle}`, text: entity.label, detail: entity.description, kind: "head", badges: badge(entity.faults, "error", "") },
    ...entity.segments.map(({ handle, segment, label, description, faulty }) => ({
      key: `segment ${handle} ${segment.index}`, text: label, detail: description, kind: faulty ? "error" : "",
    })),
  ]);
}

export function roleOf(contour: Contour): string {
  const roles: Record<Contour["role"], string> = {
    opening: t("Opening"), punch: t("Punch"), left: t("Left"), right: t("Right"), line: t("On the line"), ignore: t("Not cut"), both: t("side not set"),
  };
  return roles[contour.role];
}

export function contourRows(contours: readonly Contour[]): Row[] {
  return [...contours].sort((a, b) => a.number - b.number).map((contour) => {
    const { number, handles, closed, length, said } = contour;
    const kept = Object.keys(said).length > 0 ? ` · wedm.toml` : "";
    return {
      key: `contour ${handles[0] ?? ""}`,
      text: `${t("Contour {0}", number)} · ${roleOf(contour)}`,
      detail: `${closed ? t("closed") : t("open")} · ${length.toFixed(1)} mm · ${handles.slice(0, 3).join(", ")}${handles.length > 3 ? " …" : ""}${kept}`,
      kind: contour.role === "ignore" ? "faint" : "",
    };
  });
}

/** The lines of a program, with what was found in them. */
export function lineRows(lines: readonly string[], faults: readonly Fault[]): Row[] {
  const worst = new Map<number, Fault>();
  for (const index of Faults.sorted(faults).reverse()) {
    const fault = faults[index];
    if (fault?.line !== undefined) {
      worst.set(fault.line, fault);
    }
  }
  // The line after the last end of a line is none.
  const all = lines.at(-1) === "" ? lines.slice(0, -1) : lines;
  return all.map((text, line) => {
    const fault = worst.get(line);
    return { key: `line ${line}`, text: `${line + 1}  ${text}`, kind: `code ${fault?.severity ?? ""}`, title: fault?.message ?? text };
  });
}

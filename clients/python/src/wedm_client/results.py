"""What the server answers about drawings.

Points, radii and lengths are drawing units, except where a line says mm; angles are degrees.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from .entities import Point
from .files import write_beside
from .settings import Role, Side
from .shown import Listing, Value, counted

SegmentKind = Literal["line", "arc", "circle"]
Direction = Literal["ccw", "cw"]
PathSource = Literal["segment", "lead-in", "lead-out", "corner", "tab", "cut-off", "overlap"]
CorrectionSource = Literal["default", "client", "file"]
Origin = Literal["default", "client", "file", "config", "option", "drawing"]


@dataclass(frozen=True)
class Segment(Value):
    """A line, arc or circle of an entity, with the names of the rules at fault or ``ok``."""

    index: int
    kind: SegmentKind
    start: Point
    end: Point
    length: float
    verdict: str
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class InspectedEntity(Value):
    handle: str
    type: str
    layer: str
    closed: bool
    cut: bool
    segments: list[Segment]


@dataclass(frozen=True)
class Inspection(Listing[InspectedEntity]):
    """Every segment of a drawing with its radius and its verdict: the list of the "R minimum" tool."""

    units_to_mm: float
    entities: list[InspectedEntity]
    largest_wire: LargestWire | None = None

    def _listed(self) -> list[InspectedEntity]:
        return self.entities

    def rows(self) -> list[dict[str, Any]]:
        """A row for each segment."""
        return [
            {
                "handle": entity.handle,
                "layer": entity.layer,
                "segment": one.index,
                "kind": one.kind,
                "start": one.start,
                "radius": one.radius,
                "sweep": one.sweep,
                "length": one.length,
                "verdict": one.verdict,
            }
            for entity in self.entities
            for one in entity.segments
        ]

    def __repr__(self) -> str:
        segments = [one for entity in self.entities for one in entity.segments]
        bad = sum(one.verdict != "ok" for one in segments)
        return f"<Inspection: {counted(len(self.entities), 'entity', 'entities')}, {counted(len(segments), 'segment')}, {bad} not ok>"


@dataclass(frozen=True)
class ContourPiece(Value):
    """A segment in the direction of the contour; ``reversed`` if that is against its entity's own direction."""

    handle: str
    segment: int
    reversed: bool
    kind: SegmentKind
    start: Point
    end: Point
    length: float
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class Gap(Value):
    """Two ends that lay apart and were joined, after the segment with index ``after``."""

    after: int
    distance: float


@dataclass(frozen=True)
class Contour(Value):
    """``order`` is its place among the cuts, from 0; ``mark`` the start mark that leads to it."""

    closed: bool
    role: Role
    length: float
    segments: list[ContourPiece]
    gaps: list[Gap]
    direction: Direction | None = None
    area: float | None = None
    order: int | None = None
    mark: Point | None = None


@dataclass(frozen=True)
class Contours(Listing[Contour]):
    units_to_mm: float
    contours: list[Contour]

    def _listed(self) -> list[Contour]:
        return self.contours

    def rows(self) -> list[dict[str, Any]]:
        """A row for each contour."""
        return [
            {
                "contour": number,
                "order": one.order,
                "closed": one.closed,
                "direction": one.direction,
                "role": one.role,
                "length": one.length,
                "area": one.area,
                "segments": len(one.segments),
                "handles": list(dict.fromkeys(piece.handle for piece in one.segments)),
                "gaps": len(one.gaps) or None,
            }
            for number, one in enumerate(self.contours)
        ]

    def __repr__(self) -> str:
        left_open = sum(not one.closed for one in self.contours)
        return f"<Contours: {len(self.contours)}, {left_open} of them open>"


@dataclass(frozen=True)
class PathPiece(Value):
    """A piece of the wire's path; ``source`` is what it follows: a ``segment`` of the drawing, the way round a ``corner`` of the part, the
    ``lead-in`` and the ``lead-out``, the ``overlap`` past the place where the contour is closed; ``tab`` leads from one pass to the next at
    the end of a tab, and ``cut-off`` runs along the tab.
    """

    source: PathSource
    kind: SegmentKind
    start: Point
    end: Point
    length: float
    handle: str | None = None
    segment: int | None = None
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class WirePath(Value):
    """The way of the wire's centre along one contour. ``correction`` is mm."""

    contour: int
    correction: float
    thread_hole: Point
    length: float
    segments: list[PathPiece]
    # `pass` in the protocol.
    pass_number: int = 1
    # For a closed contour.
    direction: Direction | None = None
    # Of a pair.
    part: str | None = None

    @property
    def cuts_off(self) -> bool:
        """It cuts off the tab that the passes before it have left standing."""
        return any(piece.source == "cut-off" for piece in self.segments)

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        return {
            "contour": self.contour,
            "pass": self.pass_number,
            "cuts off": self.cuts_off or None,
            "direction": self.direction,
            "correction": self.correction,
            "thread hole": self.thread_hole,
            "length": self.length,
            "pieces": len(self.segments),
        }


@dataclass(frozen=True)
class StartHole(Value):
    """Where the wire is threaded for a contour, in drawing units. ``diameter`` is mm, ``given`` false where the hole was found."""

    contour: str
    at: Point
    given: bool
    diameter: float | None = None
    # Of a pair.
    part: str | None = None


@dataclass(frozen=True)
class WorkCut(Value):
    """One pass along a contour: its length in mm, leads included, and how long it takes."""

    contour: str
    length: float
    # `pass` in the protocol.
    pass_number: int = 1
    cut_off: bool = False
    minutes: float | None = None


@dataclass(frozen=True)
class Slug(Value):
    """The slug that drops out of an opening: ``mass`` in g of steel."""

    contour: str
    mass: float


@dataclass(frozen=True)
class FacingWall(Value):
    """One of the walls of a narrow place."""

    handle: str
    segment: int


@dataclass(frozen=True)
class LargestWire(Value):
    """The thickest wire that still cuts every arc and passes every narrow place, mm, and what limits it.

    Where that is a narrow place, ``radius`` is half its width and ``facing`` its other wall."""

    diameter: float
    radius: float
    handle: str
    segment: int
    facing: FacingWall | None = None


@dataclass(frozen=True)
class Work(Value):
    """The figures of cutting on the machine. ``missing`` lists the keys of the settings that the absent figures need."""

    cuts: list[WorkCut]
    length: float
    jumps: float
    slugs: list[Slug]
    missing: list[str]
    minutes: float | None = None
    cost: float | None = None
    # Degrees.
    lead_angle: float | None = None
    largest_wire: LargestWire | None = None


@dataclass(frozen=True)
class ToolpathPart(Value):
    """A part of a pair: its corrections, mm, one for each pass, and what its cuts come to. ``other_side``: the wire runs on the other
    side of the drawn outline."""

    part: str
    corrections: list[float]
    work: Work
    other_side: bool = False


@dataclass(frozen=True)
class Toolpath(Listing[WirePath]):
    units_to_mm: float
    paths: list[WirePath]
    holes: list[StartHole] = field(default_factory=list)
    # Of a pair that of each part is in `parts`.
    work: Work | None = None
    parts: list[ToolpathPart] = field(default_factory=list)

    def _listed(self) -> list[WirePath]:
        return self.paths

    def rows(self) -> list[dict[str, Any]]:
        """A row for each path."""
        return [one.row() for one in self.paths]

    def __repr__(self) -> str:
        return f"<Toolpath: {counted(len(self.paths), 'path')}, {sum(one.length for one in self.paths) * self.units_to_mm:.3f} mm>"


@dataclass(frozen=True)
class SegmentShape(Value):
    """A segment in drawing units; ``sweep`` in degrees, positive counter-clockwise."""

    kind: SegmentKind
    start: Point
    end: Point
    length: float
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class Repair(Value):
    """What a repair would bring: the segments that were not there before."""

    #: The title of its code action.
    title: str
    segments: list[SegmentShape]


@dataclass(frozen=True)
class Repairs(Value):
    repairs: list[Repair]


@dataclass(frozen=True)
class SettingsInForce(Value):
    """The correction that radii of a document are checked against, mm, and which level of settings it comes from."""

    correction: float
    #: The correction of each pass.
    corrections: list[float]
    #: ``default``, ``client`` or ``file``.
    correction_from: CorrectionSource
    side: Side
    #: The level that the side comes from.
    side_from: Origin
    #: Correction, side and the unit of an open drawing, each with where it comes from: a sentence to be shown.
    said: str
    #: Millimetres in one unit of an open drawing, and what says that.
    units_to_mm: float | None = None
    units_from: Origin | None = None
    #: URI of the ``wedm.toml`` that holds, if there is one.
    file: str | None = None
    #: Settings for single contours of this drawing, by the handle of an entity or by a point.
    contours: dict[str, dict[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True)
class Picture(Value):
    """Contours, faults and, where it can be made, the wire's path, as SVG. A notebook shows it as it is."""

    svg: str

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture beside ``path`` and renames it."""
        write_beside(Path(path), self.svg.encode("utf-8"))

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<Picture: SVG of {len(self.svg):,} characters>"

"""What the server answers, as typed values. Unknown keys of a newer server are passed over.

Points, radii and lengths are drawing units, except where a line says mm; angles are degrees.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, TypeVar, Union, get_origin

import cattrs
from cattrs.gen import make_dict_structure_fn, override

from .entities import Point
from .settings import Role, Side
from .shown import Rows, Tabled, Value, counted, listed, plain, table

Severity = Literal["error", "warning", "information", "hint"]
SegmentKind = Literal["line", "arc", "circle"]
Direction = Literal["ccw", "cw"]
PathSource = Literal["segment", "lead-in", "lead-out", "corner", "tab", "cut-off", "overlap"]
StepKind = Literal["line", "arc", "pause", "end", "rapid"]
CorrectionSource = Literal["default", "client", "file"]

SEVERITIES: dict[int, Severity] = {1: "error", 2: "warning", 3: "information", 4: "hint"}

T = TypeVar("T")


@dataclass(frozen=True)
class Diagnostic(Value):
    """A finding: the rule, its numbers, and the place.

    ``line`` and ``column`` count from 1 and are there for text documents; in a drawing ``handle`` and ``segment`` give the place.
    ``data`` holds all data of the finding in the protocol.
    """

    rule: str
    severity: Severity
    message: str
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    end_column: int | None = None
    page: str | None = None
    data: Mapping[str, Any] = field(default_factory=dict)

    @property
    def handle(self) -> str | None:
        """The entity's handle, for a finding on a segment."""
        handle = self.data.get("handle")
        return handle if isinstance(handle, str) else None

    @property
    def segment(self) -> int | None:
        """The segment's index in its entity: that of the vertex it starts in."""
        segment = self.data.get("segment")
        return segment if isinstance(segment, int) else None

    @property
    def radius(self) -> float | None:
        """The radius at fault."""
        return self._number("radius")

    @property
    def required(self) -> float | None:
        """The smallest radius that the wire can follow."""
        return self._number("required")

    def _number(self, key: str) -> float | None:
        value = self.data.get(key)
        return float(value) if isinstance(value, (int, float)) else None

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        named = {"severity": self.severity, "rule": self.rule, "line": self.line, "handle": self.handle, "segment": self.segment}
        return {**named, "radius": self.radius, "required": self.required, "message": self.message}

    def __repr__(self) -> str:
        return f"<{self}>"

    def __str__(self) -> str:
        place = f"line {self.line}: " if self.line is not None else ""
        if self.handle is not None:
            place += f"{self.handle} segment {self.segment}: " if self.segment is not None else f"{self.handle}: "
        return f"{self.severity}[{self.rule}] {place}{self.message}"


class Findings(Rows[Diagnostic]):
    """The findings of a document: a list, which a notebook shows as a table."""

    @property
    def errors(self) -> list[Diagnostic]:
        """The errors, which spoil the part: no program is made while there is one."""
        return [one for one in self if one.severity == "error"]

    @property
    def warnings(self) -> list[Diagnostic]:
        """The warnings, to be looked at before the part is cut."""
        return [one for one in self if one.severity == "warning"]

    def __str__(self) -> str:
        return "\n".join(map(str, self)) or "nothing found"


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
class Inspection(Tabled):
    """Every segment of a drawing with its radius and its verdict: the list of the "R minimum" tool."""

    units_to_mm: float
    entities: list[InspectedEntity]
    largest_wire: LargestWire | None = None

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
class Contours(Tabled):
    units_to_mm: float
    contours: list[Contour]

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
class Toolpath(Tabled):
    units_to_mm: float
    paths: list[WirePath]
    holes: list[StartHole] = field(default_factory=list)
    # Of a pair that of each part is in `parts`.
    work: Work | None = None
    parts: list[ToolpathPart] = field(default_factory=list)

    def rows(self) -> list[dict[str, Any]]:
        """A row for each path."""
        return [one.row() for one in self.paths]

    def __repr__(self) -> str:
        return f"<Toolpath: {counted(len(self.paths), 'path')}, {sum(one.length for one in self.paths) * self.units_to_mm:.3f} mm>"


@dataclass(frozen=True)
class Closure(Value):
    """The rounding of J in all arcs of a program, added up, µm; the path says where the machine stops."""

    x: float
    y: float


@dataclass(frozen=True)
class ControlOffset(Value):
    """The correction of one pass, mm, to be entered at the control that offsets the contour; ``register`` is the word of the program
    that says where the control finds it, such as ``D1``."""

    correction: float
    register: str | None = None


@dataclass(frozen=True)
class FinishedPart(Value):
    """What all passes leave along a drawing's contours: how much material stays at most, mm, and where, and how much is cut too deep, mm."""

    uncut: float
    at: Point
    overcut: float


@dataclass(frozen=True)
class Floor(Value):
    """How deep a milled floor lies, mm: its highest and its deepest place."""

    least: float
    most: float


@dataclass(frozen=True)
class MilledContour(Value):
    """The figures of milling one contour, mm: ``depth`` (the mean), ``floor`` and ``worn`` are simulated."""

    contour: str
    length: float
    #: By how much the electrode gets shorter in a layer, as a share of the layer's height.
    wear_of_layer: float
    feed: float
    last_feed: float
    fed: float
    depth: float
    floor: Floor
    worn: float
    #: Per mm of the path, where the wear is compensated linearly.
    feed_along: float | None = None


@dataclass(frozen=True)
class Milling(Value):
    """The layers of an electrode, mm, and the depth that they reach."""

    correction: float
    layers: int
    layer: float
    last_layer: float
    depth: float
    contours: list[MilledContour]


@dataclass(frozen=True)
class Program(Value):
    """A program for the machine, decoded again by the server before it was returned. ``length`` is mm, ``deviation`` µm."""

    text: str
    blocks: int
    length: float
    closure: Closure
    deviation: float = 0.0
    #: Where the wire is threaded first, drawing units; an electrode that mills is threaded nowhere.
    thread_hole: Point | None = None
    #: The length of the ways without a cut between contours, mm; ``length`` excludes them.
    jumps: float = 0.0
    finished: FinishedPart | None = None
    milling: Milling | None = None
    minutes: float | None = None
    holes: list[StartHole] = field(default_factory=list)
    work: Work | None = None
    #: What the control has to hold, one for each pass, where it offsets the contour.
    offsets: list[ControlOffset] = field(default_factory=list)
    warnings: list[Diagnostic] = field(default_factory=list)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the program beside ``path`` and renames it."""
        write_beside(Path(path), self.text.encode("utf-8"))

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        shown = {"blocks": self.blocks, "length": self.length, "deviation µm": self.deviation, "warnings": len(self.warnings)}
        left = {"uncut": self.finished.uncut, "overcut": self.finished.overcut} if self.finished is not None else {}
        return {**shown, **left}

    def __repr__(self) -> str:
        warned = counted(len(self.warnings), "warning") if self.warnings else ""
        lengths = [f"cut {self.length:.3f} mm", f"jumps {self.jumps:.3f} mm" if self.jumps else ""]
        said = listed([counted(self.blocks, "block"), *lengths, f"at most {self.deviation:.2f} µm from the path", warned])
        return f"<{type(self).__name__}: {said}>"

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class FitPlace(Value):
    """A place where clearance is missing: what is left, mm, below 0 where the parts bind; ``at`` is drawing units.

    ``of`` is the part that stands too far out: ``punch`` or ``plate``, or the name of a workpiece.
    """

    at: Point
    clearance: float
    handle: str
    segment: int
    of: str


@dataclass(frozen=True)
class FitAlone(Value):
    """A contour of a workpiece that has no partner."""

    handle: str
    of: str


@dataclass(frozen=True)
class Fit(Tabled):
    """Punch and plate as the wire leaves them, one laid in the other. ``clearance`` and ``least`` are mm a side."""

    fits: bool
    clearance: float
    least: float
    places: list[FitPlace]
    svg: str
    alone: list[FitAlone] = field(default_factory=list)

    def rows(self) -> list[dict[str, Any]]:
        """A row for each place where clearance is missing, and for each contour without a partner."""
        return [plain(one) for one in (*self.places, *self.alone)]

    def _repr_html_(self) -> str:
        return self.svg + (table(self.rows()) if self.places or self.alone else "")

    def __repr__(self) -> str:
        if not self.fits and not self.places:
            return f"<Fit: nothing compared, {counted(len(self.alone), 'contour')} without a partner>"
        said = "fits" if self.fits else "does not fit"
        return f"<Fit: {said}, {self.least:.4f} mm of {self.clearance:.4f} mm a side at the tightest, {counted(len(self.places), 'place')}>"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture beside ``path`` and renames it."""
        write_beside(Path(path), self.svg.encode("utf-8"))


@dataclass(frozen=True)
class PairProgram(Program):
    """The program of one part of a pair: ``punch``, ``plate``, ``stripper``, ``holder``, or the name of a workpiece."""

    part: str = ""
    # One for each pass, mm; below 0 for the passes on the other side of what is drawn, where not all run there.
    corrections: list[float] = field(default_factory=list)
    # The wire runs on the other side of what is drawn.
    other_side: bool = False

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        return {"part": self.part, "corrections": self.corrections, "other side": self.other_side, **super().row()}

    def __repr__(self) -> str:
        return f"<PairProgram of the {self.part}: {super().__repr__().partition(': ')[2]}"


@dataclass(frozen=True)
class PairPrograms(Value):
    programs: list[PairProgram]


@dataclass(frozen=True)
class SimulatedBlock(Value):
    """A block or word of a program and where it takes the machine; points and deviation are µm, ``line`` counts from 1.

    ``kind`` is ``line``, ``arc``, ``rapid``, ``pause`` or ``end``. ``end`` is where the machine gets to, ``ideal_end`` where the line or
    arc ends that the block means, ``deviation`` the distance between the two.
    """

    line: int
    kind: StepKind
    start: Point
    end: Point
    deviation: float
    contour: int
    number: int | None = None
    ideal_end: Point | None = None
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    # For an inclined wire.
    upper_end: Point | None = None


@dataclass(frozen=True)
class Bounds(Value):
    """A box, µm."""

    min: Point
    max: Point


@dataclass(frozen=True)
class Simulation(Tabled):
    """Where a program takes the machine. ``length`` is mm and the sum of ``cut`` and ``jumps``, ``deviation`` the largest of a block in µm."""

    blocks: list[SimulatedBlock]
    closure: Closure
    length: float
    #: The length that is cut, mm.
    cut: float = 0.0
    #: The length of the ways without a cut, mm.
    jumps: float = 0.0
    deviation: float = 0.0
    start_is_known: bool = False
    bounds: Bounds | None = None
    minutes: float | None = None

    def rows(self) -> list[dict[str, Any]]:
        """A row for each block."""
        return [plain(one) for one in self.blocks]

    def __repr__(self) -> str:
        takes = f"{self.minutes:.1f} minutes" if self.minutes is not None else ""
        jumps = f"jumps {self.jumps:.3f} mm" if self.jumps else ""
        return f"<Simulation: {listed([counted(len(self.blocks), 'block'), f'cut {self.cut:.3f} mm', jumps, takes])}>"


@dataclass(frozen=True)
class Located(Value):
    """Where a segment, or an entity, is written in a text. Lines and columns count from 1."""

    handle: str
    line: int
    column: int
    end_line: int
    end_column: int
    #: None: the place is of the entity, and of none of its segments.
    segment: int | None = None


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


@dataclass(frozen=True)
class Fixed(Tabled):
    """The findings of the document before and after the repairs."""

    before: Findings
    after: Findings

    def rows(self) -> list[dict[str, Any]]:
        """A row for each finding, those that are left after those that are gone."""
        gone = [one for one in self.before if one not in self.after]
        return [{"is": "repaired", **one.row()} for one in gone] + [{"is": "left", **one.row()} for one in self.after]

    def __repr__(self) -> str:
        return f"<Fixed: {len(self.before)} findings before, {len(self.after)} after>"

    @property
    def changed(self) -> bool:
        return self.before != self.after


def write_beside(path: Path, content: bytes) -> None:
    """Writes the content to a new file beside ``path`` and renames it: nobody ever reads half a file.

    Owner and rights of a file that stands there are kept, and a link stays a link.

    :raises OSError: it cannot be written, or not with that owner; nothing is changed then.
    """
    path = path.resolve()
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as beside:
            beside.write(content)
            beside.flush()
            os.fsync(beside.fileno())
        # A new file of `mkstemp` is for its owner only; take what the old one has, or the rights of any new file.
        old, own = path.stat() if path.exists() else None, os.stat(name)
        if old is not None and hasattr(os, "chown") and (old.st_uid, old.st_gid) != (own.st_uid, own.st_gid):
            os.chown(name, old.st_uid, old.st_gid)
        os.chmod(name, 0o666 & ~_umask() if old is None else old.st_mode & 0o7777)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def _umask() -> int:
    now = os.umask(0)
    os.umask(now)
    return now


# Where a key of the protocol is not the camelCase form of the field.
_KEYS = {("WirePath", "pass_number"): "pass", ("WorkCut", "pass_number"): "pass", ("Program", "text"): "program", ("PairProgram", "text"): "program"}


def _camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(word.capitalize() for word in rest)


def _is_literal(cls: Any) -> bool:
    return get_origin(cls) is Literal


@lru_cache(maxsize=1)
def _converter() -> cattrs.Converter:
    converter = cattrs.Converter()

    def structure(cls: type[Any]) -> Any:
        keys = {f.name: override(rename=_KEYS.get((cls.__name__, f.name), _camel(f.name))) for f in fields(cls)}
        return make_dict_structure_fn(cls, converter, **keys)  # type: ignore[arg-type]

    converter.register_structure_hook_factory(is_dataclass, structure)
    converter.register_structure_hook(Point, lambda value, _: Point(float(value[0]), float(value[1])))
    # A word that only a newer server knows is passed on.
    converter.register_structure_hook_func(_is_literal, lambda value, _: value)
    converter.register_structure_hook(Diagnostic, lambda value, _: diagnostic_from_json(value, None))
    return converter


def from_json(value: Any, cls: type[T]) -> T:
    """The value of the protocol as one of the types above."""
    return _converter().structure(value, cls)


TextLines = Union[list[bytes], None]


def diagnostic_from_json(value: Mapping[str, Any], lines: TextLines) -> Diagnostic:
    """A diagnostic of the protocol; ``lines`` are those of the text that it stands in, in UTF-8, None for a drawing."""
    place: dict[str, int] = {}
    if lines is not None:
        start, end = value["range"]["start"], value["range"]["end"]
        place = {
            "line": start["line"] + 1,
            "column": _column(lines, start),
            "end_line": end["line"] + 1,
            "end_column": _column(lines, end),
        }
    description = value.get("codeDescription") or {}
    return Diagnostic(
        rule=str(value.get("code", "")),
        severity=SEVERITIES.get(value.get("severity", 1), "error"),
        message=str(value["message"]),
        page=description.get("href"),
        data=value.get("data") or {},
        **place,
    )


def located_from_json(value: Mapping[str, Any], lines: list[bytes]) -> Located:
    """A place of the protocol in a text of these lines."""
    start, end = value["range"]["start"], value["range"]["end"]
    return Located(
        value["handle"], start["line"] + 1, _column(lines, start), end["line"] + 1, _column(lines, end), segment=value.get("segment")
    )


def _column(lines: list[bytes], position: Mapping[str, int]) -> int:
    line, character = position["line"], position["character"]
    if line >= len(lines):
        return character + 1
    return len(lines[line][:character].decode("utf-8", "replace")) + 1

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
from typing import Any, TypeVar, Union

import cattrs
from cattrs.gen import make_dict_structure_fn, override

from .entities import Point

SEVERITIES = {1: "error", 2: "warning", 3: "information", 4: "hint"}

T = TypeVar("T")


@dataclass(frozen=True)
class Diagnostic:
    """A finding: the rule, its numbers, and the place.

    ``line`` and ``column`` count from 1 and are there for text documents; in a drawing ``handle`` and ``segment`` say the place.
    ``data`` holds everything that the protocol says of the finding.
    """

    rule: str
    severity: str
    message: str
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    end_column: int | None = None
    page: str | None = None
    data: Mapping[str, Any] = field(default_factory=dict)

    @property
    def handle(self) -> str | None:
        """The entity's handle, of a finding on a segment."""
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

    def __str__(self) -> str:
        place = f"line {self.line}: " if self.line is not None else ""
        if self.handle is not None:
            place += f"{self.handle} segment {self.segment}: " if self.segment is not None else f"{self.handle}: "
        return f"{self.severity}[{self.rule}] {place}{self.message}"


@dataclass(frozen=True)
class Segment:
    """A line, arc or circle of an entity, with the names of the rules at fault or ``ok``."""

    index: int
    kind: str
    start: Point
    end: Point
    length: float
    verdict: str
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class InspectedEntity:
    handle: str
    type: str
    layer: str
    closed: bool
    cut: bool
    segments: list[Segment]


@dataclass(frozen=True)
class Inspection:
    """Every segment of a drawing with its radius and its verdict: the list of the "R minimum" tool."""

    units_to_mm: float
    entities: list[InspectedEntity]


@dataclass(frozen=True)
class ContourPiece:
    """A segment as the contour travels it; ``reversed`` is against its entity's own direction."""

    handle: str
    segment: int
    reversed: bool
    kind: str
    start: Point
    end: Point
    length: float
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None
    bulge: float | None = None


@dataclass(frozen=True)
class Gap:
    """Two ends that lay apart and were taken as one, behind the segment with index ``after``."""

    after: int
    distance: float


@dataclass(frozen=True)
class Contour:
    """``order`` is its place among the cuts, from 0; ``mark`` the start mark that leads to it."""

    closed: bool
    role: str
    length: float
    segments: list[ContourPiece]
    gaps: list[Gap]
    direction: str | None = None
    area: float | None = None
    order: int | None = None
    mark: Point | None = None


@dataclass(frozen=True)
class Contours:
    units_to_mm: float
    contours: list[Contour]


@dataclass(frozen=True)
class PathPiece:
    """A piece of the wire's path; ``source`` is ``lead-in``, ``segment``, ``corner`` or ``lead-out``."""

    source: str
    kind: str
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
class WirePath:
    """The way of the wire's centre along one contour. ``correction`` is mm."""

    contour: int
    correction: float
    thread_hole: Point
    length: float
    segments: list[PathPiece]
    # `pass` in the protocol.
    pass_number: int = 1
    # "ccw" or "cw" of a closed contour.
    direction: str | None = None


@dataclass(frozen=True)
class Toolpath:
    units_to_mm: float
    paths: list[WirePath]


@dataclass(frozen=True)
class Closure:
    """What a controller that counts J has drifted at the end of a program, µm."""

    x: float
    y: float


@dataclass(frozen=True)
class FinishedPart:
    """What all passes leave of a drawing's contours: mm that stay beyond them at most, and where, and mm cut beyond them."""

    uncut: float
    at: Point
    overcut: float


@dataclass(frozen=True)
class Program:
    """A program for the machine, decoded again by the server before it was handed out. ``length`` is mm, ``deviation`` µm."""

    text: str
    blocks: int
    length: float
    closure: Closure
    deviation: float = 0.0
    finished: FinishedPart | None = None
    warnings: list[Diagnostic] = field(default_factory=list)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the program beside ``path`` and renames it."""
        write_beside(Path(path), self.text.encode("utf-8"))

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class FitPlace:
    """A place where clearance is missing: what is left, mm, below 0 where the parts bind; ``at`` is drawing units.

    ``of`` is the part that stands too far out: ``punch`` or ``plate``, or the name of a workpiece.
    """

    at: Point
    clearance: float
    handle: str
    segment: int
    of: str


@dataclass(frozen=True)
class FitAlone:
    """A contour of a workpiece that has no partner."""

    handle: str
    of: str


@dataclass(frozen=True)
class Fit:
    """Punch and plate as the wire leaves them, one laid in the other. ``clearance`` and ``least`` are mm a side."""

    fits: bool
    clearance: float
    least: float
    places: list[FitPlace]
    svg: str
    alone: list[FitAlone] = field(default_factory=list)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture beside ``path`` and renames it."""
        write_beside(Path(path), self.svg.encode("utf-8"))


@dataclass(frozen=True)
class PairProgram(Program):
    """The program of one part of a pair: ``punch``, ``plate``, ``stripper``, ``holder``, or the name of a workpiece."""

    part: str = ""
    # Of each pass, mm.
    corrections: list[float] = field(default_factory=list)
    # The wire runs on the other side of what is drawn.
    other_side: bool = False


@dataclass(frozen=True)
class PairPrograms:
    programs: list[PairProgram]


@dataclass(frozen=True)
class SimulatedBlock:
    """A block or word of a program and where it takes the machine; points and deviation are µm, ``line`` counts from 1.

    ``kind`` is ``line``, ``arc``, ``rapid``, ``pause`` or ``end``. ``end`` is where the machine stops, ``ideal_end`` where the line or
    arc ends that the block means, ``deviation`` the way from one to the other.
    """

    line: int
    kind: str
    start: Point
    end: Point
    deviation: float
    contour: int
    number: int | None = None
    ideal_end: Point | None = None
    center: Point | None = None
    radius: float | None = None
    sweep: float | None = None


@dataclass(frozen=True)
class Bounds:
    """A box, µm."""

    min: Point
    max: Point


@dataclass(frozen=True)
class Simulation:
    """Where a program takes the machine. ``length`` is mm, ``deviation`` the largest of a block in µm."""

    blocks: list[SimulatedBlock]
    closure: Closure
    length: float
    deviation: float = 0.0
    start_is_known: bool = False
    bounds: Bounds | None = None
    minutes: float | None = None


@dataclass(frozen=True)
class Located:
    """Where a segment, or an entity, is written in a text. Lines and columns count from 1."""

    handle: str
    line: int
    column: int
    end_line: int
    end_column: int
    #: None: the place is of the entity, and of none of its segments.
    segment: int | None = None


@dataclass(frozen=True)
class SettingsInForce:
    """The correction that radii of a document are held against, mm, and which level of settings it comes from."""

    correction: float
    #: That of each pass.
    corrections: list[float]
    #: ``default``, ``client`` or ``file``.
    correction_from: str
    side: str
    #: URI of the ``wedm.toml`` that holds, if there is one.
    file: str | None = None


@dataclass(frozen=True)
class Picture:
    """Contours, faults and, where it can be made, the wire's path, as SVG. A notebook shows it as it is."""

    svg: str

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture beside ``path`` and renames it."""
        write_beside(Path(path), self.svg.encode("utf-8"))

    def _repr_svg_(self) -> str:
        return self.svg


@dataclass(frozen=True)
class Fixed:
    """What stood in the document before and after the repairs."""

    before: list[Diagnostic]
    after: list[Diagnostic]

    @property
    def changed(self) -> bool:
        return self.before != self.after


def write_beside(path: Path, content: bytes) -> None:
    """Writes the content to a new file beside ``path`` and renames it: nobody ever sees half a file.

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
_KEYS = {("WirePath", "pass_number"): "pass", ("Program", "text"): "program", ("PairProgram", "text"): "program"}


def _camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(word.capitalize() for word in rest)


@lru_cache(maxsize=1)
def _converter() -> cattrs.Converter:
    converter = cattrs.Converter()

    def structure(cls: type[Any]) -> Any:
        keys = {f.name: override(rename=_KEYS.get((cls.__name__, f.name), _camel(f.name))) for f in fields(cls)}
        return make_dict_structure_fn(cls, converter, **keys)  # type: ignore[arg-type]

    converter.register_structure_hook_factory(is_dataclass, structure)
    converter.register_structure_hook(Point, lambda value, _: Point(float(value[0]), float(value[1])))
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

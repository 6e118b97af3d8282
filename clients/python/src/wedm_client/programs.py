"""What the server answers about programs, pairs and milling.

Points, radii and lengths are drawing units, except where a line says mm; angles are degrees.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from .entities import Point
from .files import write_beside
from .findings import Diagnostic
from .results import StartHole, Work
from .shown import Listing, Tabled, Value, counted, listed, plain, table

StepKind = Literal["line", "arc", "pause", "end", "rapid"]


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
    #: How far arcs of the path's outline lie at most from the chords that they stand for, µm, under ``chord_fit``.
    off_chords: float | None = None
    finished: FinishedPart | None = None
    milling: Milling | None = None
    minutes: float | None = None
    #: How long the machine runs alone, what falls meanwhile and in which order it would run longest, in sentences.
    unattended: list[str] = field(default_factory=list)
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
class Simulation(Listing[SimulatedBlock]):
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

    def _listed(self) -> list[SimulatedBlock]:
        return self.blocks

    def rows(self) -> list[dict[str, Any]]:
        """A row for each block."""
        return [plain(one) for one in self.blocks]

    def __repr__(self) -> str:
        takes = f"{self.minutes:.1f} minutes" if self.minutes is not None else ""
        jumps = f"jumps {self.jumps:.3f} mm" if self.jumps else ""
        return f"<Simulation: {listed([counted(len(self.blocks), 'block'), f'cut {self.cut:.3f} mm', jumps, takes])}>"

"""The settings of wedm as typed dictionaries, and their form in the protocol. What they mean: docs/settings.md of wedm."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict, Union

Role = Literal["opening", "punch", "both", "left", "right", "line", "ignore"]
Side = Literal["both", "auto", "opening", "punch", "left", "right"]
Units = Literal["mm", "inch"]
RuleSeverity = Literal["error", "warning", "information", "hint", "off"]
Place = Union[Sequence[float], Mapping[str, Sequence[float]]]
"""A point (x, y) in mm, whatever unit the drawing is in, or a table of points by the handle of an entity of each contour."""


class Passes(TypedDict, total=False):
    """Several passes."""

    corrections: Sequence[float]
    gaps: Sequence[float]
    sequence: Literal["alternate", "one-way"]
    registers: Sequence[str]
    rates: Sequence[float]
    skim_corner: Literal["sharp", "constant-stock"]


class Job(TypedDict, total=False):
    """The workpiece."""

    thickness: float
    slug_limit: float
    machine_rate: float
    wires: Sequence[float]
    wire_gaps: Sequence[float]
    wire_rates: Sequence[float]
    title: str
    part: str
    material: str
    machine: str
    revision: str
    programmer: str


class Pair(TypedDict, total=False):
    """A punch and its plate."""

    drawn_as: Literal["punch", "plate"]
    clearance: float
    stripper: float
    holder: float


class MillingSettings(TypedDict, total=False):
    """Milling by an electrode."""

    tool_diameter: float
    gap: float
    layer: float
    depth: float
    wear: float
    wear_compensation: Literal["none", "uniform", "linear"]
    step: float
    slot_ends: bool


class ProgramSettings(TypedDict, total=False):
    """How a program is written."""

    format: Literal["3b", "4b", "iso", "milling"]
    layout: Literal["compact", "aligned", "checking"]
    header: bool
    direction: Literal["ccw", "cw", "as-drawn"]
    corner: Literal["arc", "intersection"]
    thread: Place
    entry: Place
    lead_in: float
    tab: Union[float, Mapping[str, float]]
    start_hole: float
    lead: Literal["straight", "perpendicular", "arc"]
    tab_stop: str
    closing_overlap: float
    order: Literal["as-drawn", "inside-first", "nearest", "as-picked"]
    common_line: bool
    jumps: Literal["blocks", "none"]
    compensation: Literal["path", "controller", "none"]
    digits: int
    units: Literal["mm", "inch"]
    whole_numbers: Literal["mm", "um"]
    drawing: str
    profile: str
    end: str
    pause: str
    pause_between_passes: str


class Profile(TypedDict, total=False):
    """How ISO programs are written for one kind of machine."""

    base: str
    coordinates: Literal["absolute", "incremental"]
    zero: Literal["drawing", "start"]
    unit: Literal["mm", "um"]
    decimals: int
    center: Literal["start-to-center", "center-to-start", "absolute"]
    full_circles: bool
    modal: bool
    spaces: bool
    numbers: int
    line_end: Literal["lf", "crlf"]
    begin: Sequence[str]
    register: str
    contour_begin: Sequence[str]
    contour_end: Sequence[str]
    pause: Sequence[str]
    pause_between_passes: Sequence[str]
    end: Sequence[str]


class ContourSettings(TypedDict, total=False):
    """Settings for one contour of one drawing."""

    side: Literal["opening", "punch", "both", "left", "right", "line", "ignore"]
    thread: Sequence[float]
    entry: Sequence[float]
    order: int


class DrawingSettings(TypedDict, total=False):
    """Settings for one drawing."""

    suppress: Mapping[str, Mapping[str, str]]
    contours: Mapping[str, ContourSettings]


class Settings(TypedDict, total=False):
    """Only what is set counts; lengths are mm, thread and entry are drawing units."""

    wire_diameter: float
    gap: float
    correction: float
    side: Literal["both", "auto", "opening", "punch", "left", "right"]
    units: Literal["mm", "inch"]
    margin: float
    resolution: float
    join: float
    layers: Mapping[str, Literal["opening", "punch", "both", "left", "right", "line", "ignore"]]
    linetypes: Mapping[str, Literal["opening", "punch", "both", "left", "right", "line", "ignore"]]
    contours: Mapping[str, Literal["opening", "punch", "both", "left", "right", "line", "ignore"]]
    colors: Mapping[str, Literal["opening", "punch", "both", "left", "right", "line", "ignore"]]
    drawings: Mapping[str, DrawingSettings]
    arc_fit: float
    chord_fit: float
    rules: Mapping[str, Literal["error", "warning", "information", "hint", "off"]]
    docs_url: str
    workpieces: Mapping[str, Sequence[str]]
    profiles: Mapping[str, Profile]
    passes: Passes
    job: Job
    pair: Pair
    milling: MillingSettings
    program: ProgramSettings


def to_json(settings: Settings) -> dict[str, Any]:
    """The settings with the keys of the protocol. Names of layers, rules and handles stay as they are.

    :raises ValueError: a number is not finite.
    """
    _check_finite("", settings)
    written = _camel(settings, {"passes", "program", "job", "pair", "milling"})
    if "profiles" in written:
        written["profiles"] = {name: _camel(profile, set()) for name, profile in written["profiles"].items()}
    if "drawings" in written:
        written["drawings"] = {name: _camel(drawing, set()) for name, drawing in written["drawings"].items()}
    return written


def _check_finite(key: str, value: Any) -> None:
    if isinstance(value, Mapping):
        for name, own in value.items():
            _check_finite(f"{key}.{name}" if key else str(name), own)
    elif isinstance(value, (list, tuple)):
        for own in value:
            _check_finite(key, own)
    elif isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{key} is {value}, expected a finite number")


def _camel(table: Mapping[str, Any], within: set[str]) -> dict[str, Any]:
    written = {}
    for key, value in table.items():
        if key in within and isinstance(value, Mapping):
            value = _camel(value, set())
        first, *rest = key.split("_")
        written[first + "".join(word.capitalize() for word in rest)] = value
    return written

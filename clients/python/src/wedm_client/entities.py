"""Entities of a drawing, and changes of them, as values. Nothing here knows a server.

Coordinates are drawing units, angles degrees counter-clockwise, a bulge is tan(sweep / 4), positive counter-clockwise.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from typing import Any, ClassVar, Literal, NamedTuple, Union

from .settings import Role


class Point(NamedTuple):
    x: float
    y: float


class Vertex(NamedTuple):
    """A vertex of a polyline with the bulge of the segment that starts in it; 0 is a line."""

    x: float
    y: float
    bulge: float = 0.0


def number(value: Any, name: str) -> float:
    """The number, as JSON can hold it.

    :raises ValueError: it is none, or not finite.
    """
    if isinstance(value, numbers.Real) and not isinstance(value, bool) and math.isfinite(value):
        return value if isinstance(value, (int, float)) else float(value)
    raise ValueError(f"{name} is {value!r}, expected a finite number")


#: False: the CAD program does not show the entity, and it is not cut. ``"off"`` and ``"frozen"`` are those of its layer, whose role brings it back.
Visible = Literal["off", "frozen"] | bool


@dataclass(frozen=True)
class _Entity:
    """How the CAD program shows it, which decides whether it is cut. What it takes from its layer or its block is theirs."""

    kind: ClassVar[str]
    _: KW_ONLY
    #: Name of the linetype; None is continuous.
    linetype: str | None = None
    #: It has the linetype from its layer: a role of the layer then counts for it all the same.
    linetype_by_layer: bool = False
    #: 1 to 255 of AutoCAD's colours, or ``"#rrggbb"``.
    color: int | str | None = None
    visible: Visible | None = None
    #: Its extended data (XDATA) of the application WEDM, such as ``"suppress gap: as the customer drew it"``.
    xdata: tuple[str, ...] = ()

    def _number(self, key: str) -> float:
        return number(getattr(self, key), f"entity {getattr(self, 'handle')}: {key}")

    def _radius(self) -> float:
        radius = self._number("radius")
        if radius <= 0:
            raise ValueError(f"entity {getattr(self, 'handle')}: radius is {radius!r}, expected a finite number above 0")
        return radius

    def _point(self, key: str) -> list[float]:
        point = getattr(self, key)
        name = f"entity {getattr(self, 'handle')}: {key}"
        if isinstance(point, str) or len(point) != 2:
            raise ValueError(f"{name} is {point!r}, expected two finite numbers")
        return [number(value, name) for value in point]

    def _json(self) -> dict[str, Any]:
        raise NotImplementedError

    def to_json(self) -> dict[str, Any]:
        """The entity as the protocol writes it.

        :raises ValueError: one of its numbers is not finite, or a radius is not above 0.
        """
        written: dict[str, Any] = {"handle": getattr(self, "handle"), "type": self.kind, **self._json()}
        for key in ("layer", "role", "linetype", "color", "visible"):
            value = getattr(self, key)
            if value is not None:
                written[key] = value
        if self.linetype is not None and self.linetype_by_layer:
            written["linetypeByLayer"] = True
        if self.xdata:
            written["xdata"] = list(self.xdata)
        return written


@dataclass(frozen=True)
class Polyline(_Entity):
    """A polyline of lines and arcs. Vertices may be given as (x, y) or (x, y, bulge)."""

    kind: ClassVar[str] = "polyline"
    vertices: tuple[Vertex, ...]
    closed: bool = True
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def __init__(
        self,
        vertices: Iterable[Sequence[float]],
        closed: bool = True,
        handle: str = "",
        layer: str | None = None,
        role: Role | None = None,
        **look: Any,
    ) -> None:
        own = {"vertices": tuple(Vertex(*vertex) for vertex in vertices), "closed": closed, "handle": handle, "layer": layer, "role": role}
        super().__init__(**look)
        for key, value in own.items():
            object.__setattr__(self, key, value)

    def _json(self) -> dict[str, Any]:
        name = f"entity {self.handle}: vertex"
        vertices = [[number(value, f"{name} {index}") for value in vertex] for index, vertex in enumerate(self.vertices)]
        return {"closed": self.closed, "vertices": vertices}


@dataclass(frozen=True)
class Line(_Entity):
    kind: ClassVar[str] = "line"
    start: tuple[float, float]
    end: tuple[float, float]
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def _json(self) -> dict[str, Any]:
        return {"start": self._point("start"), "end": self._point("end")}


@dataclass(frozen=True)
class Arc(_Entity):
    """An arc, counter-clockwise from ``start_angle`` to ``end_angle``, as in DXF."""

    kind: ClassVar[str] = "arc"
    center: tuple[float, float]
    radius: float
    start_angle: float
    end_angle: float
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def _json(self) -> dict[str, Any]:
        angles = {"startAngle": self._number("start_angle"), "endAngle": self._number("end_angle")}
        return {"center": self._point("center"), "radius": self._radius(), **angles}


@dataclass(frozen=True)
class Circle(_Entity):
    kind: ClassVar[str] = "circle"
    center: tuple[float, float]
    radius: float
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def _json(self) -> dict[str, Any]:
        return {"center": self._point("center"), "radius": self._radius()}


@dataclass(frozen=True)
class Text(_Entity):
    """A text; "O" beside a contour marks its thread hole."""

    kind: ClassVar[str] = "text"
    at: tuple[float, float]
    text: str
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def _json(self) -> dict[str, Any]:
        return {"at": self._point("at"), "text": self.text}


@dataclass(frozen=True)
class Mark(_Entity):
    """A POINT of a CAD program: it may mark a thread hole, as the text "O" does."""

    kind: ClassVar[str] = "point"
    at: tuple[float, float]
    handle: str = ""
    layer: str | None = None
    role: Role | None = None

    def _json(self) -> dict[str, Any]:
        return {"at": self._point("at")}


Entity = Union[Polyline, Line, Arc, Circle, Text, Mark]


def entity_from_json(written: Mapping[str, Any]) -> Entity:
    """The entity that the protocol's form names.

    :raises ValueError: a key is missing, or the type is none of the six.
    """
    common: dict[str, Any] = {key: written.get(key) for key in ("layer", "role", "linetype", "color", "visible")}
    common["linetype_by_layer"] = bool(written.get("linetypeByLayer"))
    common["xdata"] = tuple(written.get("xdata") or ())
    handle = str(written.get("handle", ""))
    try:
        match written.get("type"):
            case "polyline":
                return Polyline(written["vertices"], bool(written["closed"]), handle, **common)
            case "line":
                return Line(_pair(written["start"]), _pair(written["end"]), handle, **common)
            case "arc":
                return Arc(_pair(written["center"]), written["radius"], written["startAngle"], written["endAngle"], handle, **common)
            case "circle":
                return Circle(_pair(written["center"]), written["radius"], handle, **common)
            case "text":
                return Text(_pair(written["at"]), written["text"], handle, **common)
            case "point":
                return Mark(_pair(written["at"]), handle, **common)
            case other:
                raise ValueError(f"entity {handle!r} has type {other!r}, expected polyline, line, arc, circle, text or point")
    except KeyError as missing:
        raise ValueError(f"entity {handle!r} of type {written.get('type')!r} has no {missing}") from None


def _pair(point: Sequence[float]) -> tuple[float, float]:
    x, y = point
    return (x, y)


@dataclass(frozen=True)
class Splice:
    """Takes ``delete`` vertices out of the polyline from index ``start`` on and puts ``insert`` in their place.

    Moving one vertex is ``Splice("2A", i, 1, [(x, y, bulge)])``: it costs the edit, not the drawing.
    """

    handle: str
    start: int
    delete: int = 0
    insert: Sequence[Sequence[float]] = ()

    def to_json(self) -> dict[str, Any]:
        name = f"a vertex to insert in {self.handle}"
        inserted = [[number(value, name) for value in Vertex(*vertex)] for vertex in self.insert]
        return {"handle": self.handle, "vertices": {"start": self.start, "deleteCount": self.delete, "insert": inserted}}


@dataclass(frozen=True)
class Put:
    """Adds the entity, or replaces the one with its handle; ``before`` names the entity that a new one is put before."""

    entity: Entity
    before: str | None = None

    def to_json(self) -> dict[str, Any]:
        written: dict[str, Any] = {"handle": self.entity.handle, "entity": self.entity.to_json()}
        if self.before is not None:
            written["before"] = self.before
        return written


@dataclass(frozen=True)
class Delete:
    handle: str

    def to_json(self) -> dict[str, Any]:
        return {"handle": self.handle, "entity": None}


Change = Union[Splice, Put, Delete]


def change_from_json(written: Mapping[str, Any]) -> Change:
    """The change that the protocol's form names."""
    handle = str(written["handle"])
    splice = written.get("vertices")
    if splice is not None:
        return Splice(handle, splice["start"], splice["deleteCount"], tuple(Vertex(*vertex) for vertex in splice["insert"]))
    if written["entity"] is None:
        return Delete(handle)
    return Put(entity_from_json({**written["entity"], "handle": handle}), written.get("before"))


def with_handle(entity: Entity, handle: str) -> Entity:
    return replace(entity, handle=handle)

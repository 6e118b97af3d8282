"""Entities of ezdxf to entities of a drawing, and back after a repair. ezdxf itself is not needed to import this."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from .entities import Arc, Circle, Entity, Line, Mark, Polyline, Text, entity_from_json, with_handle
from .settings import Units


class UnsupportedUnits(ValueError):
    """The entities are in units that the drawing model of the protocol does not have."""


class UnsupportedEntity(ValueError):
    """An entity that the drawing model of the protocol does not have. As DXF text the server may well read it."""


#: What is drawn to be read: of a file the server takes no contour from it either, and says so.
_ANNOTATION = frozenset(
    ("ACAD_TABLE", "ARC_DIMENSION", "ATTDEF", "ATTRIB", "DGNUNDERLAY", "DIMENSION", "DWFUNDERLAY", "HATCH", "IMAGE", "LARGE_RADIAL_DIMENSION")
    + ("LEADER", "MLEADER", "MULTILEADER", "OLE2FRAME", "OLEFRAME", "PDFUNDERLAY", "RAY", "TOLERANCE", "VIEWPORT", "WIPEOUT", "XLINE")
)


def left_out(source: Iterable[Any]) -> dict[str, list[str]]:
    """The handles of the annotation of ezdxf in a list, by kind: :func:`entities_from` passes over it."""
    found: dict[str, list[str]] = {}
    for item in source:
        if _is_annotation(item):
            found.setdefault(item.dxftype(), []).append(str(item.dxf.handle or ""))
    return found


def _is_annotation(item: Any) -> bool:
    return is_ezdxf(item) and item.dxftype() in _ANNOTATION


def entities_from(source: Iterable[Any] | Any) -> tuple[list[Entity], dict[str, Any]]:
    """The entities of a list, and those of them that came from ezdxf, by handle.

    The list holds entities of this package, dictionaries of the protocol's form, lists of vertices (closed polylines) and entities
    of ezdxf, in any mixture; a single list of vertices is one closed polyline. An entity without a handle gets one: its number in the list.
    """
    items = list(source)
    if items and _is_vertex(items[0]):
        items = [items]
    entities: list[Entity] = []
    sources: dict[str, Any] = {}
    for number, item in enumerate(items, 1):
        if _is_annotation(item):
            continue
        entity = _entity(item, number)
        if not entity.handle:
            entity = with_handle(entity, str(number))
        if is_ezdxf(item):
            sources[entity.handle] = item
        entities.append(entity)
    return entities, sources


#: $INSUNITS of the units that the drawing model of the protocol has; 0 says nothing.
_UNITS: dict[int, Units | None] = {0: None, 1: "inch", 4: "mm"}


def units_of(sources: Iterable[Any]) -> Units | None:
    """The units of the documents that the entities of ezdxf belong to; None where none of them states any.

    :raises UnsupportedUnits: they are neither millimetres nor inches, or not the same for all.
    """
    documents = {id(entity.doc): entity.doc for entity in sources if getattr(entity, "doc", None) is not None}
    found = {int(document.units) for document in documents.values()}
    if len(found) > 1:
        raise UnsupportedUnits(f"the entities come from documents of different units ($INSUNITS {sorted(found)}), expected one; say units")
    for code in found:
        if code not in _UNITS:
            raise UnsupportedUnits(f"the document's unit is $INSUNITS {code}, expected 1 (inches) or 4 (millimetres); say units, or open the document")
        return _UNITS[code]
    return None


def is_ezdxf(item: Any) -> bool:
    return hasattr(item, "dxftype") and hasattr(item, "dxf")


def _is_vertex(item: Any) -> bool:
    if not isinstance(item, Sequence) or isinstance(item, str) or not 2 <= len(item) <= 3:
        return False
    return all(isinstance(number, (int, float)) for number in item)


def _entity(item: Any, number: int) -> Entity:
    if isinstance(item, (Polyline, Line, Arc, Circle, Text, Mark)):
        return item
    if isinstance(item, Mapping):
        return entity_from_json(item)
    if is_ezdxf(item):
        return _from_ezdxf(item)
    if isinstance(item, Iterable) and not isinstance(item, (str, bytes)):
        return Polyline(item)
    raise TypeError(f"item {number} is of type {type(item).__name__}, expected an entity, a dictionary, vertices or an entity of ezdxf")


_KNOWN = ("LWPOLYLINE", "POLYLINE", "LINE", "ARC", "CIRCLE", "TEXT", "MTEXT", "POINT")
#: What has world coordinates, whatever its extrusion is.
_IN_SPACE = ("LINE", "MTEXT", "POINT")
#: Flag of a vertex of POLYLINE: a control point of its frame.
_FRAME = 16
#: Values of colour, group code 62.
_BY_BLOCK, _BY_LAYER = 0, 256


def _look(entity: Any) -> dict[str, Any]:
    """How ezdxf's entity is shown: what it takes from its layer is the layer's."""
    document = entity.doc
    layer = document.layers.get(entity.dxf.layer) if document is not None and entity.dxf.layer in document.layers else None
    look: dict[str, Any] = {}
    linetype = str(entity.dxf.linetype)
    by_layer = linetype.upper() == "BYLAYER"
    if by_layer:
        linetype = str(layer.dxf.linetype) if layer is not None else ""
    if linetype.upper() not in ("", "CONTINUOUS", "BYBLOCK", "BYLAYER"):
        look.update(linetype=linetype, linetype_by_layer=by_layer)
    color = _color(entity)
    if color is None and layer is not None:
        color = _color(layer)
    if color is not None:
        look.update(color=color)
    if entity.dxf.get("invisible", 0):
        look.update(visible=False)
    elif layer is not None and layer.is_frozen():
        look.update(visible="frozen")
    elif layer is not None and layer.is_off():
        look.update(visible="off")
    if entity.has_xdata("WEDM"):
        look.update(xdata=tuple(str(tag.value) for tag in entity.get_xdata("WEDM") if tag.code == 1000))
    return look


def _color(shown: Any) -> int | str | None:
    """The colour that an entity or a layer has of its own; that of a layer is negative where the layer is off."""
    if shown.dxf.hasattr("true_color"):
        return f"#{shown.dxf.true_color & 0xFFFFFF:06x}"
    index = abs(int(shown.dxf.get("color", _BY_LAYER)))
    return index if _BY_BLOCK < index < _BY_LAYER else None


def _from_ezdxf(entity: Any) -> Entity:
    kind = entity.dxftype()
    handle = str(entity.dxf.handle or "")
    if kind not in _KNOWN:
        raise _unsupported(kind, handle)
    common: dict[str, Any] = {"handle": handle, "layer": str(entity.dxf.layer), **_look(entity)}
    # The plane of an entity that is seen from below is that of the drawing mirrored about the y axis.
    mirrored = kind not in _IN_SPACE and _is_seen_from_below(entity, kind, handle)
    sign = -1.0 if mirrored else 1.0

    def pair(point: Any) -> tuple[float, float]:
        return (sign * float(point[0]), float(point[1]))

    match kind:
        case "LWPOLYLINE":
            vertices = [(sign * x, y, sign * bulge) for x, y, bulge in entity.get_points("xyb")]
            return Polyline(vertices, bool(entity.closed), **common)
        case "POLYLINE" if entity.is_2d_polyline:
            # The frame of a spline is no part of it.
            drawn = [vertex for vertex in entity.vertices if not vertex.dxf.flags & _FRAME]
            bulged = [(*pair(vertex.dxf.location), sign * float(vertex.dxf.get("bulge", 0.0))) for vertex in drawn]
            return Polyline(bulged, bool(entity.is_closed), **common)
        case "LINE":
            return Line(pair(entity.dxf.start), pair(entity.dxf.end), **common)
        case "ARC":
            start, end = float(entity.dxf.start_angle), float(entity.dxf.end_angle)
            if mirrored:
                start, end = 180.0 - end, 180.0 - start
            return Arc(pair(entity.dxf.center), float(entity.dxf.radius), start, end, **common)
        case "CIRCLE":
            return Circle(pair(entity.dxf.center), float(entity.dxf.radius), **common)
        case "TEXT":
            # Aligned right, middle or above a line: the user has set the second point.
            is_set = entity.dxf.hasattr("align_point") and (entity.dxf.halign in (1, 2, 4) or entity.dxf.valign in (1, 2, 3))
            at = entity.dxf.align_point if is_set else entity.dxf.insert
            return Text(pair(at), str(entity.plain_text()).strip(), **common)
        case "MTEXT":
            return Text(pair(entity.dxf.insert), str(entity.plain_text()).strip(), **common)
        case "POINT":
            return Mark(pair(entity.dxf.location), **common)
    raise _unsupported(kind, handle)


def _unsupported(kind: str, handle: str) -> UnsupportedEntity:
    return UnsupportedEntity(
        f"{kind} {handle} is none of LWPOLYLINE, 2D POLYLINE, LINE, ARC, CIRCLE, TEXT, MTEXT, POINT: "
        "save the drawing and open the file, or open the ezdxf document as a whole"
    )


def _is_seen_from_below(entity: Any, kind: str, handle: str) -> bool:
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    if abs(x) > 1e-12 or abs(y) > 1e-12:
        raise UnsupportedEntity(f"{kind} {handle} lies in a tilted plane")
    return bool(z < 0)


def write_back_to(entities: Mapping[str, Entity], sources: Mapping[str, Any]) -> int:
    """Gives the ezdxf entities the geometry of the repaired ones; see :func:`wedm_client.write_back`."""
    changed = 0
    for handle, source in sources.items():
        if not source.is_alive:
            continue
        entity = entities.get(handle)
        if entity is None:
            source.destroy()
            changed += 1
        elif _from_ezdxf(source)._json() != entity._json():
            _write(entity, source)
            changed += 1
    return changed


def _write(entity: Entity, source: Any) -> None:
    kind = source.dxftype()
    sign = -1.0 if kind not in _IN_SPACE and _is_seen_from_below(source, kind, entity.handle) else 1.0
    match entity, kind:
        case Polyline(vertices=vertices), "LWPOLYLINE":
            source.set_points([(sign * x, y, sign * bulge) for x, y, bulge in vertices], format="xyb")
        case Polyline(vertices=vertices), "POLYLINE":
            while len(source.vertices) > len(vertices):
                source.vertices.pop().destroy()
            if len(source.vertices) < len(vertices):
                source.append_formatted_vertices([(0, 0)] * (len(vertices) - len(source.vertices)), format="xy")
            elevation = source.dxf.elevation.z if source.dxf.hasattr("elevation") else 0.0
            for (x, y, bulge), vertex in zip(vertices, source.vertices, strict=True):
                vertex.dxf.location = (sign * x, y, elevation)
                vertex.dxf.bulge = sign * bulge
        case Line(start=start, end=end), "LINE":
            source.dxf.start = (*start, source.dxf.start.z)
            source.dxf.end = (*end, source.dxf.end.z)
        case Arc(center=(x, y), radius=radius, start_angle=start_angle, end_angle=end_angle), "ARC":
            if sign < 0:
                start_angle, end_angle = 180.0 - end_angle, 180.0 - start_angle
            source.dxf.center = (sign * x, y, source.dxf.center.z)
            source.dxf.radius, source.dxf.start_angle, source.dxf.end_angle = radius, start_angle, end_angle
        case Circle(center=(x, y), radius=radius), "CIRCLE":
            source.dxf.center = (sign * x, y, source.dxf.center.z)
            source.dxf.radius = radius
        case _:
            raise UnsupportedEntity(f"{kind} {entity.handle} became a {entity.kind}: take it from Drawing.entities")

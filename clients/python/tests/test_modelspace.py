"""What decides in a CAD program whether something is cut, one thing after the other: a modelspace says the same as its document."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from ezdxf.document import Drawing as Dxf
from ezdxf.filemanagement import new

from wedm_client import Drawing, Server, UnsupportedEntity

from .plates import QUARTER, TIGHT
from .test_both_routes import _cut, _faults, _program, _roles


def _square(document: Dxf, at: float, **looks: object) -> None:
    corners = [(at, 0), (at + 8, 0), (at + 8, 8), (at, 8)]
    document.modelspace().add_lwpolyline(corners, close=True, dxfattribs=dict(looks))


def _linetypes(document: Dxf) -> None:
    document.layers.add("AXES", linetype="CENTER")
    document.layers.add("EDGES", linetype="HIDDEN2")
    for index, looks in enumerate([{"linetype": "DASHED"}, {"layer": "AXES"}, {"layer": "AXES", "linetype": "CONTINUOUS"}, {"layer": "EDGES"}, {"linetype": "BYBLOCK"}]):
        _square(document, 10 * index, **looks)


def _colours(document: Dxf) -> None:
    document.layers.add("RED", color=1)
    document.layers.add("BLUE", true_color=0x0000FF)
    looks: list[dict[str, object]] = [{"color": 1}, {"layer": "RED"}, {"layer": "RED", "color": 30}, {"layer": "BLUE"}, {"true_color": 0x123456}, {"color": 0}]
    for index, look in enumerate(looks):
        _square(document, 10 * index, **look)


def _layers(document: Dxf) -> None:
    document.layers.add("FROZEN").freeze()
    document.layers.add("OFF").off()
    document.layers.add("LOCKED").lock()
    document.layers.add("NOT_PLOTTED").dxf.plot = 0
    for index, layer in enumerate(["FROZEN", "OFF", "LOCKED", "NOT_PLOTTED", "DEFPOINTS", "NOWHERE"]):
        _square(document, 10 * index, layer=layer)
    _square(document, 70, invisible=1)
    document.layout("Layout1").add_circle((5, 5), 3)


def _inches(document: Dxf) -> None:
    document.units = 1
    document.modelspace().add_lwpolyline([(0, 0), (0.797, 0, QUARTER), (0.8, 0.003), (0.8, 0.4), (0, 0.4)], format="xyb", close=True)


def _variables(document: Dxf) -> None:
    document.units = 0
    for name, value in (("$MEASUREMENT", 0), ("$LTSCALE", 25.0), ("$PSLTSCALE", 0), ("$LUNITS", 4), ("$CLAYER", "0"), ("$CECOLOR", 3), ("$PDMODE", 35), ("$ANGDIR", 1)):
        document.header[name] = value
    document.modelspace().add_lwpolyline([vertex if len(vertex) == 3 else (*vertex, 0) for vertex in TIGHT], format="xyb", close=True)
    document.modelspace().add_arc((40, 5), 3, 0, 360)


def _annotation(document: Dxf) -> None:
    space = document.modelspace()
    _square(document, 0)
    space.add_linear_dim(base=(0, -3), p1=(0, 0), p2=(8, 0)).render()
    space.add_hatch().paths.add_polyline_path([(0, 0), (8, 0), (8, 8)])
    space.add_leader([(0, 0), (3, 3), (6, 3)])
    space.add_xline((0, 0), (1, 1))


@pytest.mark.parametrize("draw", [_linetypes, _colours, _layers, _inches, _variables, _annotation])
def test_a_modelspace_is_what_its_document_is(server: Server, draw: Callable[[Dxf], None]) -> None:
    document = new(setup=True, units=4)
    draw(document)
    drawing, text = server.open(document.modelspace()), server.open(document)
    assert _cut(server, drawing) == _cut(server, text)
    assert server.inspect(drawing).units_to_mm == server.inspect(text).units_to_mm
    assert _faults(server, drawing, True) == _faults(server, text, True)
    for options in _roles(document):
        assert _program(server, drawing, options) == _program(server, text, options), options


def test_annotation_is_left_out_and_named(server: Server) -> None:
    document = new(setup=True, units=4)
    _annotation(document)
    drawing = server.open(document.modelspace())
    assert isinstance(drawing, Drawing)
    assert {kind: len(handles) for kind, handles in drawing.left_out.items()} == {"DIMENSION": 1, "HATCH": 1, "LEADER": 1, "XLINE": 1}
    assert len(drawing) == 1


def test_a_block_is_refused_by_name_and_cut_by_the_document(server: Server) -> None:
    document = new(units=4)
    block = document.blocks.new("HOLE")
    block.add_circle((0, 0), 3)
    insert = document.modelspace().add_blockref("HOLE", (10, 10))
    with pytest.raises(UnsupportedEntity, match=f"INSERT {insert.dxf.handle} is none of .* open the ezdxf document as a whole"):
        server.open(document.modelspace())
    (hole,) = server.contours(server.open(document)).contours
    assert hole.closed and hole.segments[0].handle == insert.dxf.handle

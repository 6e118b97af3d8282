"""Entities of ezdxf, there and back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from ezdxf.filemanagement import new, readfile
from ezdxf.layouts.layout import Modelspace

from wedm_client import Drawing, Server, UnsupportedEntity, UnsupportedUnits, check_many, write_back

from .plates import QUARTER, TIGHT

BELOW = {"extrusion": (0, 0, -1)}


def _lw(space: Modelspace) -> None:
    space.add_lwpolyline([(x, y, b[0] if b else 0) for x, y, *b in TIGHT], format="xyb", close=True, dxfattribs={"layer": "DIE", "color": 3})


def _lw_from_below(space: Modelspace) -> None:
    points = [(-x, y, -(b[0] if b else 0)) for x, y, *b in TIGHT]
    space.add_lwpolyline(points, format="xyb", close=True, dxfattribs=BELOW)


def _heavy(space: Modelspace) -> None:
    space.add_polyline2d([(x, y, b[0] if b else 0) for x, y, *b in TIGHT], format="xyb", close=True)


def _loose(space: Modelspace) -> None:
    space.add_line((0, 0), (19.92, 0))
    space.add_arc((19.92, 0.08), 0.08, 270, 360)
    for start, end in [((20, 0.08), (20, 10)), ((20, 10), (0, 10)), ((0, 10), (0, 0))]:
        space.add_line(start, end)


def _loose_from_below(space: Modelspace) -> None:
    space.add_line((0, 0), (19.92, 0))
    space.add_arc((-19.92, 0.08), 0.08, 180, 270, dxfattribs=BELOW)
    for start, end in [((20, 0.08), (20, 10)), ((20, 10), (0, 10)), ((0, 10), (0, 0))]:
        space.add_line(start, end)


@pytest.mark.parametrize("draw", [_lw, _lw_from_below, _heavy, _loose, _loose_from_below])
def test_there_and_back(server: Server, tmp_path: Path, draw: Callable[[Modelspace], None]) -> None:
    document = new(units=4)
    draw(document.modelspace())
    handles = [entity.dxf.handle for entity in document.modelspace()]
    drawing = server.open(document.modelspace(), units="mm")
    assert isinstance(drawing, Drawing)
    (fault,) = [one for one in server.diagnostics(drawing) if one.severity == "error"]
    assert fault.rule == "small-radius" and fault.handle in handles and fault.radius == pytest.approx(0.08)
    # As the server reads the same drawing from DXF text.
    as_text = server.open(document)
    (same,) = [one for one in server.diagnostics(as_text) if one.severity == "error"]
    assert (same.handle, same.segment) == (fault.handle, fault.segment)
    assert same.data["center"] == pytest.approx(fault.data["center"])

    server.fix(drawing)
    changed = write_back(drawing)
    assert changed == (1 if len(handles) == 1 else 3)
    assert [entity.dxf.handle for entity in document.modelspace()] == handles
    document.saveas(tmp_path / "fixed.dxf")
    (checked,) = check_many(tmp_path / "fixed.dxf")
    assert checked.ok, checked
    assert not readfile(tmp_path / "fixed.dxf").audit().has_errors


def test_what_is_not_repaired_stays(server: Server) -> None:
    document = new(units=4)
    _lw(document.modelspace())
    (polyline,) = document.modelspace()
    drawing = server.open([polyline])
    assert isinstance(drawing, Drawing)
    server.fix(drawing)
    write_back(drawing)
    assert (polyline.dxf.layer, polyline.dxf.color, polyline.closed) == ("DIE", 3, True)  # type: ignore[attr-defined]
    points = list(polyline.get_points("xyb"))  # type: ignore[attr-defined]
    assert points[3:] == [(20, 10, 0), (0, 10, 0)] and points[1][2] == pytest.approx(QUARTER)
    assert write_back(drawing) == 0


def _spline(space: Modelspace) -> Any:
    return space.add_spline([(0, 0), (1, 1), (2, 0)])


def _tilted(space: Modelspace) -> Any:
    return space.add_circle((0, 0), 1, dxfattribs={"extrusion": (0, 1, 1)})


@pytest.mark.parametrize(("draw", "said"), [(_spline, "SPLINE .* open the file"), (_tilted, "lies in a tilted plane")])
def test_what_has_no_place_in_a_drawing_is_said(server: Server, draw: Callable[[Modelspace], Any], said: str) -> None:
    document = new(units=4)
    draw(document.modelspace())
    with pytest.raises(UnsupportedEntity, match=said):
        server.open(document.modelspace())


def test_a_mark_chooses_the_thread_hole(server: Server) -> None:
    document = new(units=4)
    document.modelspace().add_circle((5, 5), 4)
    document.modelspace().add_text("O", dxfattribs={"insert": (6, 5)})
    document.modelspace().add_mtext("a note", dxfattribs={"insert": (60, 5)})
    (path,) = server.toolpath(server.open(document.modelspace()), {"side": "opening"}).paths
    assert path.thread_hole == (6, 5)


@pytest.mark.parametrize(("units", "expected"), [(4, 1.0), (1, 25.4), (0, 1.0)])
def test_the_unit_of_the_document_holds(server: Server, units: int, expected: float) -> None:
    space = new(units=units).modelspace()
    _lw(space)
    assert server.inspect(server.open(space)).units_to_mm == expected
    assert server.inspect(server.open(list(space))).units_to_mm == expected
    assert server.inspect(server.open(space, units="inch")).units_to_mm == 25.4


def test_a_unit_that_cannot_be_said_is_refused(server: Server) -> None:
    metres, inches = new(units=6).modelspace(), new(units=1).modelspace()
    # Handles are counted in each document by itself.
    inches.add_point((0, 0))
    for space in (metres, inches):
        _lw(space)
    with pytest.raises(UnsupportedUnits, match=r"\$INSUNITS 6, expected 1 \(inches\) or 4 \(millimetres\)"):
        server.open(metres)
    with pytest.raises(UnsupportedUnits, match="different units"):
        server.open([*metres, *inches.query("LWPOLYLINE")])
    assert server.inspect(server.open(metres, units="mm")).units_to_mm == 1.0

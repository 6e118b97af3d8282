"""Drawings without text behind them: opened from all that they can be opened from, edited, asked, repaired."""

from __future__ import annotations

import math
from typing import Any, get_args

import pytest

from wedm_client import (
    Arc,
    Change,
    Circle,
    Delete,
    DoesNotApply,
    Drawing,
    Line,
    NotOpen,
    Outdated,
    Polyline,
    ProgramFormat,
    Put,
    Refused,
    RequestFailed,
    Server,
    Splice,
    Text,
    WireFormat,
)

from .plates import QUARTER, ROUND, TIGHT


def errors(server: Server, drawing: Any) -> list[str]:
    """The errors of a drawing, as `handle segment rule`."""
    found = server.diagnostics(drawing)
    return [f"{one.handle} {one.segment} {one.rule}" for one in found if one.severity == "error"]


def drawing_of(server: Server, source: Any) -> Drawing:
    drawing = server.open(source)
    assert isinstance(drawing, Drawing)
    return drawing


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        pytest.param(TIGHT, ["1 1 small-radius"], id="one list of vertices"),
        pytest.param([TIGHT, [(x + 30, *rest) for x, *rest in TIGHT]], ["1 1 small-radius", "2 1 small-radius"], id="lists of vertices"),
        pytest.param([Polyline(TIGHT, handle="2A")], ["2A 1 small-radius"], id="an entity"),
        pytest.param([Polyline(ROUND, handle="2A")], [], id="nothing wrong"),
        pytest.param([Circle((0, 0), 0.05), Circle((9, 9), 3.0)], ["1 0 small-radius"], id="circles"),
        pytest.param([{"type": "circle", "handle": "C", "center": [0, 0], "radius": 0.05}], ["C 0 small-radius"], id="a dictionary"),
        pytest.param(
            [
                Line((0, 0), (19.92, 0), "A"),
                Arc((19.92, 0.08), 0.08, 270, 360, "B"),
                Line((20, 0.08), (20, 10), "C"),
                Line((20, 10), (0, 0), "D"),
            ],
            ["B 0 small-radius"],
            id="lines and an arc",
        ),
        pytest.param([Line((0, 0), (1, 0), "A")], ["A 0 open-contour"], id="an open contour"),
        pytest.param([], [], id="nothing"),
    ],
)
def test_drawings_from_lists(server: Server, source: Any, expected: list[str]) -> None:
    assert errors(server, server.open(source)) == expected


@pytest.mark.parametrize(
    ("source", "error", "said"),
    [
        ([Circle((0, 0), 1, "A"), Circle((5, 5), 1, "A")], ValueError, "1 entities have a handle that another one has"),
        ([42], TypeError, "item 1 is of type int"),
        ([{"type": "spline", "handle": "S"}], ValueError, "'S' has type 'spline', expected polyline"),
        ([{"type": "circle", "handle": "C", "radius": 1}], ValueError, "'C' of type 'circle' has no 'center'"),
        ("no such file.dxf", FileNotFoundError, "no such file.dxf"),
    ],
)
def test_what_is_no_drawing(server: Server, source: Any, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        server.open(source)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ([Splice("2A", 1, 2, [(19.0, 0.0, QUARTER), (20.0, 1.0)])], []),
        ([Splice("2A", 1, 2, [(19.95, 0.0, QUARTER), (20.0, 0.05)])], ["2A 1 small-radius"]),
        ([Put(Polyline(ROUND, handle="2A"))], []),
        ([Put(Circle((40, 5), 0.04, "C"))], ["2A 1 small-radius", "C 0 small-radius"]),
        ([Put(Circle((40, 5), 0.04, "C"), before="2A")], ["C 0 small-radius", "2A 1 small-radius"]),
        ([Delete("2A")], []),
        ([Put(Circle((40, 5), 0.04, "C")), Delete("2A"), Delete("C")], []),
    ],
)
def test_changes(server: Server, changes: list[Change], expected: list[str]) -> None:
    drawing = drawing_of(server, [Polyline(TIGHT, handle="2A")])
    assert errors(server, drawing) == ["2A 1 small-radius"]
    server.change(drawing, changes)
    assert sorted(errors(server, drawing)) == sorted(expected)
    # What is held here is what the server holds: telling it again changes nothing.
    afresh = server.open(drawing.entities, uri="cad:afresh")
    assert sorted(errors(server, afresh)) == sorted(expected)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([Delete("2B")], "change 1 of 1: there is no entity 2B"),
        ([Splice("2A", 4, 2)], "2A has 5 vertices, expected a range in them, found 4 to 6"),
        ([Splice("C", 0, 1)], "C is a circle, and only polylines have vertices"),
        ([Delete("C"), Delete("C")], "change 2 of 2: there is no entity C"),
        ([Put(Circle((0, 0), 1, "D"), before="E")], "there is no entity E to put D before"),
        ([Put(Circle((0, 0), 1))], "the entity has no handle"),
    ],
)
def test_changes_that_do_not_apply_change_nothing(server: Server, changes: list[Change], said: str) -> None:
    drawing = drawing_of(server, [Polyline(TIGHT, handle="2A"), Circle((40, 5), 5, "C")])
    before = (drawing.entities, drawing.version)
    with pytest.raises(DoesNotApply, match=said):
        server.change(drawing, changes)
    assert (drawing.entities, drawing.version) == before
    assert errors(server, drawing) == ["2A 1 small-radius"]


def test_a_drawing_that_is_not_sound_is_asked_for_again_and_never_accepted(server: Server) -> None:
    drawing = drawing_of(server, [Circle((0, 0), 5, "C")])
    server.change(drawing, Put(Circle((0, 0), 4, "C")))
    with pytest.raises(ValueError, match="radius is nan"):
        server.change(drawing, Put(Circle((0, 0), math.nan, "C")))
    server.change(drawing, Put(Circle((0, 0), 4, "C", role="inside")))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="inside"):
        server.diagnostics(drawing)
    server.change(drawing, Put(Circle((0, 0), 3, "C")))
    assert server.inspect(drawing).entities[0].segments[0].radius == 3


def test_everything_that_can_be_asked(server: Server) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A", role="opening", layer="DIE"), Text((10, 5), "O")])
    (entity,) = server.inspect(drawing).entities
    assert (entity.type, entity.layer, entity.closed, len(entity.segments)) == ("LWPOLYLINE", "DIE", True, 5)
    assert entity.segments[1].radius == pytest.approx(2.0)
    assert server.inspect(drawing, "2A").entities == [entity]

    (contour,) = server.contours(drawing).contours
    assert (contour.closed, contour.role, contour.direction, contour.gaps) == (True, "opening", "ccw", [])
    assert contour.area == pytest.approx(20 * 10 - 4 + math.pi)

    (path,) = server.toolpath(drawing).paths
    assert path.correction == 0.1
    assert path.thread_hole == (10, 5)
    assert [path.segments[0].source, path.segments[-1].source] == ["lead-in", "lead-out"]
    assert sum(piece.length for piece in path.segments) == pytest.approx(path.length)

    program = server.generate(drawing, "3b", handles=["2A"], options={"program": {"layout": "checking", "lead_in": 2.0}})
    assert program.text.rstrip().endswith("DD") and "Start Point = 10" in program.text
    assert program.blocks > 6 and abs(program.closure.x) < 2 and program.deviation < 1.5
    # What was written closes: the path is as long as what was planned.
    assert program.length == pytest.approx(path.length, abs=0.01)

    picture = server.picture(drawing)
    assert picture.svg.startswith("<svg") and picture._repr_svg_() == picture.svg == drawing._repr_svg_()


def test_options_of_a_request_hold_for_it_only(server: Server) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A")])
    inside = server.toolpath(drawing, {"side": "opening", "correction": 1.0}).paths[0]
    outside = server.toolpath(drawing, {"side": "punch", "correction": 1.0}).paths[0]
    assert inside.length < 60 < outside.length and inside.correction == 1.0
    with pytest.raises(Refused, match="is not known"):
        server.toolpath(drawing)


def test_errors_refuse_a_program_and_force_gets_it(server: Server) -> None:
    drawing = server.open([Polyline(TIGHT, handle="2A")])
    with pytest.raises(Refused) as refused:
        server.generate(drawing, options={"side": "punch", "rules": {"open-contour": "error"}, "correction": 0.1, "layers": {"0": "opening"}})
    assert [one.rule for one in refused.value.diagnostics] == ["small-radius"]
    assert refused.value.code == -32803


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda server, drawing: server.generate(drawing, "9b"), 'format is "9b"'),
        (lambda server, drawing: server.inspect(drawing, "99"), "99"),
        (lambda server, drawing: server.toolpath(drawing, {"correction": -1}), "correction"),
    ],
)
def test_wrong_questions(server: Server, ask: Any, said: str) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A")])
    with pytest.raises(RequestFailed, match=said) as failed:
        ask(server, drawing)
    assert failed.value.code == -32602


def test_fix_all_and_the_numbers_it_leaves_alone(server: Server) -> None:
    drawing = drawing_of(server, [Polyline(TIGHT, handle="2A"), Polyline([(x, y + 20, *b) for x, y, *b in TIGHT], handle="2B")])
    fixed = server.fix(drawing)
    assert fixed.changed and [one.severity for one in fixed.before].count("error") == 2
    assert all(one.severity != "error" for one in fixed.after)
    for handle, lift in [("2A", 0), ("2B", 20)]:
        repaired = drawing[handle]
        assert isinstance(repaired, Polyline)
        assert [(x, y - lift) for x, y, _ in repaired.vertices] == [(0, 0), (pytest.approx(19.899), 0), (20, pytest.approx(0.101)), (20, 10), (0, 10)]
        assert repaired.vertices[1].bulge == pytest.approx(QUARTER)
    assert not server.fix(drawing).changed


def test_one_finding_is_repaired_and_its_neighbour_is_not(server: Server) -> None:
    drawing = server.open([Polyline(TIGHT, handle="2A"), Polyline([(x, y + 20, *b) for x, y, *b in TIGHT], handle="2B")])
    (wanted,) = [one for one in server.diagnostics(drawing) if one.handle == "2B" and one.severity == "error"]
    offered = server.actions(drawing, wanted)
    assert [action.preferred for action in offered] == [True, False]
    server.fix(drawing, wanted)
    assert errors(server, drawing) == ["2A 1 small-radius"]


def test_a_repair_for_an_older_version_is_refused_and_changes_nothing(server: Server) -> None:
    """What undo in a CAD program does while a repair is on its way."""
    drawing = drawing_of(server, [Polyline(TIGHT, handle="2A")])
    (action, *_) = server.actions(drawing, server.diagnostics(drawing)[0])
    server.change(drawing, Put(Polyline(ROUND, handle="2A")))
    before = (drawing.entities, drawing.version)
    with pytest.raises(Outdated, match="made for version 1 of .* now at 2"):
        server.apply(action)
    assert (drawing.entities, drawing.version) == before
    assert errors(server, drawing) == []


def test_closed_documents_are_not_asked_about(server: Server) -> None:
    drawing = server.open([Polyline(TIGHT, handle="2A")], uri="cad:plate")
    with pytest.raises(ValueError, match="cad:plate is open already"):
        server.open([], uri="cad:plate")
    server.close_document(drawing)
    server.close_document(drawing)
    for ask in (server.diagnostics, server.inspect, server.fix):
        with pytest.raises(NotOpen, match="cad:plate is not open"):
            ask(drawing)
    assert errors(server, server.open([Polyline(ROUND, handle="2A")], uri="cad:plate")) == []


def test_inch(server: Server) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A")], units="inch")
    assert server.inspect(drawing).units_to_mm == 25.4


def test_an_electrode_mills_a_slot(server: Server) -> None:
    slot = drawing_of(server, [Line((0, 0), (10, 0), "2A")])
    made = server.generate(slot, "milling", options={"milling": {"tool_diameter": 1, "gap": 0.05, "layer": 0.01, "depth": 0.2, "wear": 0.02}})
    assert made.milling is not None and made.thread_hole is None
    assert made.milling.layers == 20
    (contour,) = made.milling.contours
    assert contour.depth == pytest.approx(0.2010, abs=6e-5)
    assert contour.feed == pytest.approx(0.0128011, abs=1e-7)
    assert contour.floor.least == pytest.approx(0.1997, abs=6e-5)
    assert "G01 Z-0.013" in made.text
    with pytest.raises(Refused, match="milling.tool-diameter"):
        server.generate(slot, "milling")


def test_formats_are_those_of_the_server(server: Server) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A", role="opening")])
    with pytest.raises(RequestFailed) as refused:
        server.generate(drawing, "gcode")  # type: ignore[arg-type]
    named = str(refused.value)
    assert all(f"{format}" in named for format in get_args(ProgramFormat)), named
    assert set(get_args(WireFormat)) == set(get_args(ProgramFormat)) - {"milling"}


def test_start_holes_for_the_drill(server: Server) -> None:
    drawing = server.open([Polyline(ROUND, handle="2A", role="opening")], uri="cad:plate")
    rows = server.holes(drawing, options={"program": {"start_hole": 2.0}}).decode().splitlines()
    assert rows[0] == "drawing,x_mm,y_mm,diameter_mm,contour,hole,number"
    assert rows[1].startswith("cad:plate,") and rows[1].endswith(",2,2A,found,1") and len(rows) == 2
    drawn = server.open_text(server.holes(drawing, "dxf", {"program": {"start_hole": 2.0}}).decode())
    assert "START-HOLES" in drawn.text
    assert len(server.contours(drawn).contours) == 1, "holes are drilled, not cut"

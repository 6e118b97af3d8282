"""Programs turned into something else, and places in texts; every method of the protocol has its call."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from wedm_client import Action, Arc, Circle, Line, Outdated, Polyline, Put, Refused, RequestFailed, Server, Settings, TextDocument
from wedm_client.documents import program_of

from .plates import ROUND, TIGHT


@pytest.fixture
def hole(server: Server, data: Path) -> TextDocument:
    document = server.open(data / "hole.3b")
    assert isinstance(document, TextDocument)
    return document


def text_of(server: Server, path: Path) -> TextDocument:
    document = server.open(path)
    assert isinstance(document, TextDocument)
    return document


def test_a_program_becomes_a_drawing_and_another_program(server: Server, hole: TextDocument) -> None:
    drawing = server.open_text(server.convert(hole, "dxf"))
    arcs = [segment for entity in server.inspect(drawing).entities for segment in entity.segments if segment.radius]
    assert [arc.radius for arc in arcs] == [pytest.approx(9.9, abs=0.002)] * len(arcs)
    assert sum(arc.sweep or 0 for arc in arcs) == pytest.approx(360, abs=0.1)
    iso = server.open_text(server.convert(hole, "iso", options={"program": {"profile": "fast-wire"}}), "wire-iso")
    assert [one for one in server.diagnostics(iso) if one.severity == "error"] == []
    assert server.simulate(iso).length == pytest.approx(server.simulate(hole).length, abs=0.01)
    assert server.convert(hole, "iso", options={"program": {"profile": "robofil"}}) != iso.text
    back = server.convert(iso, "3b", options={"program": {"layout": "compact"}})
    assert [line for line in back.splitlines() if line.startswith("B")][0] == hole.text.splitlines()[0]


def test_what_is_converted_is_the_text_as_it_is_now(server: Server, hole: TextDocument) -> None:
    server.change(hole, hole.text.replace("GYNR1", "GXNR1"))
    with pytest.raises(Refused, match="wrong-counting-axis"):
        server.convert(hole, "dxf")
    assert "EOF" in server.convert(hole, "dxf", force=True)


def test_the_settings_file_of_the_program_holds_when_it_is_converted(server: Server, data: Path, tmp_path: Path) -> None:
    (tmp_path / "wedm.toml").write_text('[program]\nprofile = "mine"\n[profiles.mine]\nend = ["M99"]\n')
    (tmp_path / "hole.3b").write_bytes((data / "hole.3b").read_bytes())
    assert "M99" in server.convert(text_of(server, tmp_path / "hole.3b"), "iso")


def test_options_that_the_command_line_has_not_are_said(server: Server, hole: TextDocument) -> None:
    with pytest.raises(ValueError, match="margin, program.thread by handle"):
        server.convert(hole, "iso", options={"margin": 0.1, "program": {"thread": {"2A": (1, 2)}}})


def test_a_program_is_scaled_and_formatted(server: Server, hole: TextDocument) -> None:
    length = server.simulate(hole).length
    server.scale(hole, 2.0)
    assert server.simulate(hole).length == pytest.approx(2 * length, abs=0.01)
    assert "B19800" in hole.text
    with pytest.raises(Refused, match="the factor is -1"):
        server.scale(hole, -1.0)
    loose = server.open_text(hole.text.lower(), "3b")
    assert server.format(loose) and loose.text == hole.text
    assert not server.format(loose)


def test_a_place_in_a_text_and_back(server: Server, data: Path) -> None:
    text = text_of(server, data / "tight.dxf")
    (fault,) = [one for one in server.diagnostics(text) if one.severity == "error"]
    assert fault.line is not None
    there = server.locate(text, fault.line, 3)
    assert there is not None
    assert (there.handle, there.segment, there.line, there.column, there.end_column) == ("2A", 1, fault.line, fault.column, fault.end_column)
    assert server.locate(text, handle="2A", segment=1) == there
    whole = server.locate(text, handle="2A")
    assert whole is not None and whole.segment is None and whole.line < there.line
    assert server.locate(text, 1) is None
    for line in (0, 10_000):
        with pytest.raises(ValueError, match="is not in a text of"):
            server.locate(text, line)
    with pytest.raises(TypeError):
        server.locate(text)
    with pytest.raises(RequestFailed, match="ZZ"):
        server.locate(text, handle="ZZ")


def test_a_column_counts_characters(server: Server, data: Path) -> None:
    text = server.open_text((data / "tight.dxf").read_text().replace("DIE", "凹模"))
    layer = next(number for number, line in enumerate(text.text.splitlines(), 1) if "凹模" in line)
    there = server.locate(text, layer, 3)
    assert there is not None and there.handle == "2A"


def test_the_settings_in_force(data: Path, tmp_path: Path) -> None:
    (tmp_path / "below").mkdir()
    for folder in (tmp_path, tmp_path / "below"):
        (folder / "die.dxf").write_bytes((data / "tight.dxf").read_bytes())
    (tmp_path / "below/wedm.toml").write_text("[passes]\ncorrections = [0.15, 0.11]\n")
    with Server(settings={"side": "opening"}) as server:
        assert (found := server.settings(server.open(tmp_path / "die.dxf"))).correction_from == "default"
        assert (found.correction, found.corrections, found.side, found.file) == (0.1, [0.1], "opening", None)
        found = server.settings(server.open(tmp_path / "below/die.dxf"))
        assert (found.correction, found.corrections, found.correction_from) == (0.15, [0.15, 0.11], "file")
        assert found.file == (tmp_path / "below/wedm.toml").as_uri()


PAIR: Settings = {"side": "both", "wire_diameter": 0.18, "gap": 0.01, "pair": {"drawn_as": "punch", "clearance": 0.01}}


def test_a_pair_has_a_fit_and_programs_of_both_parts() -> None:
    with Server() as server:
        sharp = server.open([Polyline([(0, 0), (20, 0), (20, 10), (0, 10)], handle="2A")])
        fit = server.fit(sharp, PAIR)
        assert not fit.fits and len(fit.places) == 4 and fit.svg.startswith("<svg")
        assert fit.least == pytest.approx(0.01 - 0.4142136 * 0.09, abs=1e-7)
        assert {(place.handle, place.of) for place in fit.places} == {("2A", "plate")}
        with pytest.raises(Refused):
            server.pair(sharp, options=PAIR)
        with pytest.raises(Refused, match="pair.clearance"):
            server.fit(sharp)
        parts = server.pair(sharp, options=PAIR, force=True)
        assert [part.part for part in parts] == ["punch", "plate"]
        assert [part.corrections[0] for part in parts] == pytest.approx([0.1, 0.09])
        assert all(part.text and part.blocks for part in parts)


# The call for each method that a client asks. What else there is, opening, changing and closing, is tested with the drawings.
CALLS: dict[str, Callable[[Server, dict[str, Any]], Any]] = {
    "wedm/inspect": lambda server, open: server.inspect(open["drawing"]),
    "wedm/contours": lambda server, open: server.contours(open["drawing"]),
    "wedm/toolpath": lambda server, open: server.toolpath(open["drawing"]),
    "wedm/picture": lambda server, open: server.picture(open["drawing"]),
    "wedm/simulate": lambda server, open: server.simulate(open["program"]),
    "wedm/locate": lambda server, open: server.locate(open["text"], 1),
    "wedm/fit": lambda server, open: server.fit(open["pair"], PAIR),
    "wedm/pair": lambda server, open: server.pair(open["pair"], options=PAIR),
    "wedm/settings": lambda server, open: server.settings(open["drawing"]),
    "wedm/generate": lambda server, open: server.generate(open["drawing"]),
    "wedm/export": lambda server, open: server.export(open["drawing"], "png"),
    "wedm/holes": lambda server, open: server.holes(open["drawing"]),
    "wedm/repairs": lambda server, open: server.repairs(open["drawing"], "small-radius", "2A", 0),
    "wedm/rulePage": lambda server, open: server.rule_page("small-radius"),
    "wedm/didOpenDrawing": lambda server, open: server.open([Polyline(ROUND, handle="2A")]),
    "wedm/didChangeDrawing": lambda server, open: server.change(open["drawing"], Put(Polyline(TIGHT, handle="2B", role="ignore"))),
    "wedm/didCloseDrawing": lambda server, open: server.close_document(open["drawing"]),
}
# Asked of the client: the first on demand, which this one does not declare, as it makes its repairs itself.
ASKED_OF_US = {"wedm/applyDrawingEdit", "wedm/resendDrawing"}
# `wedm_client.calibrate` runs the command instead, which also sets the values in `wedm.toml`.
BY_COMMAND = {"wedm/calibrate"}


def test_every_method_of_the_protocol_has_its_call(root: Path) -> None:
    schema = json.loads((root / "docs/protocol.schema.json").read_text())
    assert set(CALLS) | ASKED_OF_US | BY_COMMAND == set(schema["methods"])
    assert {method for method, what in schema["methods"].items() if what.get("sentBy") == "server"} == ASKED_OF_US


@pytest.mark.parametrize("method", CALLS)
def test_the_call_sends_the_method(server: Server, data: Path, monkeypatch: pytest.MonkeyPatch, method: str) -> None:
    documents = {
        "drawing": server.open([Polyline(ROUND, handle="2A", role="opening")]),
        "pair": server.open([Circle((0, 0), 5.0, handle="2C")]),
        "text": server.open(data / "tight.dxf"),
        "program": server.open(data / "hole.3b"),
    }
    server.diagnostics(documents["drawing"])
    connection = server._live()
    sent: list[str] = []
    for name in ("request", "notify"):
        passed_on = getattr(connection, name)

        def spy(asked: str, *rest: Any, passed_on: Callable[..., Any] = passed_on) -> Any:
            sent.append(asked)
            return passed_on(asked, *rest)

        monkeypatch.setattr(connection, name, spy)
    CALLS[method](server, documents)
    assert sent == [method]


def test_the_page_of_a_rule(server: Server) -> None:
    assert server.rule_page("sharp-corner").startswith("# sharp-corner")
    with pytest.raises(RequestFailed):
        server.rule_page("no-such-rule")


def test_an_edit_of_the_server_for_an_older_text_is_refused(server: Server, hole: TextDocument) -> None:
    edit = {"documentChanges": [{"textDocument": {"uri": hole.uri, "version": 7}, "edits": []}]}
    before = (hole.text, hole.version)
    assert "is for version 7" in (server._apply_edit(edit) or "")
    assert "not open" in (server._apply_edit({"documentChanges": [{"textDocument": {"uri": "untitled:none", "version": 1}, "edits": []}]}) or "")
    assert (hole.text, hole.version) == before
    with pytest.raises(Outdated):
        server._apply_text_edit(hole, edit)


def test_what_stands_in_a_text_says_what_it_is(server: Server, data: Path, root: Path, tmp_path: Path) -> None:
    cases = json.loads((root / "clients/languages.json").read_text("utf-8"))["cases"]
    assert [program_of(case["text"]) for case in cases] == [case["language"] for case in cases]
    for name in ("prog.txt", "prog.cnc", "prog"):
        (tmp_path / name).write_bytes((data / "hole.3b").read_bytes())
        program = text_of(server, tmp_path / name)
        assert program.language == "3b"
        assert program.simulate().length > 0
    (tmp_path / "drawing.txt").write_bytes((data / "clean.dxf").read_bytes())
    assert text_of(server, tmp_path / "drawing.txt").language == "dxf"


def test_a_document_can_be_asked_itself(server: Server, hole: TextDocument, data: Path) -> None:
    """Every question of the server about a document is one of the document."""
    asked = {name for name, call in vars(Server).items() if callable(call) and not name.startswith("_")}
    of_server = {"close", "open", "open_text", "close_document", "version", "pid"}
    assert {name for name in asked - of_server if not hasattr(TextDocument, name)} == set()
    drawing = text_of(server, data / "tight.dxf")
    (fault,) = drawing.diagnostics().errors
    assert fault.line is not None and fault.handle is not None
    assert drawing.locate(fault.line, 3) == server.locate(drawing, fault.line, 3)
    assert drawing.repairs(fault.rule, fault.handle, 1) == server.repairs(drawing, fault.rule, fault.handle, 1)
    drawing.apply(drawing.actions(fault)[0])
    assert not drawing.diagnostics().errors
    assert drawing.export("svg").startswith(b"<svg") and drawing.rule_page("gap").startswith("# gap")
    assert drawing.holes(options={"side": "opening"}).startswith(b"drawing,")
    assert hole.simulate().length > 0 and "EOF" in hole.convert("dxf")
    hole.scale(2.0)
    hole.change(hole.text.lower())
    assert hole.format()
    with pytest.raises(ValueError, match="not for"):
        hole.apply(Action("x", True, drawing, 1, {}))


def test_a_drawing_without_text_has_no_places(server: Server) -> None:
    with pytest.raises(Refused):
        server.locate(server.open([Circle((0, 0), 5)]), 1, 1)


def test_what_was_stated_is_shown_as_it_was_stated(tmp_path: Path) -> None:
    with Server(folder=tmp_path, settings={"wire_diameter": 0.18, "gap": 0.01}) as server:
        assert server.open([Circle((0, 0), 5)]).settings().correction == 0.1


@pytest.mark.parametrize(
    ("entity", "said"),
    [
        (Circle((0, 0), -1), "radius is -1, expected a finite number above 0"),
        (Circle((0, 0), math.nan), "radius is nan"),
        (Circle((math.inf, 0), 1), "center is inf, expected a finite number"),
        (Circle(("a", 0), 1), "center is 'a', expected a finite number"),  # type: ignore[arg-type]
        (Polyline([(0, 0), (1, math.nan), (1, 1)]), "vertex 1 is nan"),
        (Arc((0, 0), 1, 0, math.inf), "end_angle is inf"),
        (Line((0, 0), (1,)), "end is (1,), expected two finite numbers"),  # type: ignore[arg-type]
    ],
)
def test_an_unsound_drawing_is_refused_at_once(server: Server, entity: Any, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        server.open([entity])
    drawing = server.open([Circle((0, 0), 5, "C")])
    with pytest.raises(ValueError, match=re.escape(said)):
        server.change(drawing, Put(Polyline(entity.vertices, handle="C") if isinstance(entity, Polyline) else replace(entity, handle="C")))
    assert drawing["C"] == Circle((0, 0), 5, "C") and drawing.diagnostics() == []


def test_what_only_the_server_refuses_is_said_at_once(server: Server) -> None:
    drawing = server.open([Circle((0, 0), 5, role="inside")])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="inside"):
        drawing.diagnostics()


def test_numbers_that_are_none_are_refused_before_they_are_sent(server: Server, hole: TextDocument) -> None:
    drawing = server.open([Circle((0, 0), 5)])
    with pytest.raises(ValueError, match="correction is nan, expected a finite number"):
        server.generate(drawing, options={"correction": math.nan})
    with pytest.raises(ValueError, match="passes.corrections is inf"):
        server.toolpath(drawing, options={"passes": {"corrections": [math.inf]}})
    with pytest.raises(ValueError, match="feed is nan"):
        server.simulate(hole, math.nan)
    with pytest.raises(ValueError, match="factor is inf"):
        server.scale(hole, math.inf)

"""Results to look at: tables in notebooks, dictionaries, one line in a console; and what is said of a repair that nobody has saved."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import warnings
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from wedm_client import Circle, Drawing, NotSaved, Polyline, Server, Settings, check_many, report, write_back
from wedm_client.shown import MOST_ROWS, table

from .plates import QUARTER, TIGHT

PUNCH: Settings = {"side": "punch", "program": {"tab": 2.0}, "passes": {"corrections": [0.15, 0.12]}}
PAIR: Settings = {"side": "both", "wire_diameter": 0.18, "gap": 0.01, "pair": {"drawn_as": "punch", "clearance": 0.01}}
SQUARE = Polyline([(0, 0), (20, 0), (20, 10), (0, 10)], handle="2A")

# What a drawing can be asked, with the row that its table begins with and what its line says.
ASKED: list[tuple[str, Callable[[Drawing], Any], dict[str, Any], str]] = [
    ("diagnostics", lambda drawing: drawing.diagnostics(), {"severity": "error", "rule": "small-radius", "handle": "2A", "segment": 1}, "small-radius"),
    ("inspect", lambda drawing: drawing.inspect(), {"handle": "2A", "segment": 0, "kind": "line", "verdict": "ok"}, "1 entity, 5 segments, 1 not ok"),
    ("contours", lambda drawing: drawing.contours(), {"contour": 0, "closed": True, "segments": 5, "handles": ["2A"]}, "1, 0 of them open"),
    ("fix", lambda drawing: drawing.fix(), {"is": "repaired", "rule": "small-radius", "handle": "2A"}, "findings before"),
    ("toolpath", lambda drawing: drawing.toolpath(PUNCH), {"contour": 0, "pass": 1, "cuts off": None, "correction": 0.15}, "4 paths"),
    ("generate", lambda drawing: drawing.generate(options=PUNCH), {}, "blocks, cut "),
    ("fit", lambda drawing: drawing.fit(PAIR), {"handle": "2A", "of": "plate"}, "does not fit"),
    ("pair", lambda drawing: drawing.pair(options=PAIR, force=True), {"part": "punch", "other side": False}, "PairProgram of the punch"),
]


@pytest.mark.parametrize(("ask", "first", "said"), [pytest.param(*rest, id=name) for name, *rest in ASKED])
def test_a_drawing_answers_with_what_shows_itself(server: Server, ask: Callable[[Drawing], Any], first: dict[str, Any], said: str) -> None:
    answer = ask(server.open([Polyline(TIGHT, handle="2A")]))
    assert said in repr(answer) and len(repr(answer)) < 2000
    json.dumps(answer.to_dict())
    if first:
        row = answer.rows()[0]
        assert {key: row[key] for key in first} == first
        html = ElementTree.fromstring(f"<div>{answer._repr_html_()}</div>")
        assert len(html.findall(".//tbody/tr")) == len(answer.rows())


def test_tabs_and_passes_are_told_apart(server: Server) -> None:
    paths = server.open([SQUARE]).toolpath(PUNCH).paths
    assert [(path.pass_number, path.cuts_off) for path in paths] == [(1, False), (2, False), (1, True), (2, True)]
    assert {piece.source for piece in paths[2].segments} >= {"cut-off"}


def test_a_table_is_html_whatever_stands_in_it() -> None:
    shown = table([{"a": "<b>&", "none": None, "at": (1.0, 2.0), "yes": True}])
    assert "&lt;b&gt;&amp;" in shown and "none" not in shown and "1.0000, 2.0000" in shown and ">yes</td>" in shown
    long = table([{"number": number} for number in range(MOST_ROWS + 7)])
    assert long.count("<tr>") == MOST_ROWS + 1 and "… and 7 more" in long
    assert table([]) == "<p>nothing</p>"


def test_checked_files_count_what_is_wrong(data: Path) -> None:
    checked = check_many([data / "tight.dxf", data / "clean.dxf", data / "no such.dxf"])
    tight, clean, missing = checked
    assert [one.rule for one in tight.errors] == ["small-radius"] and tight.warnings == clean.errors == missing.errors == []
    assert [row["ok"] for row in checked.rows()] == [False, True, False]
    assert "1 errors" in repr(tight) and "no such file" in repr(missing)
    assert checked.to_dict()[0]["diagnostics"][0]["rule"] == "small-radius"
    assert ElementTree.fromstring(f"<div>{checked._repr_html_()}</div>").findall(".//tbody/tr")


def test_lines_of_a_console(server: Server, data: Path) -> None:
    drawing, text = server.open([SQUARE]), server.open(data / "tight.dxf")
    assert repr(drawing) == f"<Drawing {drawing.uri}: 1 entity, version 1>"
    assert repr(text) == "<TextDocument tight.dxf: dxf, 57 lines, version 1>".replace("57", str(len(text._lines())))
    assert repr(server).endswith(": 2 documents>")
    text.fix()
    assert "changed and not saved" in repr(text)
    assert repr(drawing.picture()).startswith("<Picture: SVG of ")


def forgotten(work: Callable[[Server], Any], **of_server: Any) -> list[str]:
    """What is said of the work when the server is closed, with the file that it is said of."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        with Server(**of_server) as server:
            work(server)
    return [f"{Path(one.filename).name}: {one.message}" for one in said if issubclass(one.category, NotSaved)]


def test_a_repair_that_nobody_has_saved_is_said(data: Path, tmp_path: Path) -> None:
    path = tmp_path / "tight.dxf"
    path.write_bytes((data / "tight.dxf").read_bytes())
    (said,) = forgotten(lambda server: server.open(path).fix())
    assert said == f"test_shown.py: what was changed in {path} was not saved: call document.save()"
    assert path.read_bytes() == (data / "tight.dxf").read_bytes()

    def closed(server: Server) -> None:
        document = server.open(path)
        document.fix()
        document.close()

    assert len(forgotten(closed)) == 1
    assert forgotten(lambda server: server.open(path).diagnostics()) == []
    assert forgotten(lambda server: server.open(data / "narrow.dxf").fix()) == []
    assert forgotten(lambda server: server.open([Polyline(TIGHT, handle="2A")]).fix()) == [], "what is in no file cannot be saved"


def test_what_was_saved_or_taken_is_not_forgotten(data: Path, tmp_path: Path) -> None:
    def saved(server: Server) -> None:
        document = server.open(data / "tight.dxf")
        document.fix()
        document.save(tmp_path / "repaired.dxf")

    def taken(server: Server) -> None:
        document = server.open(data / "tight.dxf")
        document.fix()
        assert "SECTION" in document.text

    assert forgotten(saved) == forgotten(taken) == []

    def stopped(server: Server) -> None:
        server.open(data / "tight.dxf").fix()
        raise KeyError("something else")

    with pytest.raises(KeyError), warnings.catch_warnings():
        warnings.simplefilter("error")
        with Server() as server:
            stopped(server)


def test_entities_of_ezdxf_that_were_not_given_their_repairs_are_said() -> None:
    from ezdxf.filemanagement import new

    def repaired(server: Server, writes: bool) -> None:
        document = new(units=4)
        document.modelspace().add_lwpolyline([(0, 0, 0), (19.92, 0, QUARTER), (20, 0.08, 0), (20, 10, 0), (0, 10, 0)], format="xyb", close=True)
        drawing = server.open(document.modelspace())
        assert isinstance(drawing, Drawing) and drawing.fix().before.errors
        if writes:
            write_back(drawing)

    (said,) = forgotten(lambda server: repaired(server, writes=False))
    assert "call write_back(drawing)" in said
    assert forgotten(lambda server: repaired(server, writes=True)) == []


def test_python_says_it_without_being_asked(data: Path, tmp_path: Path) -> None:
    path = tmp_path / "tight.dxf"
    path.write_bytes((data / "tight.dxf").read_bytes())
    script = "import sys\nfrom wedm_client import Server\nwith Server() as server:\n    server.open(sys.argv[1]).fix()\n"

    def said(*options: str) -> str:
        words = [sys.executable, *options, "-c", script, str(path)]
        return subprocess.run(words, capture_output=True, text=True, timeout=60, check=True).stderr

    assert "NotSaved: what was changed in" in said()
    assert said("-W", "ignore") == ""


def test_a_report_has_a_page_for_each_drawing(data: Path, tmp_path: Path) -> None:
    index = report([data / "tight.dxf", data / "clean.dxf"], tmp_path / "report", side="opening")
    assert index == tmp_path / "report/index.html"
    assert sorted(path.name for path in index.parent.glob("*.html")) == ["clean.html", "index.html", "tight.html"]
    assert "small-radius" in (index.parent / "tight.html").read_text("utf-8")


def test_circles_show_one_segment(server: Server) -> None:
    (row,) = server.open([Circle((0, 0), 3.0, handle="C")]).inspect().rows()
    assert (row["kind"], row["radius"]) == ("circle", 3.0)


def test_numbers_in_texts_are_rounded_and_values_are_not(server: Server) -> None:
    drawing = server.open([Polyline(TIGHT, handle="2A")])
    (contour,) = drawing.contours()
    pieces = contour.segments
    assert any(f"{piece.radius}" not in repr(piece) for piece in pieces if piece.radius is not None) or contour.length != round(contour.length, 4)
    for answer in (contour, *pieces, *drawing.inspect(), *drawing.toolpath(PUNCH), drawing.settings()):
        numbers = re.findall(r"\d+\.(\d+)", repr(answer))
        assert numbers and max(map(len, numbers)) <= 4, repr(answer)
        assert "None" not in repr(answer)


def test_a_loop_goes_over_what_an_answer_lists(server: Server, tmp_path: Path) -> None:
    drawing = server.open([SQUARE])
    drawing.generate(options=PUNCH).save(tmp_path / "square.3b")
    simulation = server.open(tmp_path / "square.3b").simulate()
    contours, inspection, toolpath = drawing.contours(), drawing.inspect(), drawing.toolpath(PUNCH)
    assert list(contours) == contours.contours and contours[0].closed
    assert list(inspection) == inspection.entities and list(toolpath) == toolpath.paths and list(simulation) == simulation.blocks
    assert [len(contours), len(inspection), len(toolpath)] == [1, 1, 4]
    assert not list(server.open([]).contours())

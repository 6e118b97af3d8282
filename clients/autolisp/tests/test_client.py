"""The client in a CAD program that is played, with the real wedm: what a user types, and what becomes of the drawing."""

from __future__ import annotations

import io
import math
import os
import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from cad import CANCEL, CLIENT, ENTER, Cad, Name
from ezdxf.document import Drawing
from lisp import Fault, Misuse, Symbol, items, parse

WEDM = os.environ["WEDM"]
QUARTER = math.tan(math.pi / 8)
ROUTES = ("shell", "startapp")
PAGES = ("ANSI_1252", "ANSI_936")


# Drawings


def empty() -> Drawing:
    document = ezdxf.new("R2018")
    document.units = ezdxf.units.MM
    return document


def corners(x: float, radius: float) -> list[tuple[float, float, float]]:
    return [(x, 0, 0), (x + 10, 0, 0), (x + 10, 10 - radius, QUARTER), (x + 10 - radius, 10, 0), (x, 10, 0)]


def tight(document: Drawing, x: float = 0, layer: str = "DIE") -> None:
    points = [(x, y, bulge) for x, y, bulge in corners(x, 0.05)]
    document.modelspace().add_lwpolyline(points, "xyb", close=True, dxfattribs={"layer": layer, "color": 3, "elevation": 0.5})


def tight_and_wide(document: Drawing, x: float = 0) -> None:
    polyline = document.modelspace().add_lwpolyline(corners(x, 0.05), "xyb", close=True)
    polyline.dxf.const_width = 0.1


def tight_lines(document: Drawing, x: float = 0, layer: str = "模具") -> None:
    space, look, radius = document.modelspace(), {"layer": layer, "lineweight": 35}, 0.05
    for start, end in (((0, 0), (10, 0)), ((10, 0), (10, 10 - radius)), ((10 - radius, 10), (0, 10)), ((0, 10), (0, 0))):
        space.add_line((x + start[0], start[1]), (x + end[0], end[1]), dxfattribs=look)
    space.add_arc((x + 10 - radius, 10 - radius), radius, 0, 90, dxfattribs=look)


def old_polyline(document: Drawing, x: float = 0) -> None:
    document.modelspace().add_polyline2d(corners(x, 0.05), format="xyb", close=True, dxfattribs={"layer": "OLD"})


def old_polyline_with_crumb(document: Drawing, x: float = 0) -> None:
    points = [(x, 0, 0), (x + 5, 0, 0), (x + 5.004, 0, 0), *corners(x, 0.05)[1:]]
    document.modelspace().add_polyline2d(points, format="xyb", close=True, dxfattribs={"layer": "OLD", "color": 1})


def doubles(document: Drawing, x: float = 0) -> None:
    tight_lines(document, x)
    document.modelspace().add_line((x, 0), (x + 10, 0), dxfattribs={"layer": "模具"})


def chords(document: Drawing, x: float = 0) -> None:
    turns = [math.pi / 2 * step / 24 for step in range(1, 25)]
    places = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), *((5 + 5 * math.cos(turn), 5 + 5 * math.sin(turn)) for turn in turns), (0.0, 10.0)]
    for start, end in zip(places, places[1:] + places[:1], strict=True):
        document.modelspace().add_line((x + start[0], start[1]), (x + end[0], end[1]), dxfattribs={"layer": "模具", "color": 5})


def from_below(document: Drawing, x: float = 0) -> None:
    points = [(-x, y, -bulge) for x, y, bulge in corners(x, 0.05)]
    document.modelspace().add_lwpolyline(points, "xyb", close=True, dxfattribs={"extrusion": (0, 0, -1)})


def square(document: Drawing, x: float = 0) -> None:
    document.modelspace().add_lwpolyline([(x, 0), (x + 10, 0), (x + 10, 10), (x, 10)], close=True)


def disc_of_chords(document: Drawing, _: float = 0) -> None:
    points = [(10 * math.cos(math.tau * turn / 360), 10 * math.sin(math.tau * turn / 360)) for turn in range(360)]
    document.modelspace().add_lwpolyline(points, close=True)


def all_kinds(document: Drawing) -> None:
    for place, draw in enumerate((tight, tight_and_wide, tight_lines, old_polyline, old_polyline_with_crumb, doubles, chords, from_below)):
        draw(document, 20.0 * place)


def cad(folder: Path, *draws: Callable[..., None], route: str = "shell", page: str = "ANSI_1252", **more: Any) -> Cad:
    document = empty()
    for place, draw in enumerate(draws):
        draw(document) if draw is all_kinds else draw(document, 20.0 * place)
    return Cad(document, folder, page=page, is_lt=route == "startapp", **{"wedm": WEDM} | more)


def drawn(document: Drawing) -> list[tuple[str, str, list[float]]]:
    """What is in a drawing, marks and paths left out, in an order of its own."""
    found = []
    for entity in document.modelspace():
        kind, about = entity.dxftype(), entity.dxf
        if about.layer.startswith("WEDM_"):
            continue
        if kind == "LINE":
            numbers = [*about.start, *about.end]
        elif kind == "ARC":
            numbers = [*about.center, about.radius, about.start_angle % 360, about.end_angle % 360]
        elif kind == "LWPOLYLINE":
            # The width of the whole is that of each vertex.
            width = about.get("const_width")
            points = [(x, y, start if width is None else width, end if width is None else width, bulge) for x, y, start, end, bulge in entity.get_points("xyseb")]
            numbers = [about.flags, about.elevation, about.extrusion.z, *(one for point in points for one in point)]
        elif kind == "POLYLINE":
            numbers = [about.flags, *(one for vertex in entity.vertices for one in (*vertex.dxf.location, vertex.dxf.get("bulge", 0.0)))]
        else:
            raise AssertionError(kind)
        looks = f"{kind} {about.layer} {about.color} {about.get('lineweight', -1)}"
        found.append((looks, [float(number) for number in numbers]))
    found.sort(key=lambda one: (one[0], [round(number, 5) for number in one[1]]))
    return [(looks, str(len(numbers)), numbers) for looks, numbers in found]


def same(one: Drawing, other: Drawing) -> bool:
    pairs = list(zip(drawn(one), drawn(other), strict=False))
    alike = len(drawn(one)) == len(drawn(other)) and all(a[:2] == b[:2] for a, b in pairs)
    return alike and all(a[2] == pytest.approx(b[2], abs=1e-9) for a, b in pairs)


def marks(cad: Cad, kind: str = "CIRCLE") -> list[Any]:
    return [entity for entity in cad.space if entity.dxf.layer == "WEDM_MARKS" and entity.dxftype() == kind]


def by_command_line(cad: Cad, *words: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([WEDM, *words], capture_output=True, cwd=cad.folder, timeout=60, env=os.environ | {"LC_ALL": "C"})


def fixed(cad: Cad) -> Drawing:
    cad.document.saveas(cad.folder / "as-it-is.dxf")
    by_command_line(cad, "fix", "as-it-is.dxf", "-o", "repaired.dxf", "--overwrite")
    document = ezdxf.readfile(cad.folder / "repaired.dxf")
    for name in ("as-it-is.dxf", "repaired.dxf"):
        (cad.folder / name).unlink()
    return document


# Sessions


@dataclass
class Session:
    """One command, what the user answers, and what the text window shows."""

    name: str
    draws: tuple[Callable[..., None], ...]
    command: str
    shows: tuple[str, ...]
    answers: tuple[Any, ...] = ()
    hides: tuple[str, ...] = ()
    marks: int = 0
    options: dict[str, Any] = field(default_factory=dict)


SESSIONS = [
    Session("a clean drawing", (square,), "RMIN", ("nothing found", "and 1 that may be as they are meant", "against: correction 0.100 mm")),
    Session("one fault", (tight,), "RMIN", ("1 + error [small-radius] arc R 0.050 mm", "1 found"), (ENTER,), marks=1),
    Session("a zoom", (tight,), "RMIN", ("1 found",), (1, ENTER), marks=1),
    Session("no such number", (tight,), "RMIN", ("there is no number 7", "there is no number 0"), (7, 0, ENTER), marks=1),
    Session("an empty drawing", (), "RMIN", ("nothing is cut",), hides=("syntax",)),
    Session("nothing to repair", (square,), "RMINFIX", ("there is nothing that can be repaired safely",)),
    Session("a repair", (tight,), "RMINFIX", ("R 0.050", "1 entities changed"), hides=("left:",)),
    Session("two lines of a chain", (tight_lines,), "RMINFIX", ("3 entities changed",)),
    Session("no program known", (square,), "RMIN", ("wedm.exe is not known",), (None,), options={"wedm": None}),
    Session("a program that is gone", (square,), "RMIN", ("there is no wedm at /nowhere/wedm",), options={"wedm": "/nowhere/wedm"}),
    Session("a refused program", (tight,), "WEDM3B", ("error: the drawing has an error", "[small-radius]")),
    Session("no file chosen", (square,), "WEDM3B", ("no file was chosen",), ("Opening", None)),
    Session("no side chosen", (square,), "WEDM3B", ("error: side of contour 1",), (ENTER,)),
]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("session", SESSIONS, ids=lambda session: session.name)
def test_a_session(tmp_path: Path, session: Session, route: str) -> None:
    program = cad(tmp_path, *session.draws, route=route, **session.options)
    shown = program.run(session.command, *session.answers)
    for part in session.shows:
        assert part in shown, shown
    for part in session.hides:
        assert part not in shown, shown
    assert len(marks(program)) == session.marks
    assert len(marks(program, "TEXT")) == session.marks
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == []
    assert (program.pending == []) and ("DELAY" in program.commands) == (route == "startapp" and "DXFOUT" in program.commands and "wedm" not in session.options)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("page", PAGES)
@pytest.mark.parametrize("draw", [tight, tight_and_wide, tight_lines, old_polyline, old_polyline_with_crumb, doubles, chords, from_below, all_kinds])
def test_a_repair_is_that_of_the_command_line_and_one_step_of_undo(tmp_path: Path, draw: Callable[..., None], page: str, route: str) -> None:
    program = cad(tmp_path, draw, page=page, route=route)
    before, wanted = program.saved(), fixed(program)
    assert not same(program.document, wanted)
    shown = program.run("RMINFIX")
    assert same(program.document, wanted), shown
    # What is left is what the command line leaves.
    assert fixed(program) and same(program.document, fixed(program))
    program.command("_.U")
    assert same(program.document, ezdxf.read(io.StringIO(before)))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("command", "ending"), [("WEDM3B", "3b"), ("WEDM4B", "4b"), ("WEDMISO", "iso")])
def test_a_program_is_that_of_the_command_line(tmp_path: Path, command: str, ending: str, route: str) -> None:
    program = cad(tmp_path, square, tight, route=route)
    program.run("RMINFIX")
    target = tmp_path / f"程序 1.{ending}"
    program.page = "ANSI_936"
    shown = program.run(command, "Opening", str(target), "Yes")
    assert f"程序 1.{ending}: " in shown and "WEDM_PATH" in shown
    program.document.saveas(tmp_path / "plate-wedm.dxf")
    answer = by_command_line(program, "generate", "plate-wedm.dxf", "--format", ending, "--side", "opening")
    assert target.read_bytes() == answer.stdout
    paths = [entity for entity in program.space if entity.dxf.layer == "WEDM_PATH"]
    assert len(paths) == 2 and all(len(path) > 4 for path in paths)
    # The path is not cut the next time, and drawn once.
    (tmp_path / "plate-wedm.dxf").unlink()
    again = tmp_path / f"again.{ending}"
    program.run(command, "Opening", str(again), "Yes")
    assert again.read_bytes() == target.read_bytes()
    assert len([entity for entity in program.space if entity.dxf.layer == "WEDM_PATH"]) == 2
    assert [entity.dxf.layer for entity in program.space if entity.dxf.layer == "WEDM_MARKS"] == []


def test_chords_that_are_cut_as_arcs_are_said(tmp_path: Path) -> None:
    (tmp_path / "wedm.toml").write_text('side = "punch"\nchord-fit = 0.002\n')
    program = cad(tmp_path, disc_of_chords)
    shown = program.run("WEDM3B", str(tmp_path / "a.3b"), "No")
    assert re.search(r"cut as arcs: at most 0\.[0-9]+ um from the outline", shown), shown


def test_a_side_that_is_known_is_not_asked_for(tmp_path: Path) -> None:
    (tmp_path / "wedm.toml").write_text('side = "punch"\n')
    program = cad(tmp_path, square)
    shown = program.run("WEDM3B", str(tmp_path / "a.3b"), ENTER)
    assert "a.3b: " in shown and "WEDM_PATH" not in {entity.dxf.layer for entity in program.space}


def test_a_file_that_was_chosen_is_written_over(tmp_path: Path) -> None:
    (tmp_path / "a.3b").write_text("old")
    program = cad(tmp_path, square)
    program.run("WEDM3B", "Punch", str(tmp_path / "a.3b"), "No")
    assert "DD" in (tmp_path / "a.3b").read_text()


def test_only_the_selection_is_checked_and_cut(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, tight_lines, square)
    handles = [entity.dxf.handle for entity in program.space]
    program.picked = handles[:1]
    assert "1 found" in program.run("RMIN", ENTER)
    assert len(marks(program)) == 1
    program.picked = []
    assert "2 found" in program.run("RMIN", ENTER)
    assert len(marks(program)) == 2
    program.picked = handles[-1:]
    assert "nothing found" in program.run("RMIN")
    assert "contours: 1" in program.run("WEDM3B", "Opening", str(tmp_path / "a.3b"), ENTER)
    program.picked = handles[:1] * 400
    program.ssget = lambda *_: [Name(handles[0])] * 400
    program.lisp.define("ssget", program.ssget)
    assert "too many entities are selected: at most 300" in program.run("WEDM3B")


def test_it_zooms_to_the_place_of_a_finding(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, tight_lines)
    program.run("RMIN", 2, 1, ENTER)
    places = [place for place, _ in program.zoomed]
    assert sorted(round(place[0]) for place in places) == [10, 30]
    assert all(0 < height < 10 for _, height in program.zoomed)
    rings = {tuple(round(one, 3) for one in ring.dxf.center) for ring in marks(program)}
    assert {tuple(round(one, 3) for one in place) for place in places} == rings
    assert {text.dxf.text for text in marks(program, "TEXT")} == {"1", "2"}


@pytest.mark.parametrize("route", ROUTES)
def test_texts_are_chinese_under_code_page_936(tmp_path: Path, route: str) -> None:
    folder = tmp_path / "模具 图 & 100%"
    folder.mkdir()
    program = cad(folder, tight, page="ANSI_936", route=route, name="冲头 1.dwg")
    shown = program.run("RMIN", ENTER)
    assert "1 + 错误 [small-radius] 圆弧 R 0.050 mm 小于补偿量" in shown
    assert "依据：" in shown
    assert "改了 1 个图元" in program.run("RMINFIX")
    assert "冲头 1.3b：" in program.run("WEDM3B", "Punch", str(folder / "冲头 1.3b"), ENTER)
    assert (folder / "冲头 1.3b").is_file()


def test_the_language_can_be_chosen(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, page="ANSI_936", environment={"WEDM_LANG": "en"})
    assert "1 + error [small-radius] arc" in program.run("RMIN", ENTER)
    # What code page 1252 cannot show is not asked for.
    program = cad(tmp_path, tight, environment={"WEDM_LANG": "zh"})
    assert "1 + error [small-radius] arc" in program.run("RMIN", ENTER)


def stand_in(folder: Path, script: str) -> str:
    path = folder / "stand-in"
    path.write_text("#!/bin/sh\n" + script)
    path.chmod(0o755)
    return str(path)


@pytest.mark.parametrize(
    ("script", "shown"),
    [
        ("echo hello", "the answer of wedm cannot be read: hello"),
        ("echo '('; echo '(finding (rule'; echo ')'", "cannot be read: (finding (rule"),
        ("echo '('; echo '(wedm)'", "cannot be read: ("),
        ("echo '('; echo 'wedm'; echo ')'", "cannot be read: wedm"),
        ("echo \"error: unexpected argument '--encoding' found\" >&2; exit 2", "this wedm is too old"),
        ("echo 'error: no licence' >&2; exit 2", "wedm did not answer: error: no licence"),
        ("exit 1", "wedm did not answer: "),
        ("echo '('; echo '(failure (message . \"plate: damaged\"))'; echo ')'", "error: plate: damaged"),
    ],
)
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("command", ["RMIN", "RMINFIX", "WEDM3B", "WEDMVIEW"])
def test_a_bad_answer_is_said_in_a_sentence(tmp_path: Path, command: str, route: str, script: str, shown: str) -> None:
    program = cad(tmp_path, tight, route=route, wedm=stand_in(tmp_path, script))
    before = program.saved()
    printed = program.run(command)
    assert shown in printed and printed.count("\n") == 1, printed
    assert same(program.document, ezdxf.read(io.StringIO(before))) and not marks(program)


def test_an_answer_that_never_comes_is_not_waited_for_without_end(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, route="startapp")
    program.shell = lambda words: 0  # type: ignore[method-assign]
    assert "wedm did not answer within 120 s" in program.run("RMIN")
    assert program.commands.count("DELAY") == 480


def test_a_program_that_cannot_be_run_is_named(tmp_path: Path) -> None:
    (tmp_path / "wedm.exe").write_text("no program")
    program = cad(tmp_path, tight, wedm=str(tmp_path / "wedm.exe"))
    assert "wedm did not answer: '" in program.run("RMIN")


def test_the_program_is_found_asked_for_once_and_kept(tmp_path: Path) -> None:
    program = cad(tmp_path, square, wedm=None)
    assert "nothing found" in program.run("RMIN", WEDM)
    assert "nothing found" in program.run("RMIN")
    assert program.kept == {"AppData/wedm/program": WEDM}
    (tmp_path / "wedm.exe").symlink_to(WEDM)
    assert "nothing found" in cad(tmp_path, square, wedm=None).run("RMIN")


def test_a_locked_layer_leaves_the_drawing_as_it_is(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, tight_lines)
    program.document.layers.add("模具").lock()
    before = program.saved()
    assert "nothing was changed: entity" in program.run("RMINFIX")
    assert same(program.document, ezdxf.read(io.StringIO(before)))


def test_of_many_findings_the_first_are_listed_and_all_are_marked(tmp_path: Path) -> None:
    program = cad(tmp_path, *[tight] * 12)
    program.lisp.run("(setq wedm:most-listed 10)")
    shown = program.run("RMIN", 12, ENTER)
    assert "\n10 + error" in shown and "\n11 " not in shown and "... and 2 more" in shown and "12 found" in shown
    assert len(marks(program)) == 12 and len(program.zoomed) == 1


def test_nothing_is_repaired_that_could_not_be_taken_back(tmp_path: Path) -> None:
    program = cad(tmp_path, tight)
    program.variables["UNDOCTL"] = 0
    assert "while UNDO is switched off" in program.run("RMINFIX")
    assert program.commands == []


def test_marks_on_a_layer_that_is_locked_and_off_are_made_anew(tmp_path: Path) -> None:
    program = cad(tmp_path, tight)
    program.run("RMIN", ENTER)
    layer = program.document.layers.get("WEDM_MARKS")
    layer.lock()
    layer.off()
    program.run("RMIN", ENTER)
    layer = program.document.layers.get("WEDM_MARKS")
    assert len(marks(program)) == 1 and layer.is_on() and layer.color == 6


def test_a_folder_that_cannot_be_written_to_is_passed_over(tmp_path: Path) -> None:
    program = cad(tmp_path, tight)
    program.variables["DWGPREFIX"] = str(tmp_path / "not there") + "/"
    assert "1 found" in program.run("RMIN", ENTER)
    program.variables["TEMPPREFIX"] = program.variables["DWGPREFIX"]
    assert "the DXF could not be written: " in program.run("RMIN")


@pytest.mark.parametrize("knows_command_s", [True, False])
def test_escape_leaves_nothing_behind(tmp_path: Path, knows_command_s: bool) -> None:
    program = cad(tmp_path, tight, knows_command_s=knows_command_s)
    assert "cancelled" not in program.run("RMIN", CANCEL)
    assert program.run("WEDM3B") and "error" not in cad(tmp_path, square).run("WEDM3B", CANCEL)
    # A fault within the group.
    program.lisp.define("entmod", lambda groups: program.lisp.call(Symbol("vanished"), []))
    assert "error: no function definition" in program.run("RMINFIX")


def test_marks_and_files_of_before_do_not_stay(tmp_path: Path) -> None:
    program = cad(tmp_path, tight, tight_lines)
    (tmp_path / "plate-wedm.dxf").write_text("left by a crash")
    program.run("RMIN", ENTER)
    program.run("RMIN", ENTER)
    assert len(marks(program)) == 2
    program.run("RMINFIX")
    assert marks(program) == []
    program.document.saveas(tmp_path / "plate.dxf")
    assert by_command_line(program, "check", "plate.dxf").returncode == 0


def test_the_page_is_opened_once_for_a_file(tmp_path: Path) -> None:
    program = cad(tmp_path, square)
    assert "plate-wedm.dxf is shown in the browser" in program.run("WEDMVIEW")
    page = f'"{WEDM}" view "{tmp_path}/plate-wedm.dxf" --lang en'
    assert program.started == [page] and (tmp_path / "plate-wedm.dxf").is_file()
    tight(program.document, 20)
    assert program.run("WEDMVIEW", ENTER) == ""
    assert len(program.started) == 1 and "plate-wedm.dxf" in os.listdir(tmp_path)
    program.run("WEDMVIEW", "Yes")
    assert program.started == [page] * 2


# Texts


def table(source: str, name: str) -> dict[str, str]:
    for form in parse(source):
        if items(form)[0] is Symbol("setq") and items(form)[1] is Symbol(name):
            return {pair.car.name: pair.cdr for pair in items(items(items(form)[2])[1])}
    raise AssertionError(name)


def told(text: str) -> list[str]:
    """What stands for something in a text, and the keywords that it offers."""
    offered = re.search(r"\[(?:.*\()?.*/.*\]", text)
    keywords = re.findall(r"Auto|Opening|Punch|Yes|No", offered[0]) if offered else []
    return sorted(re.findall(r"%\d", text)) + keywords


def test_the_chinese_texts_are_those_of_their_source_and_say_the_same() -> None:
    source = (CLIENT / "wedm-zh.utf8.lsp").read_text("utf-8")
    assert (CLIENT / "wedm-zh.lsp").read_bytes() == source.encode("gbk"), "iconv -f utf-8 -t gbk wedm-zh.utf8.lsp >wedm-zh.lsp"
    english, chinese = table((CLIENT / "wedm.lsp").read_text("ascii"), "wedm:texts"), table(source, "wedm:texts-zh")
    assert {key: told(text) for key, text in chinese.items()} == {key: told(text) for key, text in english.items()}
    assert told(english["WHICH-SIDE"]) == ["Auto", "Opening", "Punch"] and told(english["WRITTEN"]) == ["%1", "%2", "%3"]
    # A byte that readers of single bytes take for an escape.
    assert b"\\" not in source.encode("gbk")


def test_the_client_uses_every_text_and_no_other() -> None:
    source = (CLIENT / "wedm.lsp").read_text("ascii")
    behind = source[source.index("(defun") :]
    used = {name.upper() for name in re.findall(r"wedm:(?:say|text) '([a-z-]+)", behind)}
    severities = {"ERROR", "WARNING", "INFORMATION"}
    assert used | severities == set(table(source, "wedm:texts"))


@pytest.mark.parametrize("wrong", ["(setq a)", "(strcat 1)", '(princ "\\U+4E2D")', "(+ 1 1e5)", "(if)", "(= '(1) '(1))", "(nosuch)", "(defun f (list) list)"])
def test_what_is_not_autolisp_is_noticed(tmp_path: Path, wrong: str) -> None:
    with pytest.raises((Misuse, Fault)):
        Cad(empty(), tmp_path, wedm=WEDM).lisp.run(wrong)

"""The server is missing, is another one, dies, or does not answer."""

from __future__ import annotations

import json
import os
import signal
import sys
import sysconfig
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from wedm_client import (
    NoAnswer,
    Polyline,
    Put,
    Server,
    ServerDied,
    ServerNotFound,
    Splice,
    WedmError,
    WrongProtocol,
    WrongSettings,
    find,
)
from wedm_client.restarts import Restarts

from .plates import QUARTER, ROUND, TIGHT

STAND_IN = [sys.executable, str(Path(__file__).with_name("stand_in.py"))]


@pytest.fixture
def nowhere(program: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """No program in the environment nor on the PATH."""
    monkeypatch.delenv("WEDM")
    monkeypatch.setenv("PATH", str(tmp_path))
    for home in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(home, str(tmp_path / "home"))
    return tmp_path


def _program_at(path: Path, program: str) -> str:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.symlink_to(program)
    return str(path)


def test_found_by_argument_environment_neighbourhood_and_path(nowhere: Path, program: str, monkeypatch: pytest.MonkeyPatch) -> None:
    installed = _program_at(nowhere / "home/.cargo/bin/wedm", program)
    assert find() == [installed]
    on_path = _program_at(nowhere / "wedm", program)
    assert find() == [on_path]
    scripts = nowhere / "scripts"
    beside = _program_at(scripts / "wedm", program)
    with monkeypatch.context() as patched:
        patched.setattr(sysconfig, "get_path", lambda _: str(scripts))
        assert find() == [beside]
    monkeypatch.setenv("WEDM", program)
    assert find() == [program]
    assert find(beside) == [beside]
    assert find(["wedm", "serve"]) == [on_path, "serve"]
    with Server([on_path, "serve", "--no-parent-watch"]) as server:
        assert server.version


@pytest.mark.parametrize(
    ("command", "variable", "said"),
    [
        (None, None, r"no program wedm in .*, on the PATH or in .*cargo"),
        ("/no/such/wedm", None, "the command names /no/such/wedm"),
        (None, "/no/such/wedm", "the environment variable WEDM names /no/such/wedm"),
        ([], None, "the command is empty"),
    ],
)
def test_missing_says_how_to_get_it(
    nowhere: Path, monkeypatch: pytest.MonkeyPatch, command: Any, variable: str | None, said: str
) -> None:
    if variable is not None:
        monkeypatch.setenv("WEDM", variable)
    with pytest.raises(ServerNotFound, match=said) as missing:
        Server(command)
    assert "cargo install --path ." in str(missing.value) and "WEDM" in str(missing.value)


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ([*STAND_IN, "protocol", "2"], "speaks protocol 2, wedm-client speaks 1: this package has to be updated"),
        ([*STAND_IN, "protocol", "0"], "speaks protocol 0, wedm-client speaks 1: the program has to be updated"),
        (["sleep", "60"], "does not answer as a language server"),
    ],
)
def test_another_server_is_said(command: list[str], said: str) -> None:
    server = Server(command, timeout=3)
    with pytest.raises(WrongProtocol, match=said):
        server.__enter__()
    server.close()


def test_no_server_at_all_is_given_up() -> None:
    with pytest.raises(ServerDied, match=r"true has ended 6 times in a row, the last time with code 0"), Server("true"):
        pass


def test_a_wrong_settings_file_is_a_warning(data: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "wedm.toml").write_text("margin = 0.002\ncorrection = -2\n", encoding="utf-8")
    (tmp_path / "plate.dxf").write_bytes((data / "tight.dxf").read_bytes())
    with Server() as server:
        server.diagnostics(server.open(tmp_path / "plate.dxf"))
        server.settings(server.open([Polyline(TIGHT, handle="2A")]))
    said = [record.getMessage() for record in caplog.records if record.name == "wedm_client"]
    assert len(said) == 1 and "wedm.toml:2: " in said[0] and "correction is -2" in said[0]


def test_a_relative_folder_of_the_path_is_passed_over(nowhere: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (nowhere / "bin").mkdir(parents=True, exist_ok=True)
    program = nowhere / "bin" / "wedm"
    program.write_text("#!/bin/sh\n", encoding="utf-8")
    program.chmod(0o755)
    monkeypatch.chdir(nowhere)
    monkeypatch.setenv("PATH", os.pathsep.join(["bin", ".", ""]))
    with pytest.raises(ServerNotFound):
        find()
    with pytest.raises(ServerNotFound):
        find("wedm")
    monkeypatch.setenv("PATH", os.pathsep.join(["bin", str(nowhere / "bin")]))
    assert find() == [str(program)]


def rules(server: Server, drawing: Any) -> list[str]:
    return [f"{one.handle} {one.rule}" for one in server.diagnostics(drawing) if one.severity == "error"]


def kill(server: Server) -> None:
    pid = server.pid
    assert pid is not None
    os.kill(pid, signal.SIGKILL)


def test_killed_between_two_edits_the_state_is_right_again(server: Server, data: Path) -> None:
    drawing = server.open([Polyline(TIGHT, handle="2A")])
    text = server.open(data / "tight.dxf")
    assert rules(server, drawing) == rules(server, text) == ["2A small-radius"]
    first = server.pid
    kill(server)
    server.change(drawing, Splice("2A", 1, 2, [(19.0, 0.0, QUARTER), (20.0, 1.0)]))
    server.change(drawing, Put(Polyline([(x, y + 40, *b) for x, y, *b in TIGHT], handle="2B")))
    assert rules(server, drawing) == ["2B small-radius"]
    assert rules(server, text) == ["2A small-radius"]
    assert server.pid != first
    kill(server)
    server.fix(text)
    kill(server)
    assert rules(server, text) == []
    assert rules(server, drawing) == ["2B small-radius"]


def test_killed_while_many_threads_edit_and_ask(server: Server) -> None:
    """Each thread has a drawing of its own; at the end every drawing is what its thread made of it."""
    rounds, failed = 15, []

    def work(number: int) -> None:
        try:
            drawing = server.open([Polyline(ROUND, handle="2A")])
            for turn in range(rounds):
                radius = 0.05 if turn % 2 else 2.0
                vertices = [(20 - radius, 0.0, QUARTER), (20.0, radius)]
                server.change(drawing, Splice("2A", 1, 2, vertices))
                segment = server.inspect(drawing).entities[0].segments[1]
                assert segment.radius == pytest.approx(radius), f"thread {number}, turn {turn}"
                assert segment.verdict == ("small-radius" if turn % 2 else "ok"), f"thread {number}, turn {turn}"
        except BaseException as error:
            failed.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for _ in range(3):
        time.sleep(0.1)
        kill(server)
    for thread in threads:
        thread.join(60)
    assert failed == []


def test_a_server_that_dies_of_a_question_is_given_up_with_its_last_words() -> None:
    with Server([*STAND_IN, "dies", "wedm/contours"]) as server:
        drawing = server.open([Polyline(TIGHT, handle="2A")])
        assert rules(server, drawing) == ["2A small-radius"]
        with pytest.raises(ServerDied, match="(?s)has ended 6 times.*code 3.*the roof fell in"):
            server.contours(drawing)
        # Another call tries again, and what is open is known again.
        assert rules(server, drawing) == ["2A small-radius"]


@pytest.mark.parametrize("how", ["babbles", "raves", "counts", "mute"])
def test_a_server_that_writes_what_is_no_message_is_killed_and_another_one_asked(how: str, tmp_path: Path) -> None:
    with Server([*STAND_IN, how, "wedm/contours", str(tmp_path / "once")], timeout=30) as server:
        drawing = server.open([Polyline(TIGHT, handle="2A")])
        first = server.pid
        assert first is not None
        assert len(server.contours(drawing).contours) == 1
        assert server.pid != first
        with pytest.raises(ProcessLookupError):
            os.kill(first, 0)
        assert rules(server, drawing) == ["2A small-radius"]


def test_a_server_that_always_writes_what_is_no_message_is_given_up() -> None:
    said = "has ended 6 times in a row, the last time killed since it wrote what is no message: 'the cutter is warm"
    with pytest.raises(ServerDied, match=said), Server([*STAND_IN, "babbles", "initialize"], timeout=30):
        pass


def test_pauses_are_those_of_every_client() -> None:
    cases = json.loads((Path(__file__).parents[2] / "restarts.json").read_text("utf-8"))["cases"]
    for case in cases:
        restarts = Restarts()
        assert [restarts.after_life_of(life) for life in case["lives"]] == case["pauses"]
    assert cases


def test_no_answer_in_time() -> None:
    with Server([*STAND_IN, "deaf", "wedm/contours"], timeout=1) as server:
        drawing = server.open([Polyline(TIGHT, handle="2A")])
        with pytest.raises(NoAnswer, match="no answer to wedm/contours within 1 s"):
            server.contours(drawing)
        # The others are answered all the same.
        assert rules(server, drawing) == ["2A small-radius"]


def test_the_process_is_gone_at_the_end() -> None:
    with Server() as server:
        pid = server.pid
        drawing = server.open([Polyline(TIGHT, handle="2A")])
    assert pid is not None
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    for ask in (lambda: server.open([]), lambda: server.diagnostics(drawing), lambda: server.pid):
        with pytest.raises(WedmError):
            ask()


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"correction": -1}, "correction is -1, expected a number above 0"),
        ({"sied": "auto"}, "sied is not known"),
        ({"side": "inside", "margin": "x"}, "side is \"inside\", expected one of both, auto, opening, punch, left, right"),
    ],
)
def test_settings_that_do_not_fit_are_refused_and_named(settings: Any, said: str) -> None:
    with pytest.raises(WrongSettings) as error, Server(settings=settings, timeout=30):
        pass
    assert said in str(error.value)
    assert ("margin is" in str(error.value)) == ("margin" in settings)


def test_warnings_about_settings_are_logged_and_stop_nothing(caplog: pytest.LogCaptureFixture) -> None:
    # Each pass cuts beyond the contour by less than the wire's radius.
    settings: Any = {"wire_diameter": 0.25, "gap": 0.01, "passes": {"corrections": [0.13, 0.128]}}
    with caplog.at_level("WARNING", logger="wedm_client"), Server(settings=settings, timeout=30) as server:
        assert server.open([]).diagnostics() == []
    said = [record.message for record in caplog.records if "beyond the contour" in record.message]
    assert [key for key in ("[0]", "[1]") if any(key in one for one in said)] == ["[0]", "[1]"]
    # An error beside them is refused, alone.
    wrong: Any = {**settings, "correction": -1}
    with pytest.raises(WrongSettings) as error, Server(settings=wrong, timeout=30):
        pass
    assert "correction is -1" in str(error.value) and "beyond the contour" not in str(error.value)

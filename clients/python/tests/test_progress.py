"""Repairs of what is large: how far they are is said, and they are waited for as long as it is.

``WEDM_MAP_BYTES`` is the size of the map, by day a small one: 1000000 is that of a map as a survey has it.
"""

from __future__ import annotations

import logging
import os
import sys
import time
from pathlib import Path

import pytest

from wedm_client import NoAnswer, Polyline, Progress, Server

from .maps import map_of
from .plates import TIGHT

BYTES = int(os.environ.get("WEDM_MAP_BYTES", "50000"))
STAND_IN = [sys.executable, str(Path(__file__).with_name("stand_in.py"))]


def _map(size: int) -> str:
    parcels = 1
    while len(text := map_of(parcels)) < size:
        parcels += max(1, parcels // 8)
    return text


@pytest.mark.timeout(120 + BYTES // 1500)
def test_a_map_is_repaired_and_it_is_said_how_far(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    heard: list[Progress] = []
    with Server(folder=tmp_path, timeout=60) as server, caplog.at_level(logging.INFO, "wedm_client"):
        drawn = _map(BYTES)
        drawing = server.open_text(drawn)
        fixed = drawing.fix(progress=heard.append)
        # Of a large one not all findings are sent; whether it was repaired stands in the text.
        assert drawing.text != drawn and drawing.text.endswith("EOF\n")
    assert len(fixed.after) <= len(fixed.before) and len(fixed.after.errors) <= len(fixed.before.errors)
    assert heard[0].percentage is None and heard[0].message
    shares = [one.percentage for one in heard if one.percentage is not None]
    assert shares and all(0 <= share <= 100 for share in shares)
    assert all(before.seconds <= after.seconds for before, after in zip(heard, heard[1:], strict=False) if after.percentage is not None)
    said = [record.getMessage() for record in caplog.records if record.levelno == logging.INFO]
    assert any(heard[0].message in one for one in said) and any(one.endswith(" %") for one in said)


def test_what_says_something_is_waited_for(tmp_path: Path) -> None:
    # It says something four times a second and answers after seven seconds.
    heard: list[Progress] = []
    with Server([*STAND_IN, "slow", "textDocument/codeAction"], folder=tmp_path, timeout=6) as server:
        drawing = server.open([Polyline(TIGHT, handle="2A")])
        begun = time.monotonic()
        fixed = server.fix(drawing, progress=heard.append)
        assert time.monotonic() - begun > 7
    assert fixed.before.errors and not fixed.after.errors
    assert [one.message for one in heard].count("still cutting") > 3


def test_what_says_nothing_is_not(tmp_path: Path) -> None:
    with Server([*STAND_IN, "deaf", "textDocument/codeAction"], folder=tmp_path, timeout=2) as server:
        drawing = server.open([Polyline(TIGHT, handle="2A")])
        with pytest.raises(NoAnswer, match="no answer to textDocument/codeAction within 2 s"):
            server.fix(drawing)


def test_what_the_callback_raises_ends_the_repair(server: Server) -> None:
    class Enough(Exception):
        pass

    def enough(_: Progress) -> None:
        raise Enough

    drawing = server.open([Polyline(TIGHT, handle="2A")])
    with pytest.raises(Enough):
        drawing.fix(progress=enough)
    # Nothing was changed, and the server goes on.
    assert server.diagnostics(drawing).errors
    assert not drawing.fix().after.errors

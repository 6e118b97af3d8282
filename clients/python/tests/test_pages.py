"""The Python of the documentation runs as it stands, one piece after the other."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

PAGES = ["docs/tutorials/python.md", "clients/python/README.md"]


@pytest.mark.parametrize("page", PAGES)
def test_the_python_of_a_page_runs(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, page: str, capsys: pytest.CaptureFixture[str]) -> None:
    drawings = tmp_path / "drawings"
    drawings.mkdir()
    for name in ("die", "notch", "slot", "gap"):
        shutil.copyfile(root / f"docs/pictures/{name}.dxf", drawings / f"{name}.dxf")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    blocks = re.findall(r"^```python\n(.*?)^```", (root / page).read_text("utf-8"), re.MULTILINE | re.DOTALL)
    assert blocks
    for block in blocks:
        if "scheduler" not in block:
            exec(compile(block, page, "exec"), names)
    said = capsys.readouterr().out
    # What a comment says that a line prints is what it prints.
    for promised in re.findall(r"^print\(.*\)  +# (.*)$", "".join(blocks), re.MULTILINE):
        assert promised in said
    assert list(tmp_path.rglob("*.3b"))

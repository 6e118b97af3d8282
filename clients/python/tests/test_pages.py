"""The Python of the documentation runs as it stands, one piece after the other."""

from __future__ import annotations

import dataclasses
import inspect
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

import wedm_client
from wedm_client.shown import Value

PAGES = ["docs/tutorials/python.md", "clients/python/README.md", "clients/python/RESULTS.md"]


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


def test_every_field_of_every_result_is_documented(root: Path) -> None:
    page = (root / "clients/python/RESULTS.md").read_text("utf-8")
    # What a client never gets by itself.
    inner = {"PairPrograms", "Repairs"}
    results = [one for name, one in vars(wedm_client).items() if inspect.isclass(one) and issubclass(one, Value) and dataclasses.is_dataclass(one) and name not in inner]
    assert len(results) > 30
    missing = [one.__name__ for one in results if f"`{one.__name__}`" not in page]
    fields = {field.name for one in results for field in dataclasses.fields(one)}
    assert (missing, sorted(name for name in fields if f"`{name}`" not in page)) == ([], [])

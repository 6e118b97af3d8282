"""The examples run as they stand, and do what they say."""

from __future__ import annotations

import ast
import contextlib
import io
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import pytest

from wedm_client import check_many

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(folder: Path, name: str, *arguments: str | Path) -> tuple[int, str]:
    words = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    ended = subprocess.run(words, cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=60, check=False)
    assert "Traceback" not in ended.stderr, ended.stderr
    return ended.returncode, ended.stdout


def test_plate(tmp_path: Path) -> None:
    code, said = run(tmp_path, "plate.py")
    assert code == 0
    assert "error[small-radius] OPENING segment 1: arc R 0.080 mm is below the correction 0.120 mm" in said
    assert "1 repaired, 0 left" in said and "plate.3b: " in said
    assert (tmp_path / "plate.3b").read_text().count("DD") == 1
    assert check_many(tmp_path)[0].ok


def test_repair_file(tmp_path: Path, data: Path) -> None:
    code, said = run(tmp_path, "repair_file.py", data / "tight.dxf", "repaired.dxf", "0.12")
    assert (code, said) == (0, "repaired.dxf: 1 findings before, 0 after\n")
    assert check_many(tmp_path / "repaired.dxf", correction=0.12)[0].ok
    code, said = run(tmp_path, "repair_file.py", data / "narrow.dxf", "narrow.dxf")
    assert code == 1 and "no arc of the required radius fits here" in said


def test_with_ezdxf(tmp_path: Path) -> None:
    code, said = run(tmp_path, "with_ezdxf.py", "slots.dxf")
    assert code == 0 and "3 polylines repaired" in said
    (checked,) = check_many(tmp_path / "slots.dxf", correction=0.11, side="opening")
    assert checked.ok, checked


def test_archive(tmp_path: Path, data: Path) -> None:
    code, said = run(tmp_path, "archive.py", data)
    assert code == 1
    files = len([path for path in data.rglob("*") if path.suffix in (".dxf", ".dxb", ".3b", ".4b", ".iso", ".nc")])
    assert f"{files} files, " in said and "tight.dxf: 1 errors, the first: error[small-radius]" in said


def cells(text: str) -> list[str]:
    return [part.partition("\n")[2] for part in text.split("# %%")[1:]]


def shown(cell: str, names: dict[str, Any]) -> Any:
    """Runs a cell as a notebook does; what its last line is worth, or what it printed."""
    tree = ast.parse(cell)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "notebook", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "notebook", "eval"), names) if isinstance(last, ast.Expr) else None
    if value is not None and hasattr(value, "_repr_svg_"):
        return value._repr_svg_()
    return printed.getvalue() or value


def test_notebook() -> None:
    names: dict[str, Any] = {}
    seen = [shown(cell, names) for cell in cells((EXAMPLES / "notebook.py").read_text())]
    assert [one.rule for one in seen[1]][0] == "small-radius"
    for picture in (seen[2], seen[5]):
        assert ElementTree.fromstring(picture).tag.endswith("svg")
    assert [(row["segment"], row["radius"]) for row in seen[3].rows() if row["verdict"] == "small-radius"] == [(1, pytest.approx(0.08))]
    assert seen[4].after.errors == []
    assert all("<table>" in seen[cell]._repr_html_() for cell in (1, 3, 4))
    assert seen[6].rstrip().endswith("DD")
    assert names["drawing"]._repr_svg_() is None, "a closed drawing has no picture, and breaks no notebook"


def test_the_scaling_table(tmp_path: Path) -> None:
    words = [sys.executable, str(EXAMPLES.parent / "benches/scaling.py"), "--files", "40", "--workers", "1", "2", "--repeat", "1", "--keep", str(tmp_path)]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=110, check=False)
    assert ended.returncode == 0, ended.stderr
    assert "40 drawings" in ended.stdout and "| workers | threads | processes | Dask LocalCluster |" in ended.stdout
    bad = sum(not file.ok for file in check_many(tmp_path))
    assert 0 < bad < 40 and f", {bad} of them with errors" in ended.stdout

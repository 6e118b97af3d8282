"""Files: read in whatever encoding they have, repaired, and written with every other byte as it was."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from wedm_client import Server, TextDocument


def opened(server: Server, path: Path) -> TextDocument:
    document = server.open(path)
    assert isinstance(document, TextDocument)
    return document


def places(server: Server, document: TextDocument) -> list[str]:
    return [f"{one.line}:{one.column}-{one.end_column} {one.rule}" for one in server.diagnostics(document) if one.severity == "error"]


def differing(old: bytes, new: bytes) -> list[int]:
    """Numbers, from 1, of the lines that differ."""
    assert old.count(b"\n") == new.count(b"\n")
    return [number for number, (a, b) in enumerate(zip(old.split(b"\n"), new.split(b"\n"), strict=True), 1) if a != b]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("tight.dxf", ["34:1-15 small-radius"]),
        ("clean.dxf", []),
        ("garbage.dxf", ["1:1-42 syntax"]),
        ("hole.3b", []),
    ],
)
def test_files(server: Server, data: Path, name: str, expected: list[str]) -> None:
    assert places(server, opened(server, data / name)) == expected


def as_it_is(content: bytes) -> bytes:
    return content


@pytest.mark.parametrize(
    ("write", "encoding"),
    [
        pytest.param(as_it_is, "utf-8", id="as it is"),
        pytest.param(lambda content: content.replace(b"\n", b"\r\n"), "utf-8", id="line ends of Windows"),
        pytest.param(lambda content: b"\xef\xbb\xbf" + content, "utf-8", id="byte order mark"),
        pytest.param(lambda content: content.replace(b"DIE", "凹模".encode()), "utf-8", id="Chinese in UTF-8"),
        pytest.param(lambda content: _page(content, "ANSI_936").replace(b"DIE", "凹模".encode("gbk")), "gbk", id="Chinese in GBK"),
        pytest.param(lambda content: _page(content, "ANSI_1252").replace(b"DIE", b"St\xe4mpel"), "cp1252", id="German"),
        pytest.param(lambda content: content.replace(b"DIE", b"\xff\xfe\x81"), "latin-1", id="bytes that are no text"),
    ],
)
def test_a_repair_changes_the_numbers_at_fault_and_no_other_byte(
    server: Server, data: Path, tmp_path: Path, write: object, encoding: str
) -> None:
    assert callable(write)
    content = write((data / "tight_fillet.dxf").read_bytes())
    path = tmp_path / "die.dxf"
    path.write_bytes(content)
    path.chmod(0o640)
    document = opened(server, path)
    assert document.encoding == encoding
    (line,) = {one.line for one in server.diagnostics(document) if one.severity == "error"}
    fixed = server.fix(document)
    assert [one.severity for one in fixed.after].count("error") == 0
    assert path.read_bytes() == content, "only `save` writes the file"
    document.save()
    changed = differing(content, path.read_bytes())
    assert line is not None and changed and all(abs(number - line) <= 6 for number in changed)
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]
    # A fresh reader agrees.
    assert places(server, server.open_text(document.text)) == []


def _page(content: bytes, name: str) -> bytes:
    return content.replace(b"  9\n$INSUNITS", b"  9\n$DWGCODEPAGE\n  3\n" + name.encode() + b"\n  9\n$INSUNITS")


def test_a_text_is_changed_as_a_whole(server: Server, data: Path, tmp_path: Path) -> None:
    document = server.open_text((data / "tight.dxf").read_text())
    assert len(places(server, document)) == 1
    server.change(document, (data / "clean.dxf").read_text())
    assert places(server, document) == []
    server.change(document, (data / "tight.dxf").read_text())
    server.fix(document)
    document.save(tmp_path / "new.dxf")
    assert places(server, opened(server, tmp_path / "new.dxf")) == []
    with pytest.raises(ValueError, match="came from no file"):
        document.save()


def test_the_project_file_above_a_drawing_holds(server: Server, data: Path, tmp_path: Path) -> None:
    (tmp_path / "wedm.toml").write_text("correction = 0.05\n")
    (tmp_path / "die.dxf").write_bytes((data / "tight.dxf").read_bytes())
    assert places(server, opened(server, tmp_path / "die.dxf")) == []


def test_a_program_of_a_file(server: Server, data: Path, tmp_path: Path) -> None:
    document = opened(server, data / "tight.dxf")
    server.fix(document)
    server.generate(document, options={"side": "opening"}).save(tmp_path / "die.3b")
    server.picture(document).save(tmp_path / "die.svg")
    assert (tmp_path / "die.3b").read_text().endswith("DD\n")
    assert places(server, opened(server, tmp_path / "die.3b")) == []
    assert (tmp_path / "die.svg").read_text().startswith("<svg")


def test_a_program_is_run(server: Server, data: Path) -> None:
    document = opened(server, data / "hole.3b")
    run = server.simulate(document, feed=2.0)
    assert [block.kind for block in run.blocks] == ["line", "arc", "line", "end"]
    assert [block.line for block in run.blocks] == [1, 2, 3, 4]
    arc = run.blocks[1]
    assert arc.radius == pytest.approx(9900) and arc.sweep == pytest.approx(360)
    assert abs(run.closure.x) < 2 and abs(run.closure.y) < 2
    assert run.length == pytest.approx(2 * 9.9 + 2 * math.pi * 9.9, abs=0.01)
    assert run.minutes == pytest.approx(run.length / 2.0)

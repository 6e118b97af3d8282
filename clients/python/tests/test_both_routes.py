"""Every drawing by both routes: as a file, and as the entities of a CAD program (ezdxf). The same is cut, with the same faults, and by the same program.

``WEDM_DRAWINGS`` names further folders of drawings, as ``PATH`` does.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from ezdxf.document import Drawing as Dxf
from ezdxf.filemanagement import read, readfile
from ezdxf.lldxf.const import DXFError

from wedm_client import Document, Refused, Server, Settings, UnsupportedEntity, UnsupportedUnits
from wedm_client.cad import entities_from, units_of

from .conftest import ROOT

FOLDERS = [
    *(ROOT / folder for folder in ("tests/data", "tests/cases", "docs/pictures", "fuzz/seeds", "src/cli/demo", "clients/librecad/tests")),
    *map(Path, filter(None, os.environ.get("WEDM_DRAWINGS", "").split(os.pathsep))),
]
BINARY = b"AutoCAD Binary DXF"
DRAWINGS = [path for folder in FOLDERS for path in sorted(folder.rglob("*")) if path.suffix.lower() == ".dxf" and not path.read_bytes().startswith(BINARY)]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """One for all: each drawing is closed again."""
    with Server(folder=tmp_path_factory.mktemp("routes"), timeout=60) as started:
        yield started


def _read(path: Path) -> Dxf:
    """The document; where ezdxf asks for a version and the marks of LWPOLYLINE's class, which the server does without, they are added."""
    try:
        return readfile(path)
    except DXFError:
        lines = path.read_text("utf-8", "replace").splitlines()
        if "HEADER" not in map(str.strip, lines):
            lines = ["0", "SECTION", "2", "HEADER", "0", "ENDSEC", *lines]
        tags, is_polyline = [], False
        for code, value in zip(lines[::2], lines[1::2], strict=False):
            if code.strip() == "0":
                is_polyline = value.strip() == "LWPOLYLINE"
            elif code.strip() == "90" and is_polyline:
                tags.append("100\nAcDbPolyline\n")
                is_polyline = False
            tags.append(f"{code}\n{value}\n")
            if value.strip() == "HEADER":
                tags.append("9\n$ACADVER\n1\nAC1015\n")
            elif code.strip() == "5" and is_polyline:
                tags.append("100\nAcDbEntity\n")
        return read(StringIO("".join(tags)))


def _known(document: Dxf) -> bool:
    """Takes out of the modelspace what a drawing cannot hold; true where nothing had to go."""
    others: list[Any] = []
    handles: set[str] = set()
    for entity in document.modelspace():
        try:
            known, _ = entities_from([entity])
            for one in known:
                one.to_json()
        except (UnsupportedEntity, ValueError):
            others.append(entity)
            continue
        others += [entity for one in known if one.handle in handles]
        handles.update(one.handle for one in known)
    for entity in others:
        document.modelspace().delete_entity(entity)
    try:
        units_of(document.modelspace())
    except UnsupportedUnits:
        document.units = 4
        return False
    return not others


def _roles(document: Dxf) -> Iterator[Settings]:
    """Settings that bring back what is not cut, or leave out what is."""
    layers = {str(layer.dxf.name): "punch" for layer in document.layers}
    linetypes = {str(linetype.dxf.name): "opening" for linetype in document.linetypes}
    yield {"side": "auto"}
    yield {"side": "auto", "layers": layers}  # type: ignore[typeddict-item]
    yield {"side": "auto", "linetypes": linetypes}  # type: ignore[typeddict-item]
    yield {"side": "auto", "colors": {"red": "ignore", "30": "opening", "#123456": "ignore"}}


def _cut(server: Server, document: Document) -> list[Any]:
    contours = server.contours(document).contours
    return [(one.closed, one.direction, one.role, round(one.length, 6), round(one.area or 0, 6), len(one.segments)) for one in contours]


#: What is said of a text alone: a drawing that is handed over entity by entity has no group codes, and brings its unit along.
_OF_TEXTS = ("syntax", "units", "unsupported-entity")


def _faults(server: Server, document: Document, by_handle: bool) -> list[tuple[str, str, str, int]]:
    found = server.diagnostics(document)
    own = [one for one in [*found.errors, *found.warnings] if one.rule not in _OF_TEXTS]
    return sorted((one.severity, one.rule, str(one.handle) if by_handle else "", -1 if one.segment is None else one.segment) for one in own)


def _program(server: Server, document: Document, options: Settings) -> str | None:
    try:
        return server.generate(document, "iso", options=options, force=True).text
    except Refused:
        return None


@pytest.mark.parametrize("path", DRAWINGS, ids=[path.name if path.parent.name == "data" else f"{path.parent.name}/{path.name}" for path in DRAWINGS])
def test_the_same_is_cut(server: Server, tmp_path: Path, path: Path) -> None:
    try:
        document = _read(path)
    except (DXFError, OSError, ValueError, IndexError):
        pytest.skip("ezdxf does not read it")
    # A wedm.toml beside the original is no matter here.
    copy = tmp_path / "copy.dxf"
    if _known(document):
        copy.write_bytes(path.read_bytes())
    else:
        try:
            document.saveas(copy)
        except AssertionError:
            pytest.skip("ezdxf does not write it")
    file, drawing = server.open(copy), server.open(document.modelspace())
    assert _cut(server, drawing) == _cut(server, file)
    assert server.inspect(drawing).units_to_mm == server.inspect(file).units_to_mm
    # ezdxf gives a handle to an entity that has none in its file.
    has_handles = not any(entity.handle.startswith("#") for entity in server.inspect(file).entities)
    assert _faults(server, drawing, has_handles) == _faults(server, file, has_handles)
    for options in _roles(document):
        assert _program(server, drawing, options) == _program(server, file, options), options
    drawing.close()
    file.close()

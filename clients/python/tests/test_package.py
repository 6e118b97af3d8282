"""The package as it is handed out: typed, complete, and in agreement with the protocol's schema."""

from __future__ import annotations

import ast
import dataclasses
import json
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest

import wedm_client
from wedm_client import findings, programs, results, settings
from wedm_client.reading import _KEYS, _camel


@pytest.fixture
def schema(root: Path) -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads((root / "docs/protocol.schema.json").read_text())
    return loaded


# Read by code of the package's own: findings and places, whose lines and columns it counts from 1, and what is handed out bare.
READ_OTHERWISE = {
    *("Diagnostic", "CodeDescription", "FindingData", "RelatedInformation", "RelatedPlace", "Location", "Located", "Range", "Position"),
    *("Point", "RulePageText", "Refused", "Exported", "ContourSettings", "Calibrated", "CalibratedPass"),
}
# What is answered only to those who ask for it: the package asks for the whole.
UNASKED = {("ContoursContour", "handles"), ("Picture", "pieces")}
# Types of the package that have a name of their own.
OTHER_NAMES = {"Segment": "InspectedSegment", "Contour": "ContoursContour", "WirePath": "ToolpathPath", "Bounds": "SimulatedBounds"}
# The types that an answer is read into, by their names.
ANSWERS = {
    name: kind
    for module in (findings, results, programs)
    for name, kind in vars(module).items()
    if dataclasses.is_dataclass(kind) and kind.__module__ == module.__name__
}
# Which type of the package stands for which of the schema. `Fixed` is made of several answers.
RESULTS = [(name, OTHER_NAMES.get(name, name)) for name in ANSWERS if name not in READ_OTHERWISE | {"Fixed"}]


@pytest.mark.parametrize(("ours", "theirs"), RESULTS)
def test_results_have_every_key_of_the_schema(schema: dict[str, Any], ours: str, theirs: str) -> None:
    held = {_KEYS.get((ours, field.name), _camel(field.name)) for field in dataclasses.fields(ANSWERS[ours])}
    assert held >= {key for key in schema["$defs"][theirs]["properties"] if (theirs, key) not in UNASKED}


def _reached(schema: dict[str, Any], value: Any, found: set[str]) -> set[str]:
    """The definitions that a part of the schema refers to, and what they refer to."""
    if isinstance(value, dict):
        name = str(value.get("$ref", "")).rpartition("/")[2]
        if name and name not in found:
            found.add(name)
            _reached(schema, schema["$defs"][name], found)
    for one in value.values() if isinstance(value, dict) else value if isinstance(value, list) else []:
        _reached(schema, one, found)
    return found


def test_whatever_the_server_answers_has_its_type(schema: dict[str, Any]) -> None:
    answers = [method.get(part) for method in schema["methods"].values() if method.get("sentBy") != "server" for part in ("result", "errorData")]
    named = {name for name in _reached(schema, answers, set()) if "properties" in schema["$defs"][name]}
    assert named == {theirs for _, theirs in RESULTS} | ((READ_OTHERWISE | {"Piece"}) - {"Point"})


@pytest.mark.parametrize(("ours", "theirs"), RESULTS)
def test_words_of_results_are_those_of_the_schema(schema: dict[str, Any], ours: str, theirs: str) -> None:
    hints = get_type_hints(ANSWERS[ours])
    for field in hints:
        key = _KEYS.get((ours, field), _camel(field))
        words = _words_of(schema, schema["$defs"][theirs]["properties"].get(key, {}))
        if words:
            held = {word for one in (hints[field], *get_args(hints[field])) for word in get_args(one) if isinstance(word, str)}
            assert held == words, f"{ours}.{field}"


def _words_of(schema: dict[str, Any], value: dict[str, Any]) -> set[str]:
    if "$ref" in value:
        return _words(schema["$defs"][value["$ref"].rpartition("/")[2]])
    return set().union(*(_words_of(schema, one) for one in value.get("anyOf", [])))


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        ("Settings", "Settings"),
        ("Passes", "Passes"),
        ("ProgramSettings", "ProgramSettings"),
        ("Pair", "PairSettings"),
        ("MillingSettings", "MillingSettings"),
        ("Job", "JobSettings"),
        ("Profile", "ProfileSettings"),
        ("DrawingSettings", "DrawingSettings"),
        ("ContourSettings", "ContourSettings"),
    ],
)
def test_settings_have_the_keys_of_the_schema(schema: dict[str, Any], ours: str, theirs: str) -> None:
    assert {_camel(key) for key in get_type_hints(getattr(settings, ours))} == set(schema["$defs"][theirs]["properties"])


def test_all_that_the_package_has_is_named_at_its_front_door() -> None:
    for module in (findings, results, programs, settings):
        own = {name for name, value in vars(module).items() if isinstance(value, type) and value.__module__ == module.__name__}
        assert {name for name in own if not name.startswith("_")} <= set(wedm_client.__all__)


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [("Role", "Role"), ("Side", "SideSetting"), ("Units", "UnitSetting"), ("RuleSeverity", "RuleSeverity")],
)
def test_words_of_the_settings(schema: dict[str, Any], ours: str, theirs: str) -> None:
    assert set(get_args(getattr(settings, ours))) == _words(schema["$defs"][theirs])


def _words(definition: dict[str, Any]) -> set[str]:
    own = {*definition.get("enum", []), *([definition["const"]] if "const" in definition else [])}
    return own.union(*(_words(one) for one in definition.get("oneOf", [])))


def test_settings_reach_the_protocol_in_its_spelling() -> None:
    named = settings.to_json({"drawings": {"my_plate.dxf": {"suppress": {"2A": {"gap": "as the customer drew it"}}}}, "pair": {"drawn_as": "punch"}})
    assert named == {"drawings": {"my_plate.dxf": {"suppress": {"2A": {"gap": "as the customer drew it"}}}}, "pair": {"drawnAs": "punch"}}
    written = settings.to_json(
        {"wire_diameter": 0.2, "layers": {"MY_LAYER": "punch"}, "program": {"lead_in": 2, "thread": {"A_1": (1, 2)}}, "passes": {"corrections": [0.1]}}
    )
    assert written == {
        "wireDiameter": 0.2,
        "layers": {"MY_LAYER": "punch"},
        "program": {"leadIn": 2, "thread": {"A_1": (1, 2)}},
        "passes": {"corrections": [0.1]},
    }


def test_types_are_sound() -> None:
    folder = Path(__file__).parents[1]
    ended = subprocess.run([sys.executable, "-m", "mypy"], cwd=folder, capture_output=True, text=True, timeout=110, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_the_wheel_holds_the_package_and_its_types(tmp_path: Path) -> None:
    folder = Path(__file__).parents[1]
    words = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(words, cwd=folder, capture_output=True, timeout=60, check=True)
    (wheel,) = tmp_path.glob("wedm_client-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    modules = {f"wedm_client/{path.name}" for path in (folder / "src/wedm_client").iterdir() if path.is_file()}
    assert modules <= set(names) and "wedm_client/py.typed" in names


def test_no_module_imports_one_that_imports_it(root: Path) -> None:
    """Imports for the type checker count too: what needs a type of a module that stands above it says what it needs of it instead."""
    folder = root / "clients/python/src/wedm_client"
    imports: dict[str, set[str]] = {}
    for path in folder.glob("*.py"):
        if path.stem != "__init__":
            tree = ast.parse(path.read_text("utf-8"))
            relative = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level == 1]
            imports[path.stem] = {name for node in relative for name in ([node.module] if node.module else [alias.name for alias in node.names])}
    left = set(imports)
    while True:
        lowest = {name for name in left if not imports[name] & left}
        if not lowest:
            break
        left -= lowest
    assert not left, f"a circle of imports: {sorted(left)}"

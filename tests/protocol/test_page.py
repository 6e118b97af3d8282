"""docs/protocol.md says what is there, and nothing else: a client that runs, the answer to the handshake, and the name of every key."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import PROTOCOL, ROOT, SCHEMA, WEDM, Client
from lsprotocol import types

#: Where keys are explained, and whose links are looked at.
EXPLAINED = [ROOT / "docs" / f"{name}.md" for name in ("protocol", "settings", "editing", "command-line", "programs")]
PAGES = "".join(page.read_text() for page in EXPLAINED)

#: Keys of LSP's own, which its specification explains.
STANDARD = {"location", "character", "codeDescription", "href"}

DECLARED = {
    "general": {"positionEncodings": ["utf-8"]},
    "textDocument": {
        "semanticTokens": {"requests": {"full": {"delta": True}}, "tokenTypes": [], "tokenModifiers": [], "formats": []},
        "codeAction": {"dataSupport": True, "resolveSupport": {"properties": ["edit"]}},
    },
    "experimental": {"wedm": {"applyDrawingEdit": True, "resendDrawing": True, "codeLens": True}},
}


def test_the_client_on_the_page_runs_and_prints_what_is_shown(tmp_path: Path) -> None:
    (source, shown) = re.findall(r"```(?:python|text)\n(.*?)```", PROTOCOL, re.DOTALL)
    (tmp_path / "client.py").write_text(source)
    (tmp_path / "wedm").symlink_to(WEDM)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    ran = subprocess.run([sys.executable, "client.py"], cwd=tmp_path, env={**os.environ, "PATH": path}, capture_output=True, text=True, timeout=60, check=False)
    assert (ran.stdout.strip(), ran.stderr, ran.returncode) == (shown.strip(), "", 0)


async def test_the_smallest_handshake_brings_notifications_only(stranger: Client) -> None:
    (smallest,) = re.findall(r"smallest `initialize` has the params `(.*?)`", PROTOCOL)
    stranger.capabilities = types.ClientCapabilities()
    assert (await stranger.ask("initialize", json.loads(smallest)))["serverInfo"]["name"] == "wedm"
    stranger.tell("initialized", {})
    await stranger.open_text("tight.dxf")
    assert {method for method, _ in stranger.heard} <= {"textDocument/publishDiagnostics", "window/logMessage", "window/showMessage"}


async def test_the_answer_to_the_handshake_is_the_one_on_the_page(stranger: Client) -> None:
    (example,) = re.findall(r'```json\n(\{ "serverInfo".*?)```', PROTOCOL, re.DOTALL)
    assert await stranger.initialize(capabilities=DECLARED) == json.loads(example)


def keys_of(part: Any) -> set[str]:
    """The names of all keys that a part of the schema has."""
    if isinstance(part, list):
        return set().union(*map(keys_of, part))
    if not isinstance(part, dict):
        return set()
    own = set(part["properties"]) if isinstance(part.get("properties"), dict) else set()
    return own.union(*map(keys_of, part.values()))


def on_the_page(key: str) -> bool:
    """In camelCase, or in kebab-case as settings stand in a file."""
    kebab = re.sub("[A-Z]", lambda letter: "-" + letter[0].lower(), key)
    return any(re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", PAGES) for name in (key, kebab))


@pytest.mark.parametrize("definition", sorted(SCHEMA["$defs"]))
def test_every_key_is_explained(definition: str) -> None:
    assert {key for key in keys_of(SCHEMA["$defs"][definition]) - STANDARD if not on_the_page(key)} == set()


def test_every_key_of_a_finding_that_the_page_names_is_there() -> None:
    table = PROTOCOL[PROTOCOL.index("| key | of | value |") : PROTOCOL.index("In `data`, lengths")]
    named = {key for row in re.findall(r"^\| (`[^|]*?) \|", table, re.MULTILINE) for key in re.findall(r"`(\w+)`", row)}
    assert named == set(SCHEMA["$defs"]["FindingData"]["properties"])


def test_the_rules_that_the_page_names_are_there() -> None:
    rules = {path.stem for path in (ROOT / "docs/rules").glob("*.md")} - {"README"}
    table = PROTOCOL[PROTOCOL.index("| key | of | value |") : PROTOCOL.index("In `data`, lengths")]
    named = {rule for cell in re.findall(r"^\| [^|]* \| (`[^|]*?) \|", table, re.MULTILINE) for rule in re.findall(r"`([\w-]+)`", cell)}
    assert named and named - rules == set()


def test_links_within_the_pages_lead_somewhere() -> None:
    for page in (*EXPLAINED, ROOT / "README.md", *(ROOT / "clients").glob("*/README.md")):
        for target in re.findall(r"\]\((?!https?:)([^)\s]+)\)", page.read_text()):
            path, _, place = target.partition("#")
            led = (page.parent / path).resolve() if path else page
            assert led.exists(), f"{page.name}: {target}"
            if place and led.suffix == ".md":
                headings = re.findall(r"^#+ (.*)$", led.read_text(), re.MULTILINE)
                anchors = {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
                assert place in anchors, f"{page.name}: {target}"

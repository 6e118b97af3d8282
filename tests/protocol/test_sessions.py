"""What real clients once said to the server is said again, and the server must answer in the same way.

Each file in sessions/ was written by record.py between a client and the server. Compared are results, errors and diagnostics: every key
that was there must still be there with the same value, numbers within a millionth. Sentences for people may change, and new keys may come.

With UPDATE_EXPECT=1 in the environment what differs is written into the sessions, to be read in the difference to what was there.
"""

from __future__ import annotations

import asyncio
import json
import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import Client
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.protocol import default_converter

SESSIONS = sorted((Path(__file__).parent / "sessions").glob("*.jsonl"))

#: Answers that differ are recorded again.
UPDATES = os.environ.get("UPDATE_EXPECT") == "1"

#: Clients of which there must be a session.
CLIENTS = {"vscode", "vscode-picture", "librecad-live", "librecad-generate", "autocad", "python", "neovim-0.7", "neovim-0.11", "emacs", "helix", "kate"}

#: How a request ends that the client has cancelled.
CANCELLED = {"error": {"code": -32800}}

#: Keys whose values are sentences, addresses of pages, versions of programs, drawn, or names that the server gives as it likes.
FREE = {"message", "title", "href", "version", "svg", "label", "detail", "documentation", "value", "tooltip", "filterText", "sortText", "contents", "resultId"}


def differs(recorded: Any, found: Any, at: str = "") -> str | None:
    """Where an answer has not what the recorded one had."""
    if isinstance(recorded, dict) and isinstance(found, dict):
        for key, value in recorded.items():
            if key not in FREE and (said := differs(value, found.get(key), f"{at}.{key}")):
                return said
        return None
    if isinstance(recorded, list) and isinstance(found, list):
        # Capabilities and lists of words may grow; answers may not.
        if len(recorded) != len(found) and not at.startswith(".capabilities"):
            return f"{at}: {len(recorded)} entries were recorded, {len(found)} found"
        if at.startswith(".capabilities"):
            return next((f"{at}: {one!r} is gone" for one in recorded if all(differs(one, other) for other in found)), None)
        return next((said for n, (one, other) in enumerate(zip(recorded, found, strict=True)) if (said := differs(one, other, f"{at}[{n}]"))), None)
    if at.startswith(".capabilities") and recorded is True and isinstance(found, dict):
        # What can be done at all, said in more detail.
        return None
    if isinstance(recorded, (int, float)) and isinstance(found, (int, float)) and not isinstance(recorded, bool):
        return None if math.isclose(recorded, found, rel_tol=1e-6, abs_tol=1e-6) else f"{at}: {recorded} was recorded, {found} found"
    return None if recorded == found else f"{at}: {recorded!r} was recorded, {found!r} found"


def whole(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def parts(session: list[dict[str, Any]]) -> list[list[dict[str, Any]]]:
    """The session, cut where the client started another server."""
    cut: list[list[dict[str, Any]]] = []
    for said in session:
        if said["from"] == "client" and said["message"].get("method") == "initialize":
            cut.append([])
        if cut:
            cut[-1].append(said)
    return cut


def of_version(message: dict[str, Any], at: tuple[str, Any]) -> bool:
    """A publish of one version of a document."""
    params = message.get("params") or {}
    return message.get("method") == "textDocument/publishDiagnostics" and (params["uri"], params.get("version")) == at


RECORDED = {path: whole(path) for path in SESSIONS}
CUT = [pytest.param(part, id=f"{path.stem} {number}") for path, session in RECORDED.items() for number, part in enumerate(parts(session), 1)]


@pytest.fixture(scope="module", autouse=True)
def keep_what_is_recorded_anew() -> Iterator[None]:
    yield
    if UPDATES:
        for path, session in RECORDED.items():
            if session != whole(path):
                lines = (json.dumps(said, ensure_ascii=False, separators=(",", ":")) for said in session)
                path.write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.mark.parametrize("said", CUT)
async def test_replay(stranger: Client, said: list[dict[str, Any]]) -> None:
    waiting: dict[Any, asyncio.Task[Any]] = {}
    numbers: dict[Any, int] = {}
    # Names of results, as they were and as they are.
    names: dict[Any, Any] = {}
    asked = {one["message"]["id"]: one["message"]["method"] for one in said if one["from"] == "server" and {"method", "id"} <= set(one["message"])}
    # What the server asks is answered where the client once did: settings hold from there on.
    unanswered: dict[str, list[asyncio.Future[Any]]] = {method: [] for method in asked.values()}

    def later(method: str) -> asyncio.Future[Any]:
        unanswered[method].append(asyncio.get_running_loop().create_future())
        return unanswered[method][-1]

    for method in unanswered:
        stranger.answers[method] = lambda params, method=method: later(method)
    cancelled = {one["message"]["params"]["id"] for one in said if one["message"].get("method") == "$/cancelRequest"}
    compared = 0
    for place, (message, by) in enumerate((one["message"], one["from"]) for one in said):
        if by == "client" and "method" in message:
            method, params = message["method"], message.get("params")
            if method == "initialize":
                stranger.capabilities = default_converter().structure(params["capabilities"], types.ClientCapabilities)
            if method == "$/cancelRequest":
                stranger.tell(method, {"id": numbers[params["id"]]})
                continue
            if isinstance(params, dict) and "previousResultId" in params:
                params = {**params, "previousResultId": names.get(params["previousResultId"], params["previousResultId"])}
            if "id" in message:
                waiting[message["id"]] = asyncio.ensure_future(stranger.ask(method, params))
                # The task sends at its first turn; what comes after must come after.
                await asyncio.sleep(0)
                numbers[message["id"]] = stranger.last_number
            else:
                stranger.tell(method, params)
        elif by == "client" and message.get("id") in asked:
            method = asked[message["id"]]
            await stranger.until(lambda method=method: unanswered[method], f"request {method} of the server")
            number = stranger.protocol.questions[method].pop(0)
            unanswered[method].pop(0).set_result(message.get("result"))
            # It is sent at one of the loop's next turns, and before what follows.
            while number not in stranger.protocol.answered:
                await asyncio.sleep(0)
        elif by == "server" and "method" not in message and message.get("id") in waiting:
            try:
                found: Any = {"result": await waiting.pop(message["id"])}
            except JsonRpcException as error:
                found = {"error": {"code": error.code}}
            if message["id"] in cancelled:
                # Whether the answer or its end is faster is chance: what was recorded is never brought up to date where it is the end.
                assert found == CANCELLED or "result" in found, found
                continue
            if "error" in message:
                assert found == {"error": {"code": message["error"]["code"]}}
            else:
                assert "error" not in found, found
                difference = differs(message["result"], found["result"])
                if difference and UPDATES:
                    message["result"] = found["result"]
                else:
                    assert difference is None, difference
                if isinstance(message["result"], dict) and "resultId" in message["result"]:
                    names[message["result"]["resultId"]] = found["result"].get("resultId")
            compared += 1
        elif message.get("method") == "textDocument/publishDiagnostics":
            params = message["params"]
            at = (params["uri"], params.get("version"))
            # Other settings give one version other diagnostics: it is waited for these, or for those of the same version that came after
            # them, since a publish that is overtaken may be left out.
            behind = [one["message"]["params"]["diagnostics"] for one in said[place:] if of_version(one["message"], at)]
            try:
                await stranger.until(lambda at=at, behind=behind: any(differs(one, stranger.published.get(at)) is None for one in behind), "publish", 10)
            except AssertionError:
                if UPDATES and at in stranger.published:
                    params["diagnostics"] = stranger.published[at]
                    continue
                raise AssertionError(f"{at} {differs(params['diagnostics'], stranger.published.get(at))}") from None
            compared += 1
    for task in waiting.values():
        task.cancel()
    assert compared >= 2, "the session holds nothing to compare"


def test_every_client_has_a_session() -> None:
    assert {path.stem for path in SESSIONS} >= CLIENTS


@pytest.mark.parametrize("path", SESSIONS, ids=lambda path: path.stem)
def test_sessions_are_small_and_of_no_one_in_particular(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert len(text) < 200_000
    assert "/home/" not in text and "/tmp/" not in text and "/root/" not in text
    assert all(one["message"]["params"].get("processId") is None for part in parts(whole(path)) for one in part[:1])

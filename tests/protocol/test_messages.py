"""What is told to the server, and what it tells and asks by itself: notifications, edits, settings, progress, the handshake."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
from conftest import CAPABILITIES, ROOT, Client, check_schema, check_standard, error_of
from documents import CAD, PROGRAM, QUARTER, open_everything, plate
from expected import differs, near
from lsprotocol import types
from pygls.exceptions import JsonRpcException


async def test_findings_are_as_the_schema_says(client: Client) -> None:
    await open_everything(client)
    for (uri, version), diagnostics in client.published.items():
        for diagnostic in diagnostics:
            check_schema({"$ref": "#/$defs/Diagnostic"}, diagnostic)
            assert diagnostic["source"] == "wedm" and version == 1, uri
    (fault,) = [one for one in client.published[CAD, 1] if one["severity"] == 1]
    assert differs({"code": "small-radius", "range": {"start": {"line": 1}}, "data": {"handle": "2A", "segment": 1, "radius": near(0.05)}}, fault) is None


async def test_a_repair_is_asked_of_the_client_and_its_answer_passed_on(client: Client) -> None:
    await open_everything(client)
    answers = [{"applied": True}, {"applied": False, "failureReason": "the layer is locked"}]
    for answer in answers:
        client.answers["wedm/applyDrawingEdit"] = lambda params, answer=answer: answer
        edit = {"uri": CAD, "version": 1, "changes": [{"handle": "2A", "vertices": {"start": 1, "deleteCount": 2, "insert": [[19, 0, QUARTER], [20, 1]]}}]}
        assert await client.ask("workspace/executeCommand", {"command": "wedm.applyDrawingEdit", "arguments": [edit]}) == answer
        check_schema({"$ref": "#/$defs/ApplyDrawingEdit"}, client.params_of("wedm/applyDrawingEdit")[-1])
    # The client says itself what it did.
    client.tell("wedm/didChangeDrawing", {"drawing": {"uri": CAD, "version": 2}, "changes": edit["changes"]})
    assert [one for one in await client.publish(CAD, 2) if one["severity"] == 1] == []


async def test_a_client_that_has_not_declared_it_is_not_asked(stranger: Client) -> None:
    await stranger.initialize(capabilities={})
    await stranger.open_drawing(CAD, plate("2A", 0.05))
    with pytest.raises(JsonRpcException) as failed:
        await stranger.ask("workspace/executeCommand", {"command": "wedm.applyDrawingEdit", "arguments": [{"uri": CAD, "version": 1, "changes": []}]})
    assert error_of(failed)[0] == -32803
    stranger.tell("wedm/didChangeDrawing", {"drawing": {"uri": CAD, "version": 2}, "changes": [{"handle": "ZZ", "entity": None}]})
    await stranger.until(lambda: stranger.params_of("window/logMessage"), "log line")
    await stranger.ask("wedm/inspect", {"uri": CAD})
    asked_of_it = {method for method, _ in stranger.heard} - {"window/logMessage", "textDocument/publishDiagnostics"}
    assert asked_of_it == set()


UNSOUND = [
    [{"handle": "ZZ", "entity": None}],
    [{"handle": "2A", "vertices": {"start": 4, "deleteCount": 9, "insert": []}}],
    [{"handle": "2A", "vertices": {"start": 0, "deleteCount": 1, "insert": [[None, 0]]}}],
    [{"handle": "2A", "entity": None}, {"handle": "2A", "entity": None}],
    [{"handle": "C", "entity": {"handle": "C", "type": "circle", "center": [0, 0], "radius": "NaN"}}],
]


@pytest.mark.parametrize("changes", UNSOUND)
async def test_a_change_that_does_not_apply_changes_nothing_and_the_drawing_is_asked_for(client: Client, changes: list[Any]) -> None:
    await open_everything(client)
    whole = {"uri": CAD, "version": 3, "entities": [plate("2A", 2.0)]}
    client.answers["wedm/resendDrawing"] = lambda params: {"drawing": whole}
    client.tell("wedm/didChangeDrawing", {"drawing": {"uri": CAD, "version": 2}, "changes": changes})
    assert [one for one in await client.publish(CAD, 3) if one["severity"] == 1] == []
    assert client.params_of("wedm/resendDrawing") == [{"uri": CAD}]
    assert client.params_of("window/logMessage"), "the reason is logged"
    assert len((await client.ask("wedm/inspect", {"uri": CAD}))["entities"]) == 1


async def test_drawings_are_opened_changed_and_closed(client: Client) -> None:
    await client.open_drawing(CAD, plate("2A", 2.0))
    for version, radius in enumerate([0.05, 3.0, 0.08], 2):
        splice = {"start": 1, "deleteCount": 2, "insert": [[20 - radius, 0, QUARTER], [20, radius]]}
        client.tell("wedm/didChangeDrawing", {"drawing": {"uri": CAD, "version": version}, "changes": [{"handle": "2A", "vertices": splice}]})
        found = [one["code"] for one in await client.publish(CAD, version) if one["severity"] == 1]
        assert found == (["small-radius"] if radius < 0.1 else [])
    client.tell("wedm/didCloseDrawing", {"drawing": {"uri": CAD}})
    assert await client.publish(CAD, None) == []
    with pytest.raises(JsonRpcException, match="is not open"):
        await client.ask("wedm/inspect", {"uri": CAD})


async def test_texts_are_opened_changed_saved_and_closed(client: Client) -> None:
    uri = await client.open_text("tight_fillet.dxf")
    changes = [{"range": {"start": {"line": 37, "character": 0}, "end": {"line": 37, "character": 5}}, "text": "18.0"},
               {"range": {"start": {"line": 45, "character": 0}, "end": {"line": 45, "character": 4}}, "text": "2.0"}]  # fmt: skip
    client.tell("textDocument/didChange", {"textDocument": {"uri": uri, "version": 2}, "contentChanges": changes})
    assert [one for one in await client.publish(uri, 2) if one["severity"] == 1] == []
    client.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
    client.tell("textDocument/didClose", {"textDocument": {"uri": uri}})
    assert await client.publish(uri, None) == []


async def test_settings_come_in_three_ways(client: Client) -> None:
    uri = await client.open_text("tight_fillet.dxf")
    errors = [one["code"] for one in client.published.pop((uri, 1)) if one["severity"] == 1]
    assert errors == ["small-radius"]
    # Asked for, because it was declared; with null for what is not set.
    client.answers["workspace/configuration"] = lambda params: [{"correction": 0.04, "gap": None} for _ in params["items"]]
    client.tell("workspace/didChangeConfiguration", {"settings": None})
    await client.until(lambda: client.published.get((uri, 1)) == [], "diagnostics under the new settings")
    assert client.params_of("workspace/configuration")[0]["items"][0]["section"] == "wedm"
    # A value that does not fit is said.
    client.answers["workspace/configuration"] = lambda params: [{"correction": "wide"} for _ in params["items"]]
    client.tell("workspace/didChangeConfiguration", {"settings": None})
    await client.until(lambda: client.params_of("window/showMessage"), "a message")
    assert "correction" in client.params_of("window/showMessage")[0]["message"]
    # The registrations that were declared.
    registered = [one["method"] for params in client.params_of("client/registerCapability") for one in params["registrations"]]
    assert {"workspace/didChangeConfiguration", "workspace/didChangeWatchedFiles"} <= set(registered)


def problems(client: Client, uri: str, version: Any = 1) -> list[str]:
    return [one["code"] for one in client.published.get((uri, version), []) if one["severity"] == 1]


async def test_a_settings_file_that_comes_and_goes(client: Client, tmp_path: Path) -> None:
    drawing, settings = tmp_path / "die.dxf", tmp_path / "wedm.toml"
    drawing.write_text((ROOT / "tests/data/tight_fillet.dxf").read_text())
    uri = drawing.as_uri()
    client.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "dxf", "version": 1, "text": drawing.read_text()}})
    await client.until(lambda: problems(client, uri) == ["small-radius"], "the fault")
    for kind, text, expected in [(1, "correction = 0.04\n", []), (2, "correction = 0.06\n", ["small-radius"]), (3, None, ["small-radius"])]:
        client.published.pop((uri, 1), None)
        settings.write_text(text) if text is not None else settings.unlink()
        client.tell("workspace/didChangeWatchedFiles", {"changes": [{"uri": settings.as_uri(), "type": kind}]})
        await client.until(lambda: (uri, 1) in client.published, "diagnostics under other settings")
        assert problems(client, uri) == expected, text


async def test_folders_that_come_and_go(client: Client, tmp_path: Path) -> None:
    """They are where the settings of drawings without a file come from."""
    (tmp_path / "wedm.toml").write_text("correction = 0.04\n")
    await client.open_drawing(CAD, plate("2A", 0.05))
    assert problems(client, CAD) == ["small-radius"]
    folder = {"uri": tmp_path.as_uri(), "name": "dies"}
    for added, removed, expected in [([folder], [], []), ([], [folder], ["small-radius"])]:
        client.tell("workspace/didChangeWorkspaceFolders", {"event": {"added": added, "removed": removed}})
        in_force = await client.ask("wedm/settings", {"uri": CAD})
        assert in_force["correctionFrom"] == ("file" if added else "default")
        await client.until(lambda: problems(client, CAD) == expected, "diagnostics under other settings")


async def test_a_program_is_scaled_by_an_edit_that_the_client_makes(client: Client) -> None:
    await open_everything(client)
    for answer in ({"applied": True}, {"applied": False, "failureReason": "the file is read-only"}):
        client.answers["workspace/applyEdit"] = lambda params, answer=answer: answer
        assert await client.ask("workspace/executeCommand", {"command": "wedm.scale", "arguments": [{"uri": PROGRAM, "factor": 2}]}) == answer
    (change,) = client.params_of("workspace/applyEdit")[0]["edit"]["documentChanges"]
    assert change["textDocument"] == {"uri": PROGRAM, "version": 1}
    assert any("19800" in edit["newText"] for edit in change["edits"])


async def test_settings_of_initialize(stranger: Client) -> None:
    await stranger.initialize(initializationOptions={"wedm": {"correction": 0.04}})
    uri = await stranger.open_text("tight_fillet.dxf")
    assert stranger.published[uri, 1] == []


async def test_progress_of_long_requests(client: Client) -> None:
    await open_everything(client)
    await client.ask("wedm/inspect", {"uri": CAD, "workDoneToken": "t1"})
    await client.until(lambda: any(one["value"]["kind"] == "end" for one in client.params_of("$/progress")), "end of the progress")
    assert [one["value"]["kind"] for one in client.params_of("$/progress")][0] == "begin"


@pytest.mark.parametrize(
    ("frame", "code"),
    [
        (b"Content-Length: 9\r\n\r\n{no json}", "-32700"),
        (b'Content-Length: 17\r\n\r\n{"jsonrpc":"2.0"}', "-32600"),
        (b"Content-Length: many\r\n\r\n", "-32700"),
    ],
)
async def test_broken_frames_are_answered_and_the_server_goes_on(client: Client, frame: bytes, code: str) -> None:
    client.protocol.writer.write(frame)
    await client.open_drawing(CAD, plate("2A", 0.05))
    assert await client.ask("wedm/inspect", {"uri": CAD})


async def test_the_encoding_of_positions_is_the_clients_choice(stranger: Client) -> None:
    answer = await stranger.initialize(capabilities={})
    assert answer["capabilities"]["positionEncoding"] == "utf-16"


async def test_the_handshake(client: Client) -> None:
    answer = client.initialized
    assert answer["serverInfo"]["name"] == "wedm"
    assert answer["capabilities"]["experimental"]["wedm"] == {"protocol": 1}
    assert answer["capabilities"]["positionEncoding"] == "utf-8"
    assert "diagnosticProvider" not in answer["capabilities"], "diagnostics come one way only"
    check_standard(types.INITIALIZE, answer)
    assert CAPABILITIES["experimental"]["wedm"]["applyDrawingEdit"]


async def test_a_cancelled_request_ends(client: Client) -> None:
    # A drawing on which the answer takes a while.
    circles = [{"handle": f"{i:X}", "type": "circle", "center": [i % 100 * 10, i // 100 * 10], "radius": 3} for i in range(5_000)]
    await client.open_drawing("cad:long", *circles)
    waiting = asyncio.ensure_future(client.ask("wedm/picture", {"uri": "cad:long"}))
    await asyncio.sleep(0)
    client.tell("$/cancelRequest", {"id": client.last_number})
    with pytest.raises(JsonRpcException) as failed:
        await waiting
    assert error_of(failed)[0] == -32800

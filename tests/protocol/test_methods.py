"""Every method that the server announces or the page on the protocol names, as a client that knows nothing else sees it.

A method without a case here fails `test_every_method_has_a_case`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import pytest
import test_messages
from conftest import SCHEMA, Client, check_schema, check_standard, error_of, methods_of, methods_of_the_page, methods_of_the_source, notifications_of
from documents import CAD, DXF, PROGRAM, UNTIDY, open_everything
from expected import Every, anything, differs, near, some, text
from pygls.exceptions import JsonRpcException


@dataclass
class Case:
    method: str
    uri: str
    expected: Any
    params: dict[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.method} of {self.uri.rsplit('/', 1)[-1]}"


def at(line: int, character: int) -> dict[str, Any]:
    return {"position": {"line": line, "character": character}}


def lines(first: int, last: int) -> dict[str, Any]:
    return {"range": {"start": {"line": first, "character": 0}, "end": {"line": last, "character": 0}}}


FORMAT = {"options": {"tabSize": 4, "insertSpaces": True}}

#: The line, from 0, of the bulge at fault in tight_fillet.dxf.
BULGE = 41

#: A contour that is cut twice.
PAIR = {"side": "both", "wireDiameter": 0.18, "gap": 0.01, "pair": {"drawnAs": "punch", "clearance": 0.01}}

# A test piece cut with 0.155 mm.
OUTER = {"kind": "outer", "nominal": 20, "measured": 20.006}
INNER = {"kind": "inner", "nominal": 10, "measured": 9.994}

CASES = [
    Case("textDocument/hover", DXF, {"contents": anything, "range": anything}, at(BULGE, 2)),
    Case("textDocument/hover", PROGRAM, {"contents": anything}, at(2, 6)),
    Case("textDocument/hover", CAD, None, at(0, 0)),
    Case("textDocument/codeLens", PROGRAM, some({"command": {"command": "wedm.simulate", "arguments": [PROGRAM]}})),
    Case("textDocument/signatureHelp", PROGRAM, {"signatures": anything}, at(1, 6)),
    Case("textDocument/completion", DXF, anything, at(BULGE - 1, 1)),
    Case("textDocument/definition", DXF, [{"uri": DXF}], at(21, 1)),
    Case("textDocument/references", DXF, some({"uri": DXF}), {**at(21, 1), "context": {"includeDeclaration": True}}),
    Case("textDocument/documentHighlight", DXF, some({"range": anything}), at(21, 1)),
    Case("textDocument/documentSymbol", DXF, some({"name": text("ENTITIES")})),
    Case("textDocument/documentSymbol", PROGRAM, anything),
    Case("textDocument/foldingRange", DXF, some({"startLine": anything})),
    Case("textDocument/selectionRange", DXF, [{"range": anything, "parent": anything}], {"positions": [{"line": BULGE, "character": 3}]}),
    Case("textDocument/inlayHint", DXF, some({"label": text("R 0.05 mm")}), lines(0, 80)),
    Case("textDocument/inlayHint", PROGRAM, anything, lines(0, 5)),
    Case("textDocument/semanticTokens/full", DXF, {"data": anything}),
    Case("textDocument/semanticTokens/range", DXF, {"data": anything}, lines(30, 50)),
    Case("textDocument/semanticTokens/full/delta", DXF, anything, {"previousResultId": "none"}),
    Case("textDocument/formatting", UNTIDY, some({"newText": text("B9900B0B9900GXL1")}), FORMAT),
    Case("textDocument/rangeFormatting", PROGRAM, Every(lambda value: value is None or isinstance(value, list), "edits"), {**lines(1, 3), **FORMAT}),
    Case("textDocument/onTypeFormatting", PROGRAM, Every(lambda value: value is None or isinstance(value, list), "edits"), {**at(2, 0), "ch": "\n", **FORMAT}),
    Case("textDocument/prepareRename", PROGRAM, anything, at(1, 1)),
    Case("textDocument/rename", PROGRAM, {"documentChanges": anything}, {**at(1, 1), "newName": "N77"}),
    Case(
        "textDocument/codeAction",
        DXF,
        [
            {"kind": "quickfix", "isPreferred": True, "title": text("R 0.101"), "edit": {"documentChanges": [{"textDocument": {"uri": DXF, "version": 1}}]}},
            {"kind": "quickfix", "title": text("Keep the end points")},
            {"kind": "source.fixAll.wedm", "data": {"uri": DXF, "version": 1, "repaired": 1, "left": 0, "said": text("1 finding repaired, none left")}},
        ],
        {**lines(BULGE, BULGE), "context": {"diagnostics": []}},
    ),
    Case(
        "textDocument/codeAction",
        CAD,
        some({"kind": "quickfix", "command": {"command": "wedm.applyDrawingEdit", "arguments": [{"uri": CAD, "version": 1, "changes": anything}]}}),
        {**lines(1, 1), "context": {"diagnostics": [], "only": ["quickfix"]}},
    ),
    Case("wedm/inspect", DXF, {"unitsToMm": 1.0, "entities": [{"handle": "2A", "layer": "DIE", "segments": some({"radius": near(0.05), "verdict": "small-radius"})}]}),
    Case("wedm/inspect", CAD, {"entities": [{"handle": "2A"}]}, {"handle": "2A"}),
    Case("wedm/contours", CAD, {"contours": [{"closed": True, "direction": "ccw", "role": "opening", "gaps": []}, {"handle": None}]}),
    Case("wedm/toolpath", DXF, {"paths": some({"contour": 0, "part": "plate"}), "holes": some({"part": "punch"}), "parts": [{"part": "punch", "corrections": [near(0.1)]}, {"part": "plate", "work": {"cuts": some({"pass": 1})}}]}, {"options": PAIR}),
    Case("wedm/toolpath", "cad:clean", {"paths": [{"contour": 0, "pass": 1, "correction": near(0.1)}]}),
    Case("wedm/picture", CAD, {"svg": text("<svg", 'data-handle="2A"')}),
    Case("wedm/export", CAD, {"data": text("iVBORw0KGgo")}, {"format": "png"}),
    Case("wedm/export", PROGRAM, {"data": text("JVBERi0")}, {"format": "pdf"}),
    Case("wedm/holes", "cad:clean", {"data": text("ZHJhd2luZyx4X21tLHlfbW0s")}, {"format": "csv"}),
    Case("wedm/holes", "cad:clean", {"data": anything}, {"format": "dxf"}),
    Case("wedm/repairs", DXF, {"repairs": some({"title": text("R 0.101"), "segments": some({"radius": near(0.101)})})}, {"rule": "small-radius", "handle": "2A", "segment": 1}),
    Case("wedm/repairs", CAD, {"repairs": []}, {"rule": "small-radius", "handle": "2A", "segment": 0}),
    Case("wedm/locate", DXF, {"handle": "2A", "segment": 1, "range": {"start": {"line": BULGE}}}, at(BULGE, 0)),
    Case("wedm/locate", DXF, {"handle": "2A", "segment": 1, "range": {"start": {"line": BULGE}}}, {"handle": "2A", "segment": 1}),
    Case("wedm/rulePage", DXF, {"text": anything}, {"rule": "small-radius"}),
    Case("wedm/calibrate", DXF, {"passes": [{"pass": 1, "features": 2, "halfKerf": near(0.152), "gap": near(0.027)}]}, {"measurements": [OUTER, INNER], "corrections": [0.155], "wireDiameter": 0.25}),
    Case("wedm/settings", DXF, {"correction": near(0.1), "correctionFrom": "default", "side": "both", "unitsToMm": 1.0, "unitsFrom": anything, "said": text("correction 0.100 mm (default), both sides (default), mm (")}),
    Case(
        "wedm/generate",
        "cad:clean",
        {"program": text("D3", "D4"), "offsets": [{"register": "D3", "correction": 0.15}, {"register": "D4", "correction": 0.1}]},
        {
            "format": "iso",
            "options": {
                "passes": {"corrections": [0.15, 0.1], "registers": ["D3", "D4"]},
                "program": {"compensation": "controller"},
            },
        },
    ),
    Case("wedm/generate", "cad:clean", {"program": text("B", "DD"), "blocks": anything, "warnings": some({"code": "sharp-corner"})}, {"format": "3b"}),
    Case("wedm/fit", DXF, {"fits": False, "clearance": near(0.01), "places": some({"handle": "2A", "of": "plate"}), "svg": text("<svg")}, {"options": PAIR}),
    Case("wedm/pair", DXF, {"programs": [{"part": "punch", "corrections": [near(0.1)]}, {"part": "plate", "program": text("DD")}]}, {"format": "3b", "force": True, "options": PAIR}),
    Case("wedm/simulate", PROGRAM, {"blocks": anything}),
]

#: What is asked of the client, told to it, or told by it, with the test of `test_messages` that holds it to be so.
ELSEWHERE = {
    "wedm/didOpenDrawing": "test_drawings_are_opened_changed_and_closed",
    "wedm/didChangeDrawing": "test_drawings_are_opened_changed_and_closed",
    "wedm/didCloseDrawing": "test_drawings_are_opened_changed_and_closed",
    "wedm/applyDrawingEdit": "test_a_repair_is_asked_of_the_client_and_its_answer_passed_on",
    "wedm/resendDrawing": "test_a_change_that_does_not_apply_changes_nothing_and_the_drawing_is_asked_for",
    "textDocument/publishDiagnostics": "test_findings_are_as_the_schema_says",
    "workspace/executeCommand": "test_a_repair_is_asked_of_the_client_and_its_answer_passed_on",
    "workspace/applyEdit": "test_a_program_is_scaled_by_an_edit_that_the_client_makes",
    "workspace/configuration": "test_settings_come_in_three_ways",
    "workspace/didChangeConfiguration": "test_settings_come_in_three_ways",
    "workspace/didChangeWatchedFiles": "test_a_settings_file_that_comes_and_goes",
    "workspace/didChangeWorkspaceFolders": "test_folders_that_come_and_go",
    "client/registerCapability": "test_settings_come_in_three_ways",
    "window/workDoneProgress/create": "test_progress_of_long_requests",
    "window/logMessage": "test_a_change_that_does_not_apply_changes_nothing_and_the_drawing_is_asked_for",
    "window/showMessage": "test_settings_come_in_three_ways",
    "textDocument/didOpen": "test_texts_are_opened_changed_saved_and_closed",
    "textDocument/didChange": "test_texts_are_opened_changed_saved_and_closed",
    "textDocument/didSave": "test_texts_are_opened_changed_saved_and_closed",
    "textDocument/didClose": "test_texts_are_opened_changed_saved_and_closed",
}


def asked(case: Case) -> dict[str, Any]:
    document = {"uri": case.uri} if case.method.startswith("wedm/") else {"textDocument": {"uri": case.uri}}
    return {**document, **case.params}


@pytest.mark.parametrize("case", CASES, ids=str)
async def test_answers(client: Client, case: Case) -> None:
    await open_everything(client)
    result = await client.ask(case.method, asked(case))
    assert differs(case.expected, result) is None, differs(case.expected, result)
    if case.method.startswith("wedm/"):
        check_schema(SCHEMA["methods"][case.method]["result"], result)
    else:
        check_standard(case.method, result)


async def test_every_method_has_a_case(client: Client) -> None:
    assert methods_of_the_source() == set(SCHEMA["methods"])
    tested = {case.method for case in CASES} | set(ELSEWHERE)
    capabilities = client.initialized["capabilities"]
    announced = methods_of(capabilities) | notifications_of(capabilities) | set(SCHEMA["methods"]) | methods_of_the_page()
    assert announced - tested == set()
    assert {test for test in ELSEWHERE.values() if not hasattr(test_messages, test)} == set()
    assert client.initialized["capabilities"]["executeCommandProvider"]["commands"] == list(SCHEMA["commands"])
    assert {case.method for case in CASES} - announced == set(), "cases of methods that are not there"
    # Each request of the name space is refused in some way of its own, but for one that takes any document.
    asked_of_it = {method for method, what in SCHEMA["methods"].items() if "result" in what and what.get("sentBy") != "server"}
    assert asked_of_it - {refusal[0] for refusal in REFUSALS} == set()


METHODS = sorted({case.method for case in CASES} | {"workspace/executeCommand"})


@pytest.mark.parametrize("method", METHODS)
async def test_before_the_handshake(stranger: Client, method: str) -> None:
    with pytest.raises(JsonRpcException) as failed:
        await stranger.ask(method, {"uri": CAD, "textDocument": {"uri": CAD}})
    assert error_of(failed)[0] == -32002


async def test_after_the_shutdown(client: Client) -> None:
    assert await client.ask("shutdown") is None
    for method in METHODS:
        with pytest.raises(JsonRpcException) as failed:
            await client.ask(method, {"uri": CAD, "textDocument": {"uri": CAD}})
        assert error_of(failed)[0] == -32600, method
    client.tell("exit", None)
    assert await client._server.wait() == 0


@pytest.mark.parametrize("params", [None, {}, {"uri": 7, "textDocument": {"uri": 7}}, ["no", "object"]])
async def test_params_that_do_not_fit(client: Client, params: Any) -> None:
    await open_everything(client)
    for method in METHODS:
        with pytest.raises(JsonRpcException) as failed:
            await client.ask(method, params)
        assert error_of(failed)[0] in (-32602, -32600), f"{method} {params}: {error_of(failed)}"
    # And it goes on.
    assert await client.ask("wedm/inspect", {"uri": CAD})


@pytest.mark.parametrize("case", [case for case in CASES if case.uri in (DXF, CAD, PROGRAM) and case.method not in ("wedm/settings", "wedm/rulePage", "wedm/calibrate")], ids=str)
async def test_a_document_that_is_not_open(client: Client, case: Case) -> None:
    params = asked(Case(case.method, case.uri.replace("session", "nowhere").replace("plate", "none"), None, case.params))
    if case.method.startswith("wedm/") or case.method == "textDocument/codeAction":
        with pytest.raises(JsonRpcException, match="is not open") as failed:
            await client.ask(case.method, params)
        assert error_of(failed)[0] == -32602
    else:
        try:
            assert await client.ask(case.method, params) is None
        except JsonRpcException as error:
            assert error.code == -32602


REFUSALS = [
    ("wedm/generate", {"uri": CAD, "format": "3b"}, -32803, "error"),
    ("wedm/generate", {"uri": CAD, "format": "9b"}, -32602, '"9b"'),
    ("wedm/generate", {"uri": CAD, "format": "3b", "handles": ["ZZ"]}, -32602, "ZZ"),
    ("wedm/generate", {"uri": "cad:clean", "format": "3b", "options": {"correction": -1}}, -32602, "correction"),
    ("wedm/generate", {"uri": "cad:clean", "format": "3b", "options": {"program": {"entry": [500, 500]}}}, -32803, "entry"),
    ("wedm/generate", {"uri": DXF, "format": "3b", "force": True}, -32803, "is not known"),
    ("wedm/toolpath", {"uri": DXF}, -32803, "is not known"),
    ("wedm/inspect", {"uri": CAD, "handle": "ZZ"}, -32602, "ZZ"),
    ("wedm/locate", {"uri": CAD, "handle": "2A"}, -32803, ""),
    ("wedm/locate", {"uri": DXF, "handle": "ZZ"}, -32602, "ZZ"),
    ("wedm/generate", {"uri": PROGRAM, "format": "3b"}, -32803, "is a program, expected a drawing"),
    ("wedm/toolpath", {"uri": PROGRAM}, -32803, "is a program, expected a drawing"),
    ("wedm/inspect", {"uri": PROGRAM}, -32803, "is a program, expected a drawing"),
    ("wedm/contours", {"uri": PROGRAM}, -32803, "is a program, expected a drawing"),
    ("wedm/picture", {"uri": CAD, "options": {"correction": "wide"}}, -32602, "correction"),
    ("wedm/picture", {"uri": CAD, "options": {"nosuch": 1}}, -32602, "nosuch"),
    ("wedm/export", {"uri": CAD, "format": "jpg"}, -32602, "jpg"),
    ("wedm/holes", {"uri": CAD, "format": "txt"}, -32602, "txt"),
    ("wedm/holes", {"uri": DXF, "format": "csv"}, -32803, "is not known"),
    ("wedm/holes", {"uri": PROGRAM, "format": "csv"}, -32803, "is a program, expected a drawing"),
    ("wedm/repairs", {"uri": PROGRAM, "rule": "small-radius", "handle": "2A"}, -32803, ""),
    ("wedm/fit", {"uri": CAD}, -32803, "set pair.drawn-as, pair.clearance, wire-diameter and gap"),
    ("wedm/fit", {"uri": CAD, "options": {"pair": {"clearance": 0.01, "drawnAs": "punch"}}}, -32602, "expected wire-diameter and gap as well"),
    ("wedm/pair", {"uri": DXF, "format": "3b", "options": PAIR}, -32803, "error"),
    ("wedm/simulate", {"uri": CAD}, -32803, "is a drawing, expected a program"),
    ("wedm/simulate", {"uri": PROGRAM, "feed": "fast"}, -32602, "fast"),
    ("wedm/simulate", {"uri": PROGRAM, "feed": -1}, -32602, "feed is -1, expected mm/min above 0"),
    ("wedm/calibrate", {"measurements": [OUTER], "corrections": [-0.1]}, -32602, "expected a length"),
    ("wedm/calibrate", {"measurements": [], "corrections": [0.1]}, -32602, "no measurement is in it"),
    ("wedm/calibrate", {"measurements": [OUTER, {**INNER, "measured": 10.4}], "corrections": [0.155]}, -32803, "outer"),
    ("wedm/rulePage", {"rule": "tight"}, -32602, "no rule named tight"),
    ("wedm/settings", {"uri": 7}, -32602, "expected a string"),
    ("wedm/locate", {"uri": DXF}, -32602, "either position or handle"),
    ("wedm/locate", {"uri": DXF, "handle": "2A", "segment": 99}, -32602, "99"),
    ("wedm/locate", {"uri": PROGRAM, "position": {"line": 0, "character": 0}}, -32803, "not DXF text"),
    ("textDocument/rename", {"textDocument": {"uri": PROGRAM}, "position": {"line": 1, "character": 1}, "newName": "N2"}, -32803, "N2 is the block in line 3"),
    ("textDocument/rename", {"textDocument": {"uri": PROGRAM}, "position": {"line": 1, "character": 1}, "newName": "zz"}, -32803, "not a block number"),
    ("textDocument/rename", {"textDocument": {"uri": PROGRAM}, "position": {"line": 4, "character": 0}, "newName": "N9"}, -32803, "no block number"),
    ("workspace/executeCommand", {"command": "wedm.scale", "arguments": []}, -32602, "one argument"),
    ("workspace/executeCommand", {"command": "wedm.scale", "arguments": [{"uri": PROGRAM, "factor": -1}]}, -32803, "the factor is -1"),
    ("workspace/executeCommand", {"command": "wedm.scale", "arguments": [{"uri": DXF, "factor": 2}]}, -32803, "is not a program"),
    ("workspace/executeCommand", {"command": "wedm.scale", "arguments": [{"uri": "file:///none.3b", "factor": 2}]}, -32602, "is not open"),
    ("workspace/executeCommand", {"command": "wedm.no", "arguments": []}, -32602, "wedm.no"),
    ("workspace/executeCommand", {"command": "wedm.applyDrawingEdit", "arguments": []}, -32602, ""),
    ("workspace/executeCommand", {"command": "wedm.applyDrawingEdit", "arguments": [{"uri": CAD, "version": 7, "changes": []}]}, -32801, ""),
    ("textDocument/noSuch", {}, -32601, ""),
    ("wedm/noSuch", {}, -32601, ""),
]


@pytest.mark.parametrize(("method", "params", "code", "said"), REFUSALS)
async def test_refusals(client: Client, method: str, params: dict[str, Any], code: int, said: str) -> None:
    await open_everything(client)
    with pytest.raises(JsonRpcException) as failed:
        await client.ask(method, params)
    found, message, data = error_of(failed)
    assert (found, said in message) == (code, True), (found, message)
    assert message and not message.endswith(".")
    if isinstance(data, dict) and "diagnostics" in data:
        check_schema(SCHEMA["methods"]["wedm/generate"]["errorData"], data)

"""A client of pytest-lsp on the real server, which speaks plain JSON: what is sent and compared is what goes over the pipe."""

from __future__ import annotations

import asyncio
import inspect
import itertools
import json
import os
import re
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest
import pytest_lsp
from jsonschema import Draft202012Validator
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.protocol import JsonRPCNotification, JsonRPCRequestMessage, JsonRPCResponseMessage, default_converter
from pytest_lsp import ClientServerConfig, LanguageClient
from pytest_lsp.protocol import LanguageClientProtocol

ROOT = Path(__file__).resolve().parents[2]
WEDM = os.environ.get("WEDM") or str(ROOT / "target/release/wedm")
SCHEMA: dict[str, Any] = json.loads((ROOT / "docs/protocol.schema.json").read_text())
PROTOCOL = (ROOT / "docs/protocol.md").read_text()
#: What is asked about texts has a page of its own.
EDITING = (ROOT / "docs/editing.md").read_text()

#: What a client can declare that the server makes use of.
CAPABILITIES: dict[str, Any] = {
    "general": {"positionEncodings": ["utf-8", "utf-16"]},
    "window": {"workDoneProgress": True},
    "workspace": {
        "configuration": True,
        "applyEdit": True,
        "workspaceEdit": {"documentChanges": True},
        "didChangeConfiguration": {"dynamicRegistration": True},
        "didChangeWatchedFiles": {"dynamicRegistration": True},
    },
    "textDocument": {"documentSymbol": {"hierarchicalDocumentSymbolSupport": True}, "publishDiagnostics": {"versionSupport": True}},
    "experimental": {"wedm": {"applyDrawingEdit": True, "resendDrawing": True, "codeLens": True}},
}


def pytest_configure() -> None:
    if not os.access(WEDM, os.X_OK):
        pytest.exit(f"{WEDM} is not a program: build it with `cargo build --release`, or name it in WEDM", returncode=2)


class Plain(LanguageClientProtocol):
    """Leaves every message as JSON gives it, and knows what it has answered."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        #: Ids of the server's requests by method, as they came.
        self.questions: dict[str, list[Any]] = {}
        #: Ids of those to which the answer was sent.
        self.answered: set[Any] = set()

    def _handle_request(self, msg_id: Any, method_name: str, params: Any) -> None:
        self.questions.setdefault(method_name, []).append(msg_id)
        super()._handle_request(msg_id, method_name, params)

    def _send_response(self, msg_id: Any, *args: Any, **kwargs: Any) -> None:
        super()._send_response(msg_id, *args, **kwargs)
        self.answered.add(msg_id)

    def get_message_type(self, method: str) -> Any:
        return None

    def get_result_type(self, method: str) -> Any:
        return None


def plain_converter() -> Any:
    converter = default_converter()
    for message in (JsonRPCRequestMessage, JsonRPCResponseMessage, JsonRPCNotification):
        keys = [field.name for field in message.__attrs_attrs__]
        converter.register_structure_hook(message, lambda value, kind, keys=keys: kind(**{key: value.get(key) for key in keys}))
    return converter


class Client(LanguageClient):
    """Keeps what the server says, and answers what it asks."""

    def __init__(self) -> None:
        super().__init__(protocol_cls=Plain, converter_factory=plain_converter)
        self.numbers = itertools.count(1)
        self.published: dict[tuple[str, Any], list[Any]] = {}
        self.heard: list[tuple[str, Any]] = []
        self.news = asyncio.Event()
        #: Answers to the server's requests by method.
        self.answers: dict[str, Any] = {
            "workspace/configuration": lambda params: [None for _ in params["items"]],
            "client/registerCapability": lambda params: None,
            "window/workDoneProgress/create": lambda params: None,
        }
        for method in ("textDocument/publishDiagnostics", "window/logMessage", "window/showMessage", "$/progress"):
            self.feature(method)(lambda params, method=method: self._hear(method, params))
        for method in ("workspace/configuration", "client/registerCapability", "window/workDoneProgress/create",
                       "workspace/applyEdit", "wedm/applyDrawingEdit", "wedm/resendDrawing"):  # fmt: skip
            self.feature(method)(self._answering(method))

    def report_server_error(self, error: Exception, source: Any) -> None:
        """Answers with an error and without an id are heard like all else."""
        self._hear("error", str(error))

    def _hear(self, method: str, params: Any) -> None:
        self.heard.append((method, params))
        if method == "textDocument/publishDiagnostics":
            self.published[params["uri"], params.get("version")] = params["diagnostics"]
        self.news.set()

    def _answering(self, method: str) -> Any:
        async def answer(params: Any) -> Any:
            self._hear(method, params)
            result = self.answers[method](params)
            return await result if inspect.isawaitable(result) else result

        return answer

    def send(self, message: dict[str, Any]) -> None:
        body = json.dumps(message).encode()
        self.protocol.writer.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))

    def tell(self, method: str, params: Any) -> None:
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    async def ask(self, method: str, params: Any = None, limit: float = 20) -> Any:
        """The result of a request.

        :raises JsonRpcException: the server answered with an error.
        """
        number = self.last_number = next(self.numbers)
        answer: Future[Any] = Future()
        self.protocol._request_futures[number] = answer
        self.protocol._result_types[number] = JsonRPCResponseMessage
        self.send({"jsonrpc": "2.0", "id": number, "method": method, "params": params})
        return await asyncio.wait_for(asyncio.wrap_future(answer), limit)

    async def until(self, holds: Any, what: str, limit: float = 20) -> Any:
        """Waits until something that the server says makes `holds()` true, and returns that."""
        end = asyncio.get_running_loop().time() + limit
        while not (found := holds()):
            self.news.clear()
            left = end - asyncio.get_running_loop().time()
            try:
                await asyncio.wait_for(self.news.wait(), max(left, 0))
            except (TimeoutError, asyncio.TimeoutError):
                raise AssertionError(f"no {what} within {limit:g} s; heard {self.heard[-5:]}") from None
        return found

    async def publish(self, uri: str, version: Any, limit: float = 20) -> list[Any]:
        await self.until(lambda: (uri, version) in self.published, f"diagnostics of {uri} version {version}", limit)
        return self.published[uri, version]

    def params_of(self, method: str) -> list[Any]:
        return [params for heard, params in self.heard if heard == method]

    async def initialize(self, **params: Any) -> Any:
        asked = {"processId": None, "rootUri": None, "capabilities": CAPABILITIES, **params}
        # pytest-lsp holds what the server asks of the client against this.
        self.capabilities = default_converter().structure(asked["capabilities"], types.ClientCapabilities)
        result = await self.ask("initialize", asked)
        self.tell("initialized", {})
        return result

    async def open_text(self, name: str, text: str | None = None, language: str = "dxf", version: int = 1) -> str:
        uri = f"file:///session/{name}"
        content = (ROOT / "tests/data" / name).read_text() if text is None else text
        self.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": language, "version": version, "text": content}})
        await self.publish(uri, version)
        return uri

    async def open_drawing(self, uri: str, *entities: dict[str, Any], version: int = 1) -> str:
        self.tell("wedm/didOpenDrawing", {"drawing": {"uri": uri, "version": version, "entities": list(entities)}})
        await self.publish(uri, version)
        return uri


@pytest_lsp.fixture(config=ClientServerConfig(server_command=[WEDM], client_factory=Client))
async def stranger(lsp_client: Client) -> Any:
    """A client that has not shaken hands."""
    yield
    await end(lsp_client)


@pytest_lsp.fixture(config=ClientServerConfig(server_command=[WEDM], client_factory=Client))
async def client(lsp_client: Client) -> Any:
    """A client that has shaken hands."""
    lsp_client.initialized = await lsp_client.initialize()
    yield
    await end(lsp_client)


async def end(client: Client) -> None:
    if client._server is not None and client._server.returncode is None:
        client._server.stdin.close()
        try:
            await asyncio.wait_for(client._server.wait(), 5)
        except asyncio.TimeoutError:
            client._server.kill()


def check_schema(definition: dict[str, Any], value: Any) -> None:
    """The value is what docs/protocol.schema.json says."""
    Draft202012Validator({**definition, "$defs": SCHEMA["$defs"]}).validate(value)


def check_standard(method: str, result: Any) -> None:
    """The result is what LSP 3.17 says, in the eyes of lsprotocol."""
    response = types.METHOD_TO_TYPES[method][1]
    default_converter().structure({"id": 1, "jsonrpc": "2.0", "result": result}, response)


def error_of(failed: pytest.ExceptionInfo[JsonRpcException]) -> tuple[int, str, Any]:
    return failed.value.code, failed.value.message, failed.value.data


#: What a provider may say of itself that is no method.
PROPERTIES = {
    "workDoneProgress", "triggerCharacters", "retriggerCharacters", "allCommitCharacters", "firstTriggerCharacter", "moreTriggerCharacter",
    "codeActionKinds", "commands", "legend", "documentSelector", "id", "label", "completionItem",
}  # fmt: skip


def methods_of(capabilities: dict[str, Any]) -> set[str]:
    """The requests that a server announces with its capabilities. A part that is not known here fails."""
    found = set()
    names = {"codeActionProvider": "codeAction", "semanticTokensProvider": None, "documentFormattingProvider": "formatting",
             "documentRangeFormattingProvider": "rangeFormatting", "documentOnTypeFormattingProvider": "onTypeFormatting"}  # fmt: skip
    for key, value in capabilities.items():
        if not key.endswith("Provider") or not value:
            continue
        if key == "executeCommandProvider":
            found.add("workspace/executeCommand")
        elif key == "workspaceSymbolProvider":
            found.add("workspace/symbol")
        elif key == "semanticTokensProvider":
            found |= {f"textDocument/semanticTokens/{part}" for part in ("full", "range") if value.get(part)}
            full = value.get("full")
            if isinstance(full, dict) and full.get("delta"):
                found.add("textDocument/semanticTokens/full/delta")
        else:
            found.add("textDocument/" + (names.get(key) or key.removesuffix("Provider")))
        if isinstance(value, dict):
            unknown = set(value) - PROPERTIES - {"resolveProvider", "prepareProvider", "full", "range"}
            assert not unknown, f"{key} says {unknown}: which methods are these?"
        if isinstance(value, dict) and value.get("resolveProvider"):
            found.add({"codeLensProvider": "codeLens/resolve", "completionProvider": "completionItem/resolve"}.get(key, key))
        if key == "renameProvider" and isinstance(value, dict) and value.get("prepareProvider"):
            found.add("textDocument/prepareRename")
    return found


def notifications_of(capabilities: dict[str, Any]) -> set[str]:
    """The notifications that a server announces with its capabilities."""
    sync = capabilities["textDocumentSync"]
    told = {"openClose": ("textDocument/didOpen", "textDocument/didClose"), "change": ("textDocument/didChange",), "save": ("textDocument/didSave",)}
    assert set(sync) <= set(told), sync
    found = {method for key, methods in told.items() if sync.get(key) for method in methods}
    if capabilities["workspace"]["workspaceFolders"].get("changeNotifications"):
        found.add("workspace/didChangeWorkspaceFolders")
    return found


def methods_of_the_source() -> set[str]:
    """Every method that the server's source names, in its own name space."""
    return set(re.findall(r'"(wedm/[A-Za-z]+)"', (ROOT / "src/protocol/method.rs").read_text()))


def methods_of_the_page() -> set[str]:
    """Every method that docs/protocol.md and docs/editing.md name in full."""
    return set(re.findall(r"`((?:textDocument|workspace|window|client|wedm|codeLens|completionItem)/[A-Za-z/]+)`", PROTOCOL + EDITING))

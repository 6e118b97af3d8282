"""One process of the server, and the messages over its pipes. It does not know which documents are open."""

from __future__ import annotations

import asyncio
import collections
import itertools
import logging
import os
import re
import threading
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeout
from typing import Any, TypeVar

import attrs
from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.io_ import run_async
from pygls.lsp.client import LanguageClient
from pygls.protocol import LanguageServerProtocol

from .errors import NoAnswer, Outdated, Refused, RequestFailed, WedmError, WrongProtocol, WrongSettings
from .findings import diagnostic_from_json
from .progress import Heard

#: The version of the name space wedm/ that this package speaks.
PROTOCOL = 1

CONTENT_MODIFIED = -32801
REQUEST_FAILED = -32803

# Seconds; a program that has not answered by then is no server.
_PATIENCE = 20.0
# Seconds after which what was heard of a request that takes long is handed on.
_BEAT = 0.25
# Seconds that a process may live on when it has closed its stdout.
_LAST_WORDS = 2.0

LOG = logging.getLogger("wedm_client")

T = TypeVar("T")


class Died(Exception):
    """The process has ended."""


# Messages whose params or results stay as JSON gives them: the name space wedm/, and what is turned into own types.
# No key has a default: the converter would leave out a value that equals it.
@attrs.define
class _Request:
    id: int | str
    method: str
    params: Any
    jsonrpc: str


@attrs.define
class _Notification:
    method: str
    params: Any
    jsonrpc: str


@attrs.define
class _Response:
    id: int | str
    result: Any
    jsonrpc: str


class _Protocol(LanguageServerProtocol):
    # pygls keeps its answers in a cache, which is no type that a method could have.
    def get_message_type(self, method: str) -> type[Any] | None:  # type: ignore[override]
        if method in (types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS, types.PROGRESS) or method.startswith("wedm/did"):
            return _Notification
        # A code action is asked for with the diagnostics as they came.
        if method.startswith("wedm/") or method == types.TEXT_DOCUMENT_CODE_ACTION:
            return _Request
        return super().get_message_type(method)

    def get_result_type(self, method: str) -> type[Any] | None:  # type: ignore[override]
        return _Response

    def structure_message(self, data: dict[str, Any]) -> Any:
        # Results are left as they are; errors and what the server sends by itself go the usual way.
        if "jsonrpc" in data and "result" in data and "id" in data:
            return _Response(data["id"], data["result"], data["jsonrpc"])
        if data.get("method") in (types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS, types.PROGRESS):
            return _Notification(data["method"], data.get("params"), data["jsonrpc"])
        asked = str(data.get("method", ""))
        if (asked.startswith("wedm/") or asked == types.WORKSPACE_APPLY_EDIT) and "id" in data:
            return _Request(data["id"], data["method"], data.get("params"), data["jsonrpc"])
        return super().structure_message(data)


class _NoMessage(Exception):
    """The server has written what belongs to no message."""


class _Messages:
    """The server's stdout as pygls reads it, which would pass over a line that is no header and wait for ever for what it has swallowed."""

    _HEADER = re.compile(rb"(Content-Length: \d+|Content-Type: [^\r\n]*)\r\n")

    def __init__(self, pipe: asyncio.StreamReader) -> None:
        self._pipe = pipe

    async def readline(self) -> bytes:
        try:
            line = await self._pipe.readline()
        except ValueError:
            raise _NoMessage("a line that does not end") from None
        if line not in (b"", b"\r\n") and not self._HEADER.fullmatch(line):
            raise _NoMessage(repr(line[:80].decode("utf-8", "replace")))
        return line

    async def readexactly(self, n: int) -> bytes:
        return await self._pipe.readexactly(n)


class _Client(LanguageClient):
    def __init__(self, on_end: Callable[[int], None]) -> None:
        super().__init__("wedm-client", "0.1.0", protocol_cls=_Protocol)
        self.said: collections.deque[str] = collections.deque(maxlen=20)
        #: What the server wrote that belongs to no message; it is killed then.
        self.babble: str | None = None
        self._on_end = on_end

    async def start_io(self, cmd: str, *args: Any, **kwargs: Any) -> None:
        pipe = asyncio.subprocess.PIPE
        server = await asyncio.create_subprocess_exec(cmd, *args, stdin=pipe, stdout=pipe, stderr=pipe, **kwargs)
        assert server.stdin is not None and server.stdout is not None and server.stderr is not None
        self._server = server
        self.protocol.set_writer(server.stdin)
        exits: Coroutine[Any, Any, None] = self._server_exit()  # type: ignore[no-untyped-call]
        # A pipe that nobody reads would stop the server.
        for task in (self._read(server, server.stdout), self._listen(server.stderr), exits):
            self._async_tasks.append(asyncio.create_task(task))

    async def _read(self, server: asyncio.subprocess.Process, stdout: asyncio.StreamReader) -> None:
        try:
            await run_async(self._stop_event, _Messages(stdout), self.protocol, error_handler=self._judge)
            await asyncio.wait_for(server.wait(), _LAST_WORDS)
        except _NoMessage as reason:
            self.babble = str(reason)
            LOG.warning("the server wrote what is no message, and is killed: %s", reason)
            _kill(server)
        except (asyncio.IncompleteReadError, asyncio.TimeoutError, OSError):
            # It will say nothing more, and cannot be asked.
            _kill(server)

    def _judge(self, error: Exception, source: type[Exception]) -> None:
        # ValueError is of a body that is no JSON, AttributeError of JSON that is no message; what is wrong within a message is its own affair.
        if isinstance(error, (ValueError, AttributeError)):
            raise _NoMessage(f"a body that is none ({error})") from error

    async def _listen(self, stderr: asyncio.StreamReader) -> None:
        while chunk := await stderr.read(65536):
            self.said.extend(chunk.decode("utf-8", "replace").splitlines())

    async def server_exit(self, server: asyncio.subprocess.Process) -> None:
        if server.stdin is not None:
            server.stdin.close()
        self._on_end(server.returncode if server.returncode is not None else -1)


class Loop:
    """A thread that runs coroutines, so that callers need none."""

    def __init__(self) -> None:
        self.loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self.loop.run_forever, name="wedm-client", daemon=True)
        self._thread.start()

    def run(self, work: Coroutine[Any, Any, T], timeout: float | None) -> T:
        """Runs the coroutine on the thread and waits for it."""
        future = asyncio.run_coroutine_threadsafe(work, self.loop)
        try:
            return future.result(timeout)
        except FutureTimeout:
            future.cancel()
            raise

    def soon(self, call: Callable[..., Any], *args: Any) -> None:
        self.loop.call_soon_threadsafe(call, *args)

    def close(self) -> None:
        """Ends what still runs on the thread, and the thread."""
        try:
            self.run(_drain(), 5)
        except FutureTimeout:
            pass
        self.loop.call_soon_threadsafe(self.loop.stop)
        self._thread.join(5)
        if not self._thread.is_alive():
            self.loop.close()


class Connection:
    """A process of the server, from its start to its end."""

    def __init__(
        self,
        loop: Loop,
        command: Sequence[str],
        on_publish: Callable[[Connection, Mapping[str, Any]], None],
        on_resend: Callable[[str], dict[str, Any]],
        on_edit: Callable[[Mapping[str, Any]], str | None],
        on_warning: Callable[[str], None],
        on_end: Callable[[Connection], None],
    ) -> None:
        self._loop = loop
        self._command = command
        self.ended = False
        self._ready_at: float | None = None
        #: Seconds from the answer to ``initialize`` to the end; 0 where none came.
        self.life = 0.0
        self.exit_code: int | None = None
        self.server_version = ""
        self._on_end = on_end
        self._on_warning = on_warning
        self._client = _Client(self._end)
        self._client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)(lambda params: on_publish(self, params))
        self._client.feature("wedm/resendDrawing")(lambda params: on_resend(str(params["uri"])))
        self._client.feature(types.WORKSPACE_APPLY_EDIT)(lambda params: _applied(on_edit(params["edit"])))
        # What is heard of the requests that are waited for, by their tokens.
        self._heard: dict[str, Heard] = {}
        self._tokens = itertools.count(1)
        self._client.feature(types.PROGRESS)(lambda params: self._progress(params))
        self._shown: list[str] = []
        self._client.feature(types.WINDOW_LOG_MESSAGE)(lambda params: self._hear(params))
        self._client.feature(types.WINDOW_SHOW_MESSAGE)(lambda params: self._see(params))

    def _progress(self, params: Mapping[str, Any]) -> None:
        heard = self._heard.get(str(params["token"]))
        if heard is not None:
            heard.hear(params["value"])

    def _see(self, params: types.ShowMessageParams) -> None:
        if params.type == types.MessageType.Error:
            self._shown.append(params.message)
        elif params.type == types.MessageType.Warning:
            LOG.warning("%s", params.message)
        self._hear(params)

    def _hear(self, params: types.LogMessageParams | types.ShowMessageParams) -> None:
        self._client.said.append(params.message)
        if params.type in (types.MessageType.Warning, types.MessageType.Error):
            self._on_warning(params.message)

    def _end(self, exit_code: int) -> None:
        if self._ready_at is not None:
            self.life = time.monotonic() - self._ready_at
        self.ended, self.exit_code = True, exit_code
        self._on_end(self)

    @property
    def how_it_ended(self) -> str:
        """To be read after "the last time"."""
        babble = self._client.babble
        return f"with code {self.exit_code}" if babble is None else f"killed since it wrote what is no message: {babble}"

    @property
    def said(self) -> list[str]:
        """The last lines that the server wrote to its log."""
        return list(self._client.said)

    @property
    def pid(self) -> int | None:
        process = self._client._server
        return process.pid if process is not None else None

    def start(self, settings: dict[str, Any], folder: str | None, timeout: float) -> None:
        """Starts the process and shakes hands.

        :raises WrongProtocol: it is another version of wedm, or no wedm.
        :raises WrongSettings: it does not take one of the settings.
        :raises Died: it ended before it had answered.
        """
        try:
            self._loop.run(self._client.start_io(self._command[0], *self._command[1:]), timeout)
        except OSError as reason:
            raise WedmError(f"{self._command[0]} could not be started: {reason}") from None
        capabilities = types.ClientCapabilities(
            general=types.GeneralClientCapabilities(position_encodings=[types.PositionEncodingKind.Utf8]),
            workspace=types.WorkspaceClientCapabilities(apply_edit=True, workspace_edit=types.WorkspaceEditClientCapabilities(document_changes=True)),
            experimental={"wedm": {"resendDrawing": True}},
        )
        folders = [types.WorkspaceFolder(uri=folder, name=folder.rsplit("/", 1)[-1])] if folder is not None else None
        params = types.InitializeParams(
            process_id=os.getpid(),
            client_info=types.ClientInfo("wedm-client", "0.1.0"),
            capabilities=capabilities,
            initialization_options=settings,
            workspace_folders=folders,
            root_uri=folder,
        )
        try:
            answer = self.request(types.INITIALIZE, params, min(timeout, _PATIENCE))
        except NoAnswer:
            raise WrongProtocol(f"{self._command[0]} does not answer as a language server") from None
        self._agree(answer)
        self._ready_at = time.monotonic()
        self.notify(types.INITIALIZED, types.InitializedParams())
        if settings:
            self._check_settings(timeout)

    def _check_settings(self, timeout: float) -> None:
        """The server reports what is wrong with the settings before it answers the next request."""
        try:
            self.request("wedm/settings", {"uri": "wedm-client:settings"}, timeout)
        except RequestFailed:
            # There is no such document; the answer does not matter.
            pass
        if self._shown:
            raise WrongSettings("\n".join(self._shown))

    def _agree(self, answer: Any) -> None:
        answer = answer if isinstance(answer, dict) else {}
        info = answer.get("serverInfo") or {}
        self.server_version = str(info.get("version", ""))
        capabilities = answer.get("capabilities") or {}
        spoken = ((capabilities.get("experimental") or {}).get("wedm") or {}).get("protocol")
        if info.get("name") != "wedm" or spoken is None:
            raise WrongProtocol(f"{self._command[0]} is no wedm: it calls itself {info.get('name', 'nothing')!r}")
        if spoken != PROTOCOL:
            older = "the program" if isinstance(spoken, int) and spoken < PROTOCOL else "this package"
            raise WrongProtocol(
                f"{self._command[0]} is wedm {self.server_version} and speaks protocol {spoken}, "
                f"wedm-client speaks {PROTOCOL}: {older} has to be updated"
            )

    def request(self, method: str, params: Any, timeout: float, heard: Heard | None = None) -> Any:
        """Sends a request and waits for its result.

        :param heard: told what the server says of it meanwhile; each word of it begins the ``timeout`` anew.
        :raises Died: the process ended before it had answered.
        :raises NoAnswer: nothing came within ``timeout`` seconds.
        :raises RequestFailed: the server answered with an error.
        """
        if self.ended:
            raise Died
        if heard is None:
            return self._request(method, params, lambda answer: answer.result(timeout), timeout)
        token = f"wedm-client-{next(self._tokens)}"
        self._heard[token] = heard
        try:
            return self._request(method, {**params, "workDoneToken": token}, lambda answer: _patient(answer, heard, timeout), timeout)
        finally:
            del self._heard[token]

    def _request(self, method: str, params: Any, wait: Callable[[Future[Any]], Any], timeout: float) -> Any:
        sent: Future[Future[Any]] = Future()

        def send() -> None:
            try:
                sent.set_result(self._client.protocol.send_request(method, params))
            except Exception as reason:
                sent.set_exception(reason)

        self._loop.soon(send)
        try:
            answer = sent.result(timeout)
            # The process may have ended between the check and the sending.
            if self.ended and not answer.done():
                raise Died
            return wait(answer)
        except FutureTimeout:
            raise NoAnswer(f"no answer to {method} within {timeout:g} s") from None
        except JsonRpcException as error:
            raise _failure(error) from None
        except (RuntimeError, OSError):
            # What pygls puts into the requests that wait when the process ends, and what a broken pipe gives.
            raise Died from None

    def notify(self, method: str, params: Any) -> None:
        """Sends a notification. If it does not arrive, the process has ended, which is noticed elsewhere."""

        def send() -> None:
            if not self.ended:
                try:
                    self._client.protocol.notify(method, params)
                except OSError:
                    pass

        self._loop.soon(send)

    def kill(self) -> None:
        """Ends the process at once."""
        process = self._client._server
        if process is not None and process.returncode is None:
            self._loop.soon(_kill, process)

    def close(self) -> None:
        """Ends the process as the protocol wants, and by force when it does not react."""
        try:
            if not self.ended and self._client._server is not None:
                self.request(types.SHUTDOWN, None, 5)
                self.notify(types.EXIT, None)
        except (Died, WedmError):
            self.kill()
        for _ in range(2):
            stop: Coroutine[Any, Any, None] = self._client.stop()  # type: ignore[no-untyped-call]
            try:
                return self._loop.run(stop, 5)
            except FutureTimeout:
                self.kill()


def _patient(answer: Future[Any], heard: Heard, timeout: float) -> Any:
    """The answer, for as long as the server says something of it within ``timeout`` seconds."""
    while True:
        try:
            result = answer.result(min(_BEAT, timeout))
        except FutureTimeout:
            heard.tell()
            if heard.silence > timeout and not answer.done():
                raise
        else:
            heard.tell()
            return result


def _applied(failure: str | None) -> dict[str, Any]:
    return {"applied": True} if failure is None else {"applied": False, "failureReason": failure}


async def _drain() -> None:
    rest = asyncio.all_tasks() - {asyncio.current_task()}
    for task in rest:
        task.cancel()
    await asyncio.gather(*rest, return_exceptions=True)
    # Pipes of a process that has just ended are closed by the loop's next turns.
    await asyncio.sleep(0.02)


def _kill(process: asyncio.subprocess.Process) -> None:
    try:
        process.kill()
    except ProcessLookupError:
        pass


def _failure(error: JsonRpcException) -> RequestFailed:
    code = error.code if error.code is not None else 0
    data = error.data
    if code == CONTENT_MODIFIED:
        return Outdated(error.message, code, data)
    if code == REQUEST_FAILED:
        listed = data.get("diagnostics", []) if isinstance(data, dict) else []
        return Refused(error.message, code, data, [diagnostic_from_json(one, None) for one in listed])
    return RequestFailed(error.message, code, data)

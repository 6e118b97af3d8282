"""What is open in a server, and the process that must know of it: started again when it dies, and told everything again.

It asks what it is given to ask and passes on the answer; what can be asked is in ``server``.
"""

from __future__ import annotations

import itertools
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import TimeoutError as FutureTimeout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lsprotocol import types

from .connection import CONTENT_MODIFIED, LOG, Connection, Died, Loop
from .documents import Document, Drawing, TextDocument
from .entities import Change, Delete, Put, Splice
from .errors import NoAnswer, NotOpen, NotSaved, Outdated, ServerDied, WedmError
from .find import find
from .progress import Heard, Told
from .restarts import MOST_ENDS, Restarts
from .settings import Settings, to_json
from .shown import counted


@dataclass
class _Published:
    version: int | None
    diagnostics: list[Mapping[str, Any]]


class Session:
    """What is open, in a process that is there when it is asked. Methods may be called from several threads."""

    def __init__(
        self,
        command: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None,
        *,
        settings: Settings | None = None,
        folder: str | os.PathLike[str] | None = None,
        timeout: float = 60.0,
    ) -> None:
        self.command = find(command)
        self.timeout = timeout
        self._settings = to_json(settings or {})
        self._folder = Path(folder if folder is not None else ".").resolve().as_uri()
        self._numbers = itertools.count(1)
        # Held while a process is started; never taken by the thread that reads messages.
        self._starting = threading.Lock()
        # Held for moments: documents, what was published for them, and the order of what is sent.
        self._state = threading.Condition(threading.RLock())
        self._documents: dict[str, Document] = {}
        self._published: dict[str, _Published] = {}
        self._closed_at: dict[str, int] = {}
        # Drawings that the server asked for again, and those that it did not take then either, with its reason.
        self._resent: set[str] = set()
        self._refused: dict[str, str] = {}
        self._warned: set[str] = set()
        self._connection: Connection | None = None
        self._loop: Loop | None = None
        self._restarts = Restarts()
        self._closed = False

    def __repr__(self) -> str:
        with self._state:
            said = "closed" if self._closed else counted(len(self._documents), "document")
        return f"<Server {' '.join(self.command)}: {said}>"

    @property
    def version(self) -> str:
        """The version that the server states."""
        return self._live().server_version

    @property
    def pid(self) -> int | None:
        """The number of the server's process."""
        return self._live().pid

    def close(self) -> None:
        """Ends the server. Documents are no longer open; what they hold stays readable. Warns of repairs that nobody has saved."""
        self._close(warns=True)

    def _close(self, warns: bool) -> None:
        with self._starting:
            with self._state:
                self._closed = True
                connection, self._connection = self._connection, None
                loop, self._loop = self._loop, None
                documents = list(self._documents.values())
                self._documents.clear()
                self._state.notify_all()
            if connection is not None:
                connection.close()
            if loop is not None:
                loop.close()
        for document in documents if warns else []:
            _warn_of_forgotten(document)

    # Documents

    def _opened(self, document: Document) -> Document:
        connection = self._live()
        with self._state:
            if document.uri in self._documents:
                raise ValueError(f"{document.uri} is open already")
            # Findings for an earlier document of this name may still be on their way.
            document.version = self._closed_at.pop(document.uri, 0) + 1
            self._send_open(connection, document)
            self._documents[document.uri] = document
        return document

    def close_document(self, document: Document) -> None:
        """Closes the document in the server. Warns of repairs that nobody has saved."""
        with self._state:
            if self._documents.pop(document.uri, None) is None:
                return
            self._published.pop(document.uri, None)
            self._closed_at[document.uri] = document.version
            if self._connection is not None:
                if isinstance(document, Drawing):
                    self._connection.notify("wedm/didCloseDrawing", {"drawing": {"uri": document.uri}})
                else:
                    params = types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(document.uri))
                    self._connection.notify(types.TEXT_DOCUMENT_DID_CLOSE, params)
        _warn_of_forgotten(document)

    def change(self, document: Document, change: str | Change | Sequence[Change]) -> None:
        """Changes a drawing by :class:`Splice`, :class:`Put` and :class:`Delete`, all of them or none; a text by the new text.

        :raises DoesNotApply: an entity or vertex is not there; nothing was changed.
        :raises ValueError: a number is not finite; nothing was changed.
        """
        if isinstance(document, TextDocument):
            if not isinstance(change, str):
                raise TypeError("a text is changed by its new text")
            with self._state:
                self._check_open(document)
                document._bytes = change.encode("utf-8")
                self._send_text_changes(document, [types.TextDocumentContentChangeWholeDocument(text=change)])
            return
        if isinstance(change, str) or not isinstance(document, Drawing):
            raise TypeError("a drawing is changed by Splice, Put and Delete")
        changes: list[Change] = [change] if isinstance(change, (Splice, Put, Delete)) else list(change)
        with self._state:
            self._check_open(document)
            self._change_drawing(document, changes)

    def _change_drawing(self, drawing: Drawing, changes: Sequence[Change]) -> None:
        changed, written = drawing._changed(changes), [change.to_json() for change in changes]
        drawing._entities = changed
        self._resent.discard(drawing.uri)
        self._refused.pop(drawing.uri, None)
        drawing.version += 1
        if self._connection is not None:
            params = {"drawing": {"uri": drawing.uri, "version": drawing.version}, "changes": written}
            self._connection.notify("wedm/didChangeDrawing", params)

    def _send_text_changes(self, document: TextDocument, changes: Sequence[types.TextDocumentContentChangeEvent]) -> None:
        document.version += 1
        if self._connection is not None:
            identifier = types.VersionedTextDocumentIdentifier(uri=document.uri, version=document.version)
            self._connection.notify(types.TEXT_DOCUMENT_DID_CHANGE, types.DidChangeTextDocumentParams(identifier, changes))

    def _apply_text_edit(self, document: TextDocument, edit: Mapping[str, Any]) -> None:
        edits: list[Mapping[str, Any]] = []
        for part in edit["documentChanges"]:
            identifier = part["textDocument"]
            if identifier["uri"] != document.uri or identifier.get("version") not in (None, document.version):
                raise Outdated(f"the repair is for version {identifier.get('version')} of {identifier['uri']}", CONTENT_MODIFIED)
            edits.extend(part["edits"])
        document._bytes = document._edited(edits)
        document._repaired = True

        def position(at: Mapping[str, int]) -> types.Position:
            return types.Position(at["line"], at["character"])

        # From the last to the first, so that each one's range is still that of the old text.
        ordered = sorted(reversed(edits), key=lambda one: (one["range"]["start"]["line"], one["range"]["start"]["character"]), reverse=True)
        changes = [
            types.TextDocumentContentChangePartial(
                range=types.Range(position(one["range"]["start"]), position(one["range"]["end"])), text=one["newText"]
            )
            for one in ordered
        ]
        self._send_text_changes(document, changes)

    # The process

    def _check_open(self, document: Document) -> None:
        if self._documents.get(document.uri) is not document:
            raise NotOpen(f"{document.uri} is not open in this server")

    def _ask(
        self,
        document: Document | None,
        method: str,
        params: Any,
        is_done: Callable[[], bool] = lambda: False,
        told: Told | None = None,
    ) -> Any:
        """Sends a request until a living server has answered it, or it is done without an answer; tells its progress meanwhile."""
        if document is not None:
            with self._state:
                self._check_open(document)
        while True:
            connection = self._live()
            try:
                return connection.request(method, params, self.timeout, None if told is None else Heard(told))
            except Died:
                if is_done():
                    return None

    def _wait_for_publish(self, document: Document) -> _Published:
        deadline = time.monotonic() + self.timeout
        while True:
            connection = self._live()
            with self._state:
                while self._connection is connection and not connection.ended:
                    self._check_open(document)
                    published = self._published.get(document.uri)
                    if published is not None and published.version == document.version:
                        return published
                    if document.uri in self._refused:
                        raise ValueError(self._refused[document.uri])
                    left = deadline - time.monotonic()
                    if left <= 0 or not self._state.wait(left):
                        raise NoAnswer(f"no diagnostics of {document.uri} within {self.timeout:g} s")

    def _live(self) -> Connection:
        """The connection to a living server; a dead one is replaced by a new one that knows all documents.

        :raises ServerDied: it has died too often of late.
        """
        with self._starting:
            with self._state:
                if self._closed:
                    raise WedmError("the server was closed")
                connection = self._connection
                if connection is not None and not connection.ended:
                    return connection
                if self._loop is None:
                    self._loop = Loop()
            if connection is not None:
                self._pause_after(connection)
            while True:
                # A timed-out start leaves a process behind; it is ended before the error is passed on.
                started = Connection(self._loop, self.command, self._publish, self._resend, self._apply_edit, self._hear, self._ended)
                try:
                    started.start(self._settings, self._folder, self.timeout)
                except Died:
                    self._pause_after(started)
                    continue
                except (WedmError, FutureTimeout):
                    started.kill()
                    raise
                with self._state:
                    self._connection = started
                    self._published.clear()
                    for document in self._documents.values():
                        self._send_open(started, document)
                return started

    def _pause_after(self, connection: Connection) -> None:
        """Waits for the pause before a server that has ended is started again.

        :raises ServerDied: it is not to be started again.
        """
        pause = self._restarts.after_life_of(connection.life)
        if pause is None:
            # The next call tries again.
            self._restarts.reset()
            said = "".join(f"\n  {line}" for line in connection.said)
            raise ServerDied(
                f"{self.command[0]} has ended {MOST_ENDS} times in a row, "
                f"the last time {connection.how_it_ended}, and is not started again; its last words:{said or ' none'}"
            )
        time.sleep(pause)

    def _send_open(self, connection: Connection, document: Document) -> None:
        self._published.pop(document.uri, None)
        self._resent.discard(document.uri)
        self._refused.pop(document.uri, None)
        if isinstance(document, Drawing):
            connection.notify("wedm/didOpenDrawing", {"drawing": document.to_json()})
        elif isinstance(document, TextDocument):
            item = types.TextDocumentItem(document.uri, document.language, document.version, document._told())
            connection.notify(types.TEXT_DOCUMENT_DID_OPEN, types.DidOpenTextDocumentParams(item))

    # Called on the thread that reads messages; only the lock `_state` may be taken there.

    def _publish(self, connection: Connection, params: Mapping[str, Any]) -> None:
        with self._state:
            # Messages that are left in the pipe of a server that has died are about documents that have been opened again since.
            if params["uri"] not in self._documents:
                self._warn_of(params)
            elif connection is self._connection:
                # Findings for an older state say nothing of one that was refused.
                if params.get("version") == self._documents[params["uri"]].version:
                    self._resent.discard(params["uri"])
                    self._refused.pop(params["uri"], None)
                self._published[params["uri"]] = _Published(params.get("version"), params["diagnostics"])
                self._state.notify_all()

    def _warn_of(self, params: Mapping[str, Any]) -> None:
        """What is wrong in a ``wedm.toml``, which nobody has opened, is said once."""
        for diagnostic in params["diagnostics"]:
            line = diagnostic["range"]["start"]["line"] + 1
            said = f"{params['uri']}:{line}: {diagnostic['message']}"
            if params["uri"].endswith("/wedm.toml") and said not in self._warned:
                self._warned.add(said)
                LOG.warning("%s", said)

    def _resend(self, uri: str) -> dict[str, Any]:
        with self._state:
            document = self._documents.get(uri)
            if not isinstance(document, Drawing):
                raise LookupError(f"{uri} is not open")
            self._resent.add(uri)
            return {"drawing": document.to_json()}

    def _hear(self, warning: str) -> None:
        """What the server does not take when it is sent again, it never takes: nobody need wait for its findings."""
        with self._state:
            for uri in self._resent & self._documents.keys():
                if uri in warning:
                    self._refused[uri] = warning
                    self._state.notify_all()

    def _apply_edit(self, edit: Mapping[str, Any]) -> str | None:
        """Makes an edit that the server asks for; None, or why nothing was changed."""
        with self._state:
            (change,) = edit["documentChanges"]
            document = self._documents.get(change["textDocument"]["uri"])
            if not isinstance(document, TextDocument):
                return "the document is not open"
            try:
                self._apply_text_edit(document, edit)
            except Outdated as reason:
                return str(reason)
        return None

    def _ended(self, connection: Connection) -> None:
        with self._state:
            self._state.notify_all()


def _warn_of_forgotten(document: Document) -> None:
    forgotten = document._forgotten()
    if forgotten is not None:
        # The warning points to the line outside this package that has closed it, however many calls away.
        depth, frame = 1, sys._getframe()
        while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
            depth, frame = depth + 1, frame.f_back
        warnings.warn(forgotten, NotSaved, stacklevel=depth)

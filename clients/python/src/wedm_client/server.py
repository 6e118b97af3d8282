"""A server and what can be asked of what is open in it: the package's front door.

Every method blocks until its answer is there. A server that dies is started again and told everything again, so that its answers
are right again; requests are repeated. Methods may be called from several threads.
"""

from __future__ import annotations

import base64
import itertools
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from io import StringIO
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, Union, overload

from lsprotocol import types

from . import cad
from .connection import CONTENT_MODIFIED, LOG
from .convert import converted
from .documents import Action, Document, Drawing, ProgramFormat, TextDocument, WireFormat, language_of, read_text
from .entities import change_from_json, number
from .errors import Outdated
from .findings import Diagnostic, Findings, Fixed, Located, diagnostic_from_json, located_from_json
from .programs import Fit, PairProgram, PairPrograms, Program, Simulation
from .progress import Progress, Told
from .reading import from_json
from .results import Contours, Inspection, Picture, Repair, Repairs, SettingsInForce, Toolpath
from .session import Session
from .settings import Settings, Units, to_json
from .shown import Rows

#: What a drawing can be opened from.
Source = Union[str, "os.PathLike[str]", Iterable[Any], Any]

# A repair may make room for the next one; no drawing has needed more than a few rounds.
_MOST_ROUNDS = 50
# How often a repair is asked for again because the document has changed in the meantime.
_MOST_TRIES = 5


class Server(Session):
    """A language server of wedm, as a context manager.

    :param command: the program, or the program with its arguments; without it see :func:`wedm_client.find`.
    :param settings: settings for all documents; a ``wedm.toml`` above a file wins over them. What is wrong in one is a warning of
        the logger ``wedm_client``.
    :param folder: where the ``wedm.toml`` for drawings that are no files is looked for; the current folder by default.
    :param timeout: seconds that an answer may take.
    :raises ServerNotFound: there is no program.
    :raises WrongProtocol: the program is another version.
    :raises WrongSettings: one of the settings is not known, or does not fit.
    """

    def __enter__(self) -> Server:
        self._live()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        # A block that an exception has left needs no warning.
        self._close(warns=error is None)

    # Opening

    @overload
    def open(self, source: str | os.PathLike[str], *, units: Units | None = None, uri: str | None = None) -> TextDocument: ...

    @overload
    def open(self, source: Iterable[Any], *, units: Units | None = None, uri: str | None = None) -> Drawing: ...

    @overload
    def open(self, source: Any, *, units: Units | None = None, uri: str | None = None) -> Document: ...

    def open(self, source: Source, *, units: Units | None = None, uri: str | None = None) -> Document:
        """Opens a drawing, or a file.

        :param source: the path of a DXF, 3B or ISO file; or a list of entities (of this package, dictionaries of the protocol's form,
            lists of vertices, entities of ezdxf) in machining order; or one list of vertices; or a document of ezdxf as a whole.
        :param units: of a list; by default those of the ezdxf document that the entities belong to, else those of the settings.
        :raises UnsupportedUnits: the ezdxf document is drawn in neither millimetres nor inches, or the entities come from documents of
            different units; state ``units``, or open the document as a whole.
        :raises ValueError: a number of an entity is not finite, a radius is not above 0, or two entities have one handle.
        :raises OSError: the file cannot be read.
        """
        if isinstance(source, (str, os.PathLike)):
            path = Path(source).resolve()
            text, encoding = read_text(path)
            language = language_of(path.suffix, text)
            return self._opened(TextDocument(self, uri or path.as_uri(), text, language, path, encoding))
        if hasattr(source, "modelspace") and hasattr(source, "write"):
            written = StringIO()
            source.write(written)
            return self.open_text(written.getvalue(), "dxf", uri=uri)
        items = list(source)
        entities, sources = cad.entities_from(items)
        doubled = len(entities) - len({entity.handle for entity in entities})
        if doubled:
            raise ValueError(f"{doubled} entities have a handle that another one has")
        units = units or cad.units_of(sources.values())
        drawing = Drawing(self, uri or f"wedm-client:drawing-{next(self._numbers)}", entities, units)
        drawing.sources = sources
        drawing.left_out = cad.left_out(items)
        if drawing.left_out:
            counted = ", ".join(f"{len(handles)} {kind}" for kind, handles in sorted(drawing.left_out.items()))
            LOG.info("%s: annotation is not cut: %s", drawing.uri, counted)
        return self._opened(drawing)

    def open_text(self, text: str, language: Literal["dxf", "3b", "wire-iso"] = "dxf", *, uri: str | None = None) -> TextDocument:
        """Opens a text that is in no file."""
        document = TextDocument(self, uri or f"untitled:wedm-client-{next(self._numbers)}", text, language)
        self._opened(document)
        return document

    # Asking

    def diagnostics(self, document: Document) -> Findings:
        """What is wrong with the document as it is now; at most 500 findings, then one ``more`` that counts the rest."""
        published = self._wait_for_publish(document)
        lines = document._lines() if isinstance(document, TextDocument) else None
        return Findings(diagnostic_from_json(one, lines) for one in published.diagnostics)

    def inspect(self, document: Document, handle: str | None = None) -> Inspection:
        """Every segment with its radius and its verdict; of one entity, or of all."""
        params = {"uri": document.uri} if handle is None else {"uri": document.uri, "handle": handle}
        return from_json(self._ask(document, "wedm/inspect", params), Inspection)

    def contours(self, document: Document) -> Contours:
        """What is chained to what."""
        return from_json(self._ask(document, "wedm/contours", {"uri": document.uri}), Contours)

    def toolpath(self, document: Document, options: Settings | None = None) -> Toolpath:
        """The path of the wire's centre. :raises Refused: there is none; the message says why."""
        return from_json(self._ask(document, "wedm/toolpath", self._with(document, options)), Toolpath)

    def picture(self, document: Document, options: Settings | None = None) -> Picture:
        """Contours, faults and wire path as SVG."""
        return from_json(self._ask(document, "wedm/picture", self._with(document, options)), Picture)

    def export(self, document: Document, format: Literal["svg", "png", "pdf"], options: Settings | None = None) -> bytes:
        """The same picture as a file: ``svg``, ``png`` or ``pdf``; its texts are outlines in the last two."""
        answer = self._ask(document, "wedm/export", {**self._with(document, options), "format": format})
        return base64.b64decode(answer["data"])

    def holes(self, document: Document, format: Literal["csv", "dxf"] = "csv", options: Settings | None = None) -> bytes:
        """The start holes for the drill as a file: a row a hole, or the drawing with the holes on a layer of their own.

        :raises Refused: there is no path of the wire; the message says why.
        """
        answer = self._ask(document, "wedm/holes", {**self._with(document, options), "format": format})
        return base64.b64decode(answer["data"])

    def repairs(self, document: Document, rule: str, handle: str, segment: int | None = None) -> list[Repair]:
        """The outcome of each repair of a finding in a drawing, the preferred one first; empty where the finding is gone."""
        place = {"rule": rule, "handle": handle, **({"segment": segment} if segment is not None else {})}
        return from_json(self._ask(document, "wedm/repairs", {**self._with(document, None), **place}), Repairs).repairs

    def generate(
        self,
        document: Document,
        format: ProgramFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Program:
        """The program for the machine.

        :param format: its language; ``"milling"`` for an electrode, which takes the settings ``milling``.
        :param handles: only the contours that hold one of these entities.
        :param layers: only the contours that have an entity on one of these layers; together with ``handles``, the contours of either.
        :param options: settings for this request only.
        :param force: also with errors in the drawing.
        :raises Refused: the drawing has errors (``diagnostics``), or no path can be made.
        """
        params = self._wanted(document, format, handles, layers, options, force)
        return from_json(self._ask(document, "wedm/generate", params), Program)

    def _wanted(
        self,
        document: Document,
        format: ProgramFormat,
        handles: Sequence[str] | None,
        layers: Sequence[str] | None,
        options: Settings | None,
        force: bool,
    ) -> dict[str, Any]:
        params = self._with(document, options)
        params["format"] = format
        if handles is not None:
            params["handles"] = list(handles)
        if layers is not None:
            params["layers"] = list(layers)
        if force:
            params["force"] = True
        return params

    def fit(self, document: Document, options: Settings | None = None) -> Fit:
        """Whether punch and plate fit, as the wire leaves them.

        :raises Refused: a key of the settings is missing (the message names it), or a part has no path.
        """
        return from_json(self._ask(document, "wedm/fit", self._with(document, options)), Fit)

    def pair(
        self,
        document: Document,
        format: WireFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Rows[PairProgram]:
        """The programs of all parts of a pair, such as punch and plate; as :meth:`generate`.

        :raises Refused: the parts do not fit (``diagnostics``), a key is missing, or no path can be made.
        """
        params = self._wanted(document, format, handles, layers, options, force)
        return Rows(from_json(self._ask(document, "wedm/pair", params), PairPrograms).programs)

    def simulate(self, document: Document, feed: float | None = None) -> Simulation:
        """Where the program in the document takes the machine, block by block; with ``feed`` (mm/min) also how long it takes."""
        params = {"uri": document.uri} if feed is None else {"uri": document.uri, "feed": number(feed, "feed")}
        simulation = from_json(self._ask(document, "wedm/simulate", params), Simulation)
        # The protocol counts lines from 0.
        return replace(simulation, blocks=[replace(block, line=block.line + 1) for block in simulation.blocks])

    def locate(
        self,
        document: Document,
        line: int | None = None,
        column: int = 1,
        *,
        handle: str | None = None,
        segment: int | None = None,
    ) -> Located | None:
        """What segment is written at a line and column of a DXF text, or where a ``handle`` and its ``segment`` are written.

        Lines and columns count from 1. None where nothing with geometry is written.

        :raises Refused: the document has no places: a program, or a drawing without text.
        :raises RequestFailed: there is no such handle or segment.
        """
        if (line is None) == (handle is None):
            raise TypeError("expected a line, or a handle")
        params: dict[str, Any] = {"uri": document.uri}
        if line is not None:
            if isinstance(document, TextDocument):
                params["position"] = document._position(line, column)
            else:
                params["position"] = {"line": line - 1, "character": column - 1}
        else:
            params["handle"] = handle
        if segment is not None:
            params["segment"] = segment
        answer = self._ask(document, "wedm/locate", params)
        return None if answer is None or not isinstance(document, TextDocument) else located_from_json(answer, document._lines())

    def settings(self, document: Document) -> SettingsInForce:
        """The correction that holds for the document, and which level of settings it comes from."""
        return from_json(self._ask(document, "wedm/settings", {"uri": document.uri}), SettingsInForce)

    def rule_page(self, rule: str) -> str:
        """The page of a rule, as ``Diagnostic.rule`` names it, in Markdown without pictures; ``wedm explain`` shows the same.

        :raises RequestFailed: there is no such rule.
        """
        return str(self._ask(None, "wedm/rulePage", {"rule": rule})["text"])

    def convert(
        self,
        program: TextDocument,
        to: Literal["dxf", "3b", "4b", "iso"],
        *,
        options: Settings | None = None,
        force: bool = False,
    ) -> str:
        """The program as a drawing, or in another language; by ``wedm convert``, of the text as it is now.

        The settings file of the document holds, and ``options``: of these the correction, the side, and ``program`` with places for
        one contour.

        :param force: also with errors; blocks that lead nowhere are left out.
        :raises Refused: it has errors, or cannot be converted; the message says why.
        """
        return converted(self.command, program, self.settings(program).file, to, options or {}, force, self.timeout)

    @staticmethod
    def _with(document: Document, options: Settings | None) -> dict[str, Any]:
        params: dict[str, Any] = {"uri": document.uri}
        if options is not None:
            params["options"] = to_json(options)
        return params

    # Repairing

    def actions(self, document: Document, diagnostic: Diagnostic) -> list[Action]:
        """The repairs for one finding, the preferred one first."""
        published = self._wait_for_publish(document)
        lines = document._lines() if isinstance(document, TextDocument) else None
        meant = [one for one in published.diagnostics if diagnostic_from_json(one, lines) == diagnostic]
        if not meant:
            raise Outdated(f"the finding is not in version {document.version} of {document.uri}", CONTENT_MODIFIED)
        found = self._offered(document, meant[0]["range"], meant[:1], "quickfix")
        return sorted(found, key=lambda action: not action.preferred)

    def apply(self, action: Action) -> None:
        """Applies a repair to the document.

        :raises Outdated: the document has changed since the repair was made; nothing was changed.
        """
        document = action.document
        with self._state:
            self._check_open(document)
            if action.version != document.version:
                raise Outdated(
                    f"the repair was made for version {action.version} of {document.uri}, which is now at {document.version}", CONTENT_MODIFIED
                )
            if isinstance(document, Drawing):
                (edit,) = action._what["command"]["arguments"]
                if edit["version"] != document.version:
                    raise Outdated(f"the server made the repair for version {edit['version']} of {document.uri}", CONTENT_MODIFIED)
                self._change_drawing(document, [change_from_json(change) for change in edit["changes"]])
                document._repaired = True
            elif isinstance(document, TextDocument):
                self._apply_text_edit(document, action._what["edit"])

    def format(self, program: TextDocument) -> bool:
        """Brings a program into the layout of the settings, else into that of most of its blocks. False where it has it already."""
        version = program.version
        options = types.FormattingOptions(tab_size=4, insert_spaces=True)
        params = types.DocumentFormattingParams(types.TextDocumentIdentifier(program.uri), options)
        edits = self._ask(program, types.TEXT_DOCUMENT_FORMATTING, params)
        if not edits:
            return False
        identifier = {"uri": program.uri, "version": version}
        with self._state:
            self._apply_text_edit(program, {"documentChanges": [{"textDocument": identifier, "edits": edits}]})
        return True

    def scale(self, program: TextDocument, factor: float) -> None:
        """Multiplies every length of a 3B program by the factor; contours still close.

        :raises Refused: the program cannot be scaled, or the factor is out of range; the message says why.
        :raises Outdated: the program has changed in the meantime; nothing was changed.
        """
        params = types.ExecuteCommandParams("wedm.scale", [{"uri": program.uri, "factor": number(factor, "factor")}])
        version = program.version
        # If the server ends between its request for the edit and its answer, the edit must not be made twice.
        answer = self._ask(program, types.WORKSPACE_EXECUTE_COMMAND, params, lambda: program.version != version) or {"applied": True}
        if not answer.get("applied"):
            raise Outdated(str(answer.get("failureReason")), CONTENT_MODIFIED)

    def fix(self, document: Document, diagnostic: Diagnostic | None = None, *, progress: Told | None = None) -> Fixed:
        """Repairs what can be repaired safely: everything, or the one finding by its preferred repair.

        In a drawing of many contours that takes a while. The logger ``wedm_client`` says how far it is, and so does ``progress``: it
        is called on this thread, with a :class:`Progress`, whenever the server says something and every few seconds. As long as the
        server says something, it is waited for, however long it takes.

        Each repair moves the contour by no more than the correction, and is proved by the server before it is offered. Repairs that
        would leave more errors than there were are taken back. A file is not written: see :meth:`TextDocument.save`.
        """
        before = self.diagnostics(document)
        if diagnostic is not None:
            offered = self.actions(document, diagnostic)
            if not offered:
                return Fixed(before, before)
            self.apply(offered[0])
            return Fixed(before, self.diagnostics(document))
        after = before

        def told(how_far: Progress) -> None:
            share = "" if how_far.percentage is None else f", {how_far.percentage} %"
            LOG.info("%s: %s, %.0f s%s", document.uri, how_far.message, how_far.seconds, share)
            if progress is not None:
                progress(how_far)

        for _ in range(_MOST_ROUNDS):
            whole = {"start": {"line": 0, "character": 0}, "end": {"line": 2**31 - 1, "character": 0}}
            offered = self._offered(document, whole, [], "source.fixAll.wedm", told)
            if not offered:
                break
            old, repaired = self._content(document), document._repaired
            self.apply(offered[0])
            found = self.diagnostics(document)
            if len(found.errors) > len(after.errors):
                self._restore(document, old)
                document._repaired = repaired
                break
            after = found
        return Fixed(before, after)

    def _content(self, document: Document) -> Any:
        with self._state:
            return dict(document._entities) if isinstance(document, Drawing) else getattr(document, "_bytes")

    def _restore(self, document: Document, content: Any) -> None:
        with self._state:
            if isinstance(document, TextDocument):
                self.change(document, content.decode("utf-8"))
            elif isinstance(document, Drawing):
                document._entities = content
                document.version += 1
                if self._connection is not None:
                    self._connection.notify("wedm/didOpenDrawing", {"drawing": document.to_json()})

    def _offered(
        self, document: Document, range: Mapping[str, Any], meant: list[Mapping[str, Any]], kind: str, told: Told | None = None
    ) -> list[Action]:
        params = {"textDocument": {"uri": document.uri}, "range": range, "context": {"diagnostics": meant, "only": [kind]}}
        for _ in itertools.repeat(None, _MOST_TRIES):
            version = document.version
            try:
                found = self._ask(document, types.TEXT_DOCUMENT_CODE_ACTION, params, told=told)
            except Outdated:
                continue
            break
        else:
            raise Outdated(f"{document.uri} changes faster than repairs can be made", CONTENT_MODIFIED)
        return [
            Action(action["title"], bool(action.get("isPreferred")), document, version, action)
            for action in found or []
            if action.get("edit") or action.get("command")
        ]

"""Open documents: what the server was sent, kept so that it can be sent again. Nothing here speaks to a server."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, Protocol

from .cad import write_back_to
from .entities import Change, Delete, Entity, Polyline, Put, Splice, Vertex
from .errors import DoesNotApply, WedmError
from .files import write_beside
from .findings import Diagnostic, Findings, Fixed, Located
from .programs import Fit, PairProgram, Program, Simulation
from .progress import Told
from .results import Contours, Inspection, Picture, Repair, SettingsInForce, Toolpath
from .settings import Settings, Units
from .shown import Rows, counted

#: What programs for a wire are written in.
WireFormat = Literal["3b", "4b", "iso"]
#: What programs are written in; ``"milling"`` is ISO for an electrode.
ProgramFormat = Literal["3b", "4b", "iso", "milling"]

#: Kind of text by the end of a file's name.
LANGUAGES = {".dxf": "dxf", ".3b": "3b", ".4b": "3b", ".iso": "wire-iso", ".nc": "wire-iso"}

#: Lines and characters of a line that are looked at where a name does not tell.
_LINES, _WIDTH = 400, 160


def language_of(ending: str, text: str) -> str:
    """The kind of a text: by the end of its file's name, else by what stands in it; DXF where nothing tells."""
    known = LANGUAGES.get(ending.lower())
    if known is not None or text.split(None, 2)[:2] == ["0", "SECTION"]:
        return known or "dxf"
    return program_of(text) or "dxf"


def program_of(text: str) -> str | None:
    """The language of programs in which most lines of a text are. ``clients/languages.json`` keeps it in step with the server."""
    blocks = words = others = 0
    for line in re.split(r"[\n\r]", text.removeprefix("\ufeff"), maxsplit=_LINES)[:_LINES]:
        close = re.sub(r"[ \t\f\v]", "", line)[:_WIDTH].upper()
        if len(close) <= 2 or close[0] in ";(%*:/":
            continue
        block = re.sub(r"^N\d*:?", "", close)
        if block.startswith("B") and block.count("B") > 2 and re.search("G[XY]", block):
            blocks += 1
        elif re.match(r"[GMXYTDHO][\d.+-]", block) and re.fullmatch(r"[\dA-Z.+,=)-]*", re.split("[;(]", block)[0]):
            words += 1
        else:
            others += 1
    most = max(blocks, words)
    if most == 0 or most <= others:
        return None
    return "3b" if blocks >= words else "wire-iso"


_LINE_END = re.compile(rb"\r\n|\n|\r")
_CODE_PAGE = re.compile(rb"\$DWGCODEPAGE\s+3\s+(\S+)")


class Asked(Protocol):
    """What a document needs of the server that it is open in."""

    def diagnostics(self, document: Document) -> Findings: ...
    def fix(self, document: Document, diagnostic: Diagnostic | None = None, *, progress: Told | None = None) -> Fixed: ...
    def inspect(self, document: Document, handle: str | None = None) -> Inspection: ...
    def contours(self, document: Document) -> Contours: ...
    def toolpath(self, document: Document, options: Settings | None = None) -> Toolpath: ...
    def picture(self, document: Document, options: Settings | None = None) -> Picture: ...
    def fit(self, document: Document, options: Settings | None = None) -> Fit: ...
    def settings(self, document: Document) -> SettingsInForce: ...
    def close_document(self, document: Document) -> None: ...
    def actions(self, document: Document, diagnostic: Diagnostic) -> list[Action]: ...
    def apply(self, action: Action) -> None: ...
    def repairs(self, document: Document, rule: str, handle: str, segment: int | None = None) -> list[Repair]: ...
    def change(self, document: Document, change: str | Change | Sequence[Change]) -> None: ...
    def export(self, document: Document, format: Literal["svg", "png", "pdf"], options: Settings | None = None) -> bytes: ...
    def holes(self, document: Document, format: Literal["csv", "dxf"] = "csv", options: Settings | None = None) -> bytes: ...
    def simulate(self, document: Document, feed: float | None = None) -> Simulation: ...
    def rule_page(self, rule: str) -> str: ...
    def scale(self, program: TextDocument, factor: float) -> None: ...
    def format(self, program: TextDocument) -> bool: ...

    def locate(
        self,
        document: Document,
        line: int | None = None,
        column: int = 1,
        *,
        handle: str | None = None,
        segment: int | None = None,
    ) -> Located | None: ...

    def convert(
        self,
        program: TextDocument,
        to: Literal["dxf", "3b", "4b", "iso"],
        *,
        options: Settings | None = None,
        force: bool = False,
    ) -> str: ...

    def generate(
        self,
        document: Document,
        format: ProgramFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Program: ...

    def pair(
        self,
        document: Document,
        format: WireFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Rows[PairProgram]: ...


class Document:
    """Something that is open in a server. In a notebook it shows its picture.

    What the server can be asked about it, it can be asked itself: ``drawing.fix()`` is ``server.fix(drawing)``.
    """

    def __init__(self, server: Asked, uri: str) -> None:
        self._server = server
        self.uri = uri
        #: Counts the states; a repair that was made for an older one is refused.
        self.version = 1
        # The server has changed it since it was opened or saved.
        self._repaired = False

    def diagnostics(self) -> Findings:
        """See :meth:`Server.diagnostics`."""
        return self._server.diagnostics(self)

    def fix(self, diagnostic: Diagnostic | None = None, *, progress: Told | None = None) -> Fixed:
        """See :meth:`Server.fix`."""
        return self._server.fix(self, diagnostic, progress=progress)

    def inspect(self, handle: str | None = None) -> Inspection:
        """See :meth:`Server.inspect`."""
        return self._server.inspect(self, handle)

    def contours(self) -> Contours:
        """See :meth:`Server.contours`."""
        return self._server.contours(self)

    def toolpath(self, options: Settings | None = None) -> Toolpath:
        """See :meth:`Server.toolpath`."""
        return self._server.toolpath(self, options)

    def picture(self, options: Settings | None = None) -> Picture:
        """See :meth:`Server.picture`."""
        return self._server.picture(self, options)

    def generate(
        self,
        format: ProgramFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Program:
        """See :meth:`Server.generate`."""
        return self._server.generate(self, format, handles=handles, layers=layers, options=options, force=force)

    def fit(self, options: Settings | None = None) -> Fit:
        """See :meth:`Server.fit`."""
        return self._server.fit(self, options)

    def pair(
        self,
        format: WireFormat = "3b",
        *,
        handles: Sequence[str] | None = None,
        layers: Sequence[str] | None = None,
        options: Settings | None = None,
        force: bool = False,
    ) -> Rows[PairProgram]:
        """See :meth:`Server.pair`."""
        return self._server.pair(self, format, handles=handles, layers=layers, options=options, force=force)

    def settings(self) -> SettingsInForce:
        """See :meth:`Server.settings`."""
        return self._server.settings(self)

    def actions(self, diagnostic: Diagnostic) -> list[Action]:
        """See :meth:`Server.actions`."""
        return self._server.actions(self, diagnostic)

    def apply(self, action: Action) -> None:
        """See :meth:`Server.apply`."""
        if action.document is not self:
            raise ValueError(f"the repair is for {action.document.uri}, not for {self.uri}")
        self._server.apply(action)

    def repairs(self, rule: str, handle: str, segment: int | None = None) -> list[Repair]:
        """See :meth:`Server.repairs`."""
        return self._server.repairs(self, rule, handle, segment)

    def change(self, change: str | Change | Sequence[Change]) -> None:
        """See :meth:`Server.change`."""
        self._server.change(self, change)

    def export(self, format: Literal["svg", "png", "pdf"], options: Settings | None = None) -> bytes:
        """See :meth:`Server.export`."""
        return self._server.export(self, format, options)

    def holes(self, format: Literal["csv", "dxf"] = "csv", options: Settings | None = None) -> bytes:
        """See :meth:`Server.holes`."""
        return self._server.holes(self, format, options)

    def simulate(self, feed: float | None = None) -> Simulation:
        """See :meth:`Server.simulate`."""
        return self._server.simulate(self, feed)

    def locate(self, line: int | None = None, column: int = 1, *, handle: str | None = None, segment: int | None = None) -> Located | None:
        """See :meth:`Server.locate`."""
        return self._server.locate(self, line, column, handle=handle, segment=segment)

    def rule_page(self, rule: str) -> str:
        """See :meth:`Server.rule_page`."""
        return self._server.rule_page(rule)

    def close(self) -> None:
        """See :meth:`Server.close_document`."""
        self._server.close_document(self)

    def _forgotten(self) -> str | None:
        """The warning about a document that was closed with repairs that nobody has saved."""
        return None

    def _repr_svg_(self) -> str | None:
        try:
            return self._server.picture(self).svg
        except WedmError:
            # A notebook then shows the text of the object.
            return None


@dataclass(frozen=True)
class Action:
    """A repair that the server offers for the version of the document that it looked at."""

    title: str
    preferred: bool
    document: Document
    version: int
    _what: Mapping[str, Any]


class Drawing(Document):
    """Geometry without text behind it: entities by handle, in machining order."""

    def __init__(self, server: Asked, uri: str, entities: Iterable[Entity], units: Units | None) -> None:
        super().__init__(server, uri)
        self.units = units
        self._entities = {entity.handle: entity for entity in entities}
        #: The ezdxf entities that the drawing was made from, by handle.
        self.sources: dict[str, Any] = {}
        #: Handles of the annotation among them, by kind, such as ``DIMENSION``: no contour is taken from it, as of a file.
        self.left_out: dict[str, list[str]] = {}

    @property
    def entities(self) -> list[Entity]:
        """The entities as they are now, repairs included."""
        return list(self._entities.values())

    def __getitem__(self, handle: str) -> Entity:
        return self._entities[handle]

    def __len__(self) -> int:
        return len(self._entities)

    def __repr__(self) -> str:
        return f"<Drawing {self.uri}: {counted(len(self), 'entity', 'entities')}, version {self.version}>"

    def _forgotten(self) -> str | None:
        if not self._repaired or not self.sources:
            return None
        return f"what was repaired in {self.uri} was not given to its entities of ezdxf: call write_back(drawing)"

    def to_json(self) -> dict[str, Any]:
        """The drawing as the protocol writes it."""
        written: dict[str, Any] = {"uri": self.uri, "version": self.version}
        if self.units is not None:
            written["units"] = self.units
        written["entities"] = [entity.to_json() for entity in self._entities.values()]
        return written

    def _changed(self, changes: Sequence[Change]) -> dict[str, Entity]:
        """The entities after all the changes.

        :raises DoesNotApply: one of them does not apply.
        """
        entities = dict(self._entities)
        for number, change in enumerate(changes, 1):
            try:
                entities = _apply(entities, change)
            except DoesNotApply as reason:
                raise DoesNotApply(f"change {number} of {len(changes)}: {reason}") from None
        return entities


def write_back(drawing: Drawing) -> int:
    """Updates the entities of ezdxf that the drawing was opened from to its present geometry.

    Those that a repair has deleted are destroyed. Handles, layers, colours and all else stay. Returns how many were changed.
    """
    drawing._repaired = False
    return write_back_to(drawing._entities, drawing.sources)


def _apply(entities: dict[str, Entity], change: Change) -> dict[str, Entity]:
    if isinstance(change, Put):
        handle = change.entity.handle
        if not handle:
            raise DoesNotApply("the entity has no handle")
        if handle in entities or change.before is None:
            entities[handle] = change.entity
            return entities
        if change.before not in entities:
            raise DoesNotApply(f"there is no entity {change.before} to put {handle} before")
        ordered = {}
        for other, entity in entities.items():
            if other == change.before:
                ordered[handle] = change.entity
            ordered[other] = entity
        return ordered
    if change.handle not in entities:
        raise DoesNotApply(f"there is no entity {change.handle}")
    if isinstance(change, Delete):
        del entities[change.handle]
        return entities
    entities[change.handle] = _splice(entities[change.handle], change)
    return entities


def _splice(entity: Entity, splice: Splice) -> Polyline:
    if not isinstance(entity, Polyline):
        raise DoesNotApply(f"{entity.handle} is a {entity.kind}, and only polylines have vertices")
    count = len(entity.vertices)
    end = splice.start + splice.delete
    if splice.start < 0 or splice.delete < 0 or end > count:
        raise DoesNotApply(f"{entity.handle} has {count} vertices, expected a range in them, found {splice.start} to {end}")
    inserted = tuple(Vertex(*vertex) for vertex in splice.insert)
    vertices = entity.vertices[: splice.start] + inserted + entity.vertices[end:]
    return replace(entity, vertices=vertices)


class TextDocument(Document):
    """A text: DXF, 3B or wire ISO. ``path`` is the file that it came from, if any."""

    def __init__(self, server: Asked, uri: str, text: str, language: str, path: Path | None = None, encoding: str = "utf-8") -> None:
        super().__init__(server, uri)
        self.language = language
        self.path = path
        #: The encoding of the file, in which it is saved again.
        self.encoding = encoding
        self._bytes = text.encode("utf-8")

    @property
    def text(self) -> str:
        """The text as it is now, repairs included. Reading it counts as saving: closing the document no longer warns."""
        self._repaired = False
        return self._told()

    def _told(self) -> str:
        return self._bytes.decode("utf-8")

    def __repr__(self) -> str:
        name = self.path.name if self.path is not None else self.uri
        repaired = ", changed and not saved" if self._repaired else ""
        return f"<TextDocument {name}: {self.language}, {counted(len(self._lines()), 'line')}, version {self.version}{repaired}>"

    def _forgotten(self) -> str | None:
        if not self._repaired or self.path is None:
            return None
        return f"what was changed in {self.path} was not saved: call document.save()"

    def convert(self, to: Literal["dxf", "3b", "4b", "iso"], *, options: Settings | None = None, force: bool = False) -> str:
        """See :meth:`Server.convert`."""
        return self._server.convert(self, to, options=options, force=force)

    def scale(self, factor: float) -> None:
        """See :meth:`Server.scale`."""
        self._server.scale(self, factor)

    def format(self) -> bool:
        """See :meth:`Server.format`."""
        return self._server.format(self)

    def save(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Writes the text to ``path``, without one to the file that it came from; in that file's encoding.

        The new file is written beside the old one and renamed. Every byte that no edit has touched is as it was.
        """
        target = Path(path) if path is not None else self.path
        if target is None:
            raise ValueError("the text came from no file: say where to save it")
        write_beside(target, self._told().encode(self.encoding))
        self._repaired = False
        return target

    def _lines(self) -> list[bytes]:
        return _LINE_END.split(self._bytes)

    def _position(self, line: int, column: int) -> dict[str, int]:
        """The protocol's form of a line and column that count from 1."""
        lines = self._lines()
        if not 1 <= line <= len(lines) or column < 1:
            raise ValueError(f"line {line}, column {column} is not in a text of {len(lines)} lines")
        before = lines[line - 1].decode("utf-8", "replace")[: column - 1]
        return {"line": line - 1, "character": len(before.encode("utf-8"))}

    def _edited(self, edits: Sequence[Mapping[str, Any]]) -> bytes:
        """The bytes after the edits, whose characters count UTF-8 bytes."""
        starts = [0, *(match.end() for match in _LINE_END.finditer(self._bytes))]
        ends = [*(match.start() for match in _LINE_END.finditer(self._bytes)), len(self._bytes)]

        def offset(position: Mapping[str, int]) -> int:
            line = position["line"]
            if line >= len(starts):
                return len(self._bytes)
            return min(starts[line] + position["character"], ends[line])

        content = bytearray(self._bytes)
        placed = [(offset(edit["range"]["start"]), offset(edit["range"]["end"]), edit["newText"]) for edit in edits]
        # From the last to the first, so that no edit moves another one; of several at one place the first comes first.
        for start, end, new in sorted(reversed(placed), key=lambda edit: edit[:2], reverse=True):
            content[start:end] = new.encode("utf-8")
        return bytes(content)


def read_text(path: Path) -> tuple[str, str]:
    """The file's text and the encoding that gives back the same bytes.

    UTF-8 where it is that, else the code page that a DXF file names, else one character for each byte.
    """
    content = path.read_bytes()
    named = _CODE_PAGE.search(content[:65536])
    for encoding in ("utf-8", _codec(named.group(1)) if named else None):
        if encoding is None:
            continue
        try:
            text = content.decode(encoding)
            if text.encode(encoding) == content:
                return text, encoding
        except (UnicodeError, LookupError):
            continue
    return content.decode("latin-1"), "latin-1"


def _codec(code_page: bytes) -> str | None:
    name = code_page.decode("ascii", "replace").upper().replace("DOS", "ANSI_")
    if not name.startswith("ANSI_"):
        return None
    number = name.removeprefix("ANSI_").strip("_")
    return {"936": "gbk", "1361": "johab"}.get(number, f"cp{number}")

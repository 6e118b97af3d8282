"""A CAD program as the client sees it: a drawing held by ezdxf, its commands, the user's answers, and Windows behind it.

`startapp` and `WScript.Shell` run the real wedm; of the shell `cmd.exe` only what the client writes is understood.
"""

from __future__ import annotations

import io
import math
import os
import re
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
from ezdxf.document import Drawing
from ezdxf.entities import DXFEntity
from ezdxf.lldxf.tagwriter import TagCollector
from ezdxf.lldxf.types import DXFTag
from lisp import Cons, Defined, Fault, Interpreter, Misuse, Symbol, T, items, linked, text

CLIENT = Path(__file__).resolve().parents[1]
CODECS = {"ANSI_936": "gbk", "ANSI_1252": "cp1252"}
POINTS = {10, 11, 210}
ANGLES = {50, 51}
APPEARANCE = {8: "layer", 6: "linetype", 62: "color", 370: "lineweight", 420: "true_color", 48: "ltscale"}
CANCEL = object()
ENTER = None


class Name:
    """The name of an entity, which changes with every session."""

    def __init__(self, handle: str) -> None:
        self.handle = handle

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Name) and other.handle == self.handle

    def __repr__(self) -> str:
        return f"<Entity name: {self.handle}>"


class Handled(Exception):
    """`*error*` has dealt with it."""


class Cad:
    def __init__(
        self,
        document: Drawing,
        folder: Path,
        *,
        name: str = "plate.dwg",
        page: str = "ANSI_1252",
        is_lt: bool = False,
        knows_command_s: bool = True,
        wedm: str | None = None,
        support: Path = CLIENT,
        environment: dict[str, str] | None = None,
    ) -> None:
        self.document, self.folder, self.page = document, folder, page
        self.temporary = folder / "临时 files" if page == "ANSI_936" else folder / "temporary files"
        self.temporary.mkdir(exist_ok=True)
        self.support = support
        self.environment = ({"WEDM": wedm} if wedm else {}) | (environment or {})
        self.variables: dict[str, Any] = {
            "CMDECHO": 1,
            "FILEDIA": 1,
            "OSMODE": 191,
            "EXPERT": 0,
            "UNDOCTL": 5,
            "VIEWSIZE": 100.0,
            "SYSCODEPAGE": page,
            "DWGNAME": name,
            "DWGPREFIX": f"{folder}/",
            "TEMPPREFIX": f"{self.temporary}/",
        }
        self.kept: dict[str, str] = {}
        self.picked: list[str] = []
        self.answers: list[Any] = []
        self.keywords: list[str] = []
        self.undo: list[str] = []
        self.in_group = False
        self.made: list[dict[int, Any]] = []
        self.zoomed: list[tuple[Any, Any]] = []
        self.pending: list[str] = []
        self.started: list[str] = []
        self.commands: list[str] = []
        self.lisp = Interpreter()
        self.lisp.failed = self.failed  # type: ignore[method-assign]
        for function, body in self.functions(is_lt, knows_command_s).items():
            self.lisp.define(function, body)
        self.load("wedm.lsp")

    # The session

    def run(self, command: str, *answers: Any) -> str:
        """What a command prints, given the user's answers."""
        self.answers, self.lisp.printed = list(answers), ""
        before = dict(self.variables)
        try:
            self.lisp.call(Symbol("C:" + command), [])
        except Handled:
            pass
        if self.answers:
            raise Misuse(f"nobody asked for {self.answers}")
        if self.variables != before:
            raise Misuse(f"system variables are left as {self.variables}")
        if self.in_group:
            raise Misuse("the UNDO group is left open")
        left = [path.name for path in self.temporary.iterdir() if "-wedm" not in path.name]
        if left:
            raise Misuse(f"files are left: {left}")
        return self.lisp.printed

    def failed(self, function: Defined, fault: Fault) -> None:
        """A command deals with its faults by its own `*error*`, while its variables are still bound."""
        if Symbol("*error*") in function.local:
            self.lisp.call(self.lisp.get("*error*"), [str(fault)])
            raise Handled from fault

    def load(self, name: str) -> Any:
        path = self.find(name)
        if not path:
            raise Fault(f"LOAD failed: {name}")
        return self.lisp.run(Path(path).read_bytes().decode(CODECS[self.page]))

    def answer(self) -> Any:
        if not self.answers:
            raise Misuse("the user is asked for something that the test does not answer")
        answer = self.answers.pop(0)
        if answer is CANCEL:
            raise Fault("Function cancelled")
        return answer

    def find(self, name: str) -> str | None:
        places = [Path(name)] if os.path.isabs(name) else [self.folder / name, self.support / name]
        return next((str(place) for place in places if place.is_file()), None)

    # The drawing

    @property
    def space(self) -> Any:
        return self.document.modelspace()

    def entity(self, name: Any) -> DXFEntity:
        if not isinstance(name, Name):
            raise Fault(f"bad argument type: lentityp {name!r}")
        found = self.document.entitydb.get(name.handle)
        if found is None or not found.is_alive:
            raise Fault("the entity is gone")
        return found

    def saved(self) -> str:
        stream = io.StringIO()
        self.document.write(stream)
        return stream.getvalue()

    def changes(self) -> None:
        if not self.in_group:
            raise Misuse("the drawing is changed outside an UNDO group: the user would have to take it back piece by piece")

    def is_locked(self, entity: DXFEntity) -> bool:
        layer = self.document.layers.get(entity.dxf.layer) if entity.dxf.layer in self.document.layers else None
        return layer is not None and layer.is_locked()

    def entget(self, name: Any) -> Any:
        tags = TagCollector.dxftags(self.entity(name))
        second = next((at for at, tag in enumerate(tags) if at and tag.code == 0), len(tags))
        tags, groups, at = tags[:second], [Cons(-1, name)], 0
        # A CAD program lists also what DXF leaves out where it is the default.
        present = {tag.code for tag in tags}
        tags += [DXFTag(code, default) for code, default in self.defaults(tags[0].value) if code not in present]
        is_light = tags[0].value == "LWPOLYLINE"
        while at < len(tags):
            code, value = tags[at].code, tags[at].value
            if code in POINTS:
                point = [float(value)]
                while at + 1 < len(tags) and tags[at + 1].code == code + 10 * len(point) and len(point) < (2 if is_light and code == 10 else 3):
                    at += 1
                    point.append(float(tags[at].value))
                groups.append(Cons(code, linked(point)))
            else:
                groups.append(Cons(code, math.radians(value) if code in ANGLES else value))
            at += 1
        return linked(groups)

    def defaults(self, kind: str) -> list[tuple[int, Any]]:
        if kind == "VERTEX":
            return [(40, 0.0), (41, 0.0), (42, 0.0)]
        return [(210, 0.0), (220, 0.0), (230, 1.0)]

    def plain(self, groups: Any) -> list[tuple[int, Any]]:
        """Groups as pairs, their values as Python's; fails for a type that the code does not have."""
        plain = []
        for group in items(groups):
            code, value = group.car, group.cdr
            if not isinstance(code, int):
                raise Fault(f"bad DXF group: {group!r}")
            if code in POINTS:
                value = [float(one) for one in items(value)]
                if len(value) not in (2, 3):
                    raise Fault(f"bad DXF group: {group!r}")
            elif 38 <= code < 60 and not isinstance(value, float):
                raise Fault(f"bad DXF group: {group!r}")
            elif 60 <= code < 100 and not isinstance(value, int):
                raise Fault(f"bad DXF group: {group!r}")
            elif code < 10 and code >= 0 and not isinstance(value, str):
                raise Fault(f"bad DXF group: {group!r}")
            plain.append((code, value))
        return plain

    def entmod(self, groups: Any) -> Any:
        self.changes()
        plain = self.plain(groups)
        own = dict(reversed(plain))
        entity = self.entity(own[-1])
        if self.is_locked(entity):
            return None
        geometry = {10, 11, 38, 40, 41, 42, 43, 50, 51, 70, 90, 91, -1}
        for code, value in self.plain(self.entget(own[-1])):
            if code not in geometry and (code, value) not in plain:
                raise Misuse(f"the group {code} of {own[0]} is lost")
        self.shape(entity, plain)
        return groups

    def shape(self, entity: DXFEntity, plain: list[tuple[int, Any]]) -> None:
        own, kind = dict(reversed(plain)), entity.dxftype()
        if kind == "LINE":
            entity.dxf.start, entity.dxf.end = own[10], own[11]
        elif kind in ("ARC", "CIRCLE"):
            entity.dxf.center, entity.dxf.radius = own[10], own[40]
            if kind == "ARC":
                entity.dxf.start_angle, entity.dxf.end_angle = math.degrees(own[50]), math.degrees(own[51])
        elif kind == "VERTEX":
            entity.dxf.location, entity.dxf.bulge = own[10], own.get(42, 0.0)
        elif kind == "POLYLINE":
            entity.dxf.flags = own[70]
        elif kind == "LWPOLYLINE":
            points: list[list[float]] = []
            for code, value in plain:
                if code == 10:
                    if len(value) != 2:
                        raise Fault("a vertex of a LWPOLYLINE has two coordinates")
                    points.append([*value, 0.0, 0.0, 0.0])
                elif code in (40, 41, 42):
                    points[-1][code - 38] = value
            if own[90] != len(points):
                raise Fault(f"{own[90]} vertices are announced, {len(points)} are there")
            entity.set_points([tuple(point) for point in points], format="xyseb")  # type: ignore[attr-defined]
            entity.dxf.flags = own[70]
        else:
            raise Misuse(f"a {kind} is changed")

    def entmake(self, groups: Any) -> Any:
        self.changes()
        plain = self.plain(groups)
        own = dict(reversed(plain))
        kind = own[0]
        if {-1, 5} & own.keys():
            raise Misuse("a new entity has neither name nor handle")
        if kind in ("POLYLINE", "VERTEX", "SEQEND"):
            return self.entmake_polyline(kind, own, groups)
        if self.made:
            raise Fault("a POLYLINE is not ended")
        looks = {name: own[code] for code, name in APPEARANCE.items() if code in own}
        if kind == "TEXT":
            self.space.add_text(own[1], height=own[40], dxfattribs=looks | {"insert": own[10]})
            return groups
        if kind == "LWPOLYLINE":
            codes = [code for code, _ in plain]
            if [value for code, value in plain if code == 100] != ["AcDbEntity", "AcDbPolyline"] or codes.index(90) > codes.index(10):
                raise Fault("a LWPOLYLINE is made of marked parts")
        made = self.space.new_entity(kind, looks | ({"extrusion": own[210]} if 210 in own else {}))
        self.shape(made, plain)
        return groups

    def entmake_polyline(self, kind: str, own: dict[int, Any], groups: Any) -> Any:
        if (kind == "POLYLINE") == bool(self.made):
            raise Fault("records of a POLYLINE out of their order")
        self.made.append(own)
        if kind == "SEQEND":
            (head, *vertices, _), self.made = self.made, []
            looks = {name: head[code] for code, name in APPEARANCE.items() if code in head}
            points = [(*vertex[10][:2], vertex.get(40, 0.0), vertex.get(41, 0.0), vertex.get(42, 0.0)) for vertex in vertices]
            polyline = self.space.add_polyline2d(points, format="xyseb", dxfattribs=looks)
            polyline.dxf.flags = head[70]
        return groups

    def entdel(self, name: Any) -> Any:
        self.changes()
        entity = self.entity(name)
        if self.is_locked(entity):
            return None
        self.space.delete_entity(entity)
        return name

    def entnext(self, name: Any) -> Any:
        entity = self.entity(name)
        for polyline in self.space.query("POLYLINE"):
            records = [polyline, *polyline.vertices, polyline.seqend]
            if entity in records[:-1]:
                return Name(records[records.index(entity) + 1].dxf.handle)
        return None

    def ssget(self, mode: str, wanted: Any = None) -> Any:
        filters = dict(self.plain(wanted))
        entities = list(self.space)
        if mode == "_I":
            entities = [entity for entity in entities if entity.dxf.handle in self.picked]
        elif mode != "_X":
            raise Misuse(f"ssget {mode}")
        kinds = filters.get(0, "").split(",")
        entities = [entity for entity in entities if 0 not in filters or entity.dxftype() in kinds]
        entities = [entity for entity in entities if 8 not in filters or entity.dxf.layer == filters[8]]
        return [Name(entity.dxf.handle) for entity in entities] or None

    # Commands

    def command(self, name: str, *words: Any) -> None:
        if not name.startswith("_."):
            raise Misuse(f"{name}: a command that is translated or redefined elsewhere")
        name = name[2:]
        self.commands.append(name)
        if name == "DXFOUT":
            self.dxfout(*words)
        elif name == "UNDO":
            self.group(*words)
        elif name == "U":
            self.take_back()
        elif name == "-LAYER":
            self.layer(list(words))
        elif name == "ZOOM":
            mode, place, height = words
            if mode != "_C" or self.variables["OSMODE"]:
                raise Misuse(f"ZOOM {words} with OSMODE {self.variables['OSMODE']}")
            self.zoomed.append((items(place), height))
        elif name == "DELAY":
            if self.pending:
                self.shell(self.pending.pop(0))
        else:
            raise Misuse(f"unknown command {name}")

    def dxfout(self, path: str, precision: str) -> None:
        if self.variables["FILEDIA"] or precision != "16":
            raise Misuse("DXFOUT opens a dialog or rounds")
        if os.path.exists(path):
            raise Misuse("DXFOUT asks whether it may overwrite")
        self.document.saveas(path)

    def group(self, word: str) -> None:
        if (word == "_BE") == self.in_group or word not in ("_BE", "_E"):
            raise Misuse(f"UNDO {word} out of its order")
        if word == "_BE":
            self.undo.append(self.saved())
        self.in_group = word == "_BE"

    def take_back(self) -> None:
        self.document = ezdxf.read(io.StringIO(self.undo.pop()))

    def layer(self, words: list[str]) -> None:
        while words[0]:
            option = words.pop(0)
            if option == "_N":
                name = words.pop(0)
                if name not in self.document.layers:
                    self.document.layers.add(name)
            elif option == "_C":
                colour, name = words.pop(0), words.pop(0)
                self.document.layers.get(name).color = int(colour)
            elif option in ("_ON", "_T", "_U"):
                layer = self.document.layers.get(words.pop(0))
                {"_ON": layer.on, "_T": layer.thaw, "_U": layer.unlock}[option]()
            else:
                raise Misuse(f"-LAYER {option}")
        if len(words) != 1:
            raise Misuse(f"-LAYER is left with {words}")

    # Windows

    def shell(self, words: str) -> int:
        """`cmd.exe /d /s /c "..."`: programs with redirections, and `move`."""
        found = re.fullmatch(r'/d /s /c "(.*)"', words)
        if not found:
            raise Misuse(f"cmd.exe {words}")
        status = 0
        for command in re.split(r' & (?=(?:[^"]*"[^"]*")*[^"]*$)', found[1]):
            lexer = shlex.shlex(command, posix=True, punctuation_chars=False)
            lexer.whitespace_split, lexer.escape, lexer.commenters, lexer.quotes = True, "", "", '"'
            status = self.program(list(lexer))
        return status

    def program(self, words: list[str]) -> int:
        streams: dict[str, Any] = {}
        while len(words) > 2 and words[-2] in (">", "2>"):
            target = words.pop()
            streams[words.pop()] = open(os.devnull if target == "nul" else target, "wb")
        output, errors = (streams.get(key, subprocess.DEVNULL) for key in (">", "2>"))
        try:
            if words[:2] == ["move", "/y"]:
                os.replace(words[2], words[3])
                return 0
            if not os.access(words[0], os.X_OK):
                errors.write(f"'{words[0]}' is not recognized as an internal or external command\r\n".encode())
                return 9009
            environment = {key: value for key, value in os.environ.items() if key not in ("LANG", "LC_ALL", "LC_MESSAGES")}
            return subprocess.run(words, stdout=output, stderr=errors, env=environment, cwd=self.temporary, timeout=60).returncode
        finally:
            for stream in streams.values():
                stream.close()

    def startapp(self, program: str, words: str) -> int:
        if program != "cmd.exe":
            raise Misuse(f"{program} may have spaces in its name")
        started = re.fullmatch(r'/d /s /c "start "wedm" /min (.*)"', words)
        if started:
            self.started.append(started[1])
        else:
            self.pending.append(words)
        return 33

    # What AutoLISP calls

    def functions(self, is_lt: bool, knows_command_s: bool) -> dict[str, Callable[..., Any]]:
        def getkword(prompt: str) -> Any:
            answer, keywords, self.keywords = self.answer(), self.keywords, []
            if answer is not ENTER and answer not in keywords:
                raise Misuse(f"{answer} is none of {keywords}")
            return answer

        def initget(keywords: str) -> None:
            self.keywords = keywords.split()

        def setvar(name: str, value: Any) -> Any:
            if name not in self.variables:
                raise Fault(f"AutoCAD variable setting rejected: {name} {value!r}")
            self.variables[name] = value
            return value

        def opened(path: str, mode: str) -> Any:
            try:
                return open(path, mode, encoding=CODECS[self.page], newline="" if mode == "w" else None)
            except OSError:
                return None

        def delete(path: str) -> Any:
            try:
                os.remove(text(path))
            except OSError:
                return None
            return T

        def temporary(pattern: str) -> str:
            stem, ending = os.path.splitext(pattern)
            number = next(one for one in range(1000) if not (self.temporary / f"{stem}{one:03}{ending}").exists())
            return str(self.temporary / f"{stem}{number:03}{ending}")

        def setcfg(key: str, value: str) -> str:
            if not key.startswith("AppData/"):
                raise Misuse(f"setcfg of {key}")
            self.kept[key] = value
            return value

        def line(file: Any) -> Any:
            read = file.readline()
            return read.rstrip("\r\n") if read else None

        def handent(handle: str) -> Any:
            found = self.document.entitydb.get(text(handle))
            return Name(handle) if found is not None and found.is_alive else None

        def invoke(shell: Any, method: Symbol, words: str, style: int, waits: Any) -> Any:
            if method is not Symbol("Run") or style != 0 or waits is not T or not words.startswith("cmd.exe "):
                raise Misuse(f"{method} {words} {style} {waits}")
            return self.shell(words.removeprefix("cmd.exe "))

        functions = {
            "getvar": lambda name: self.variables.get(name),
            "setvar": setvar,
            "getenv": lambda name: self.environment.get(name),
            "getcfg": lambda key: self.kept.get(key),
            "setcfg": setcfg,
            "findfile": lambda name: self.find(text(name)),
            "load": self.load,
            "getfiled": lambda title, default, ending, flags: self.answer(),
            "getint": lambda prompt: self.answer(),
            "getkword": getkword,
            "initget": initget,
            "open": opened,
            "close": lambda file: file.close(),
            "read-line": line,
            "vl-file-delete": delete,
            "vl-filename-mktemp": temporary,
            "vl-filename-base": lambda name: Path(text(name)).stem,
            "startapp": self.startapp,
            "command": self.command,
            "trans": lambda point, source, target: point,
            "handent": handent,
            "entget": self.entget,
            "entmod": self.entmod,
            "entmake": self.entmake,
            "entdel": self.entdel,
            "entnext": self.entnext,
            "entupd": lambda name: name,
            "tblsearch": lambda table, name: linked([Cons(2, name)]) if table == "LAYER" and name in self.document.layers else None,
            "ssget": self.ssget,
            "sslength": len,
            "ssname": lambda selection, index: selection[index],
        }
        if knows_command_s:
            functions["command-s"] = self.command
        if not is_lt:
            self.lisp.values[Symbol(":vlax-true")] = T
            functions |= {
                "vl-load-com": lambda: None,
                "vlax-create-object": lambda name: object() if name == "WScript.Shell" else None,
                "vlax-invoke-method": invoke,
                "vlax-release-object": lambda shell: None,
            }
        return functions

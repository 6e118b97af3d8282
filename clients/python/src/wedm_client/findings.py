"""What is found in a document, and where it stands there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Union

from .shown import Rows, Tabled, Value

Severity = Literal["error", "warning", "information", "hint"]

SEVERITIES: dict[int, Severity] = {1: "error", 2: "warning", 3: "information", 4: "hint"}


@dataclass(frozen=True)
class Diagnostic(Value):
    """A finding: the rule, its numbers, and the place.

    ``line`` and ``column`` count from 1 and are there for text documents; in a drawing ``handle`` and ``segment`` give the place.
    ``data`` holds all data of the finding in the protocol.
    """

    rule: str
    severity: Severity
    message: str
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    end_column: int | None = None
    page: str | None = None
    data: Mapping[str, Any] = field(default_factory=dict)

    @property
    def handle(self) -> str | None:
        """The entity's handle, for a finding on a segment."""
        handle = self.data.get("handle")
        return handle if isinstance(handle, str) else None

    @property
    def segment(self) -> int | None:
        """The segment's index in its entity: that of the vertex it starts in."""
        segment = self.data.get("segment")
        return segment if isinstance(segment, int) else None

    @property
    def radius(self) -> float | None:
        """The radius at fault."""
        return self._number("radius")

    @property
    def required(self) -> float | None:
        """The smallest radius that the wire can follow."""
        return self._number("required")

    def _number(self, key: str) -> float | None:
        value = self.data.get(key)
        return float(value) if isinstance(value, (int, float)) else None

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        named = {"severity": self.severity, "rule": self.rule, "line": self.line, "handle": self.handle, "segment": self.segment}
        return {**named, "radius": self.radius, "required": self.required, "message": self.message}

    def __repr__(self) -> str:
        return f"<{self}>"

    def __str__(self) -> str:
        place = f"line {self.line}: " if self.line is not None else ""
        if self.handle is not None:
            place += f"{self.handle} segment {self.segment}: " if self.segment is not None else f"{self.handle}: "
        return f"{self.severity}[{self.rule}] {place}{self.message}"


class Findings(Rows[Diagnostic]):
    """The findings of a document: a list, which a notebook shows as a table."""

    @property
    def errors(self) -> list[Diagnostic]:
        """The errors, which spoil the part: no program is made while there is one."""
        return [one for one in self if one.severity == "error"]

    @property
    def warnings(self) -> list[Diagnostic]:
        """The warnings, to be looked at before the part is cut."""
        return [one for one in self if one.severity == "warning"]

    def __str__(self) -> str:
        return "\n".join(map(str, self)) or "nothing found"


@dataclass(frozen=True)
class Fixed(Tabled):
    """The findings of the document before and after the repairs."""

    before: Findings
    after: Findings

    def rows(self) -> list[dict[str, Any]]:
        """A row for each finding, those that are left after those that are gone."""
        gone = [one for one in self.before if one not in self.after]
        return [{"is": "repaired", **one.row()} for one in gone] + [{"is": "left", **one.row()} for one in self.after]

    def __repr__(self) -> str:
        return f"<Fixed: {len(self.before)} findings before, {len(self.after)} after>"

    @property
    def changed(self) -> bool:
        return self.before != self.after


@dataclass(frozen=True)
class Located(Value):
    """Where a segment, or an entity, is written in a text. Lines and columns count from 1."""

    handle: str
    line: int
    column: int
    end_line: int
    end_column: int
    #: None: the place is of the entity, and of none of its segments.
    segment: int | None = None


TextLines = Union[list[bytes], None]


def diagnostic_from_json(value: Mapping[str, Any], lines: TextLines) -> Diagnostic:
    """A diagnostic of the protocol; ``lines`` are those of the text that it stands in, in UTF-8, None for a drawing."""
    place: dict[str, int] = {}
    if lines is not None:
        start, end = value["range"]["start"], value["range"]["end"]
        place = {
            "line": start["line"] + 1,
            "column": _column(lines, start),
            "end_line": end["line"] + 1,
            "end_column": _column(lines, end),
        }
    description = value.get("codeDescription") or {}
    return Diagnostic(
        rule=str(value.get("code", "")),
        severity=SEVERITIES.get(value.get("severity", 1), "error"),
        message=str(value["message"]),
        page=description.get("href"),
        data=value.get("data") or {},
        **place,
    )


def located_from_json(value: Mapping[str, Any], lines: list[bytes]) -> Located:
    """A place of the protocol in a text of these lines."""
    start, end = value["range"]["start"], value["range"]["end"]
    return Located(
        value["handle"], start["line"] + 1, _column(lines, start), end["line"] + 1, _column(lines, end), segment=value.get("segment")
    )


def _column(lines: list[bytes], position: Mapping[str, int]) -> int:
    line, character = position["line"], position["character"]
    if line >= len(lines):
        return character + 1
    return len(lines[line][:character].decode("utf-8", "replace")) + 1

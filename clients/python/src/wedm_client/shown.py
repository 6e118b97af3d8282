"""How a result shows itself: as a dictionary, as a table in a notebook, as one line in a console. It knows no result."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from html import escape
from typing import Any, Generic, TypeVar

T = TypeVar("T")

#: Rows that a notebook shows of one table; what is left out is counted below it.
MOST_ROWS = 200

#: Digits after the point of the numbers in texts; the values themselves have all of them.
DIGITS = 4


def plain(value: Any) -> Any:
    """The value as dictionaries, lists, numbers and words: what JSON and pandas take. A point is `[x, y]`."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return value


class Value:
    """What every result can do beside holding its values."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        # A dataclass writes its own `__repr__`, with all digits, unless the class has one.
        if "__repr__" not in cls.__dict__:
            setattr(cls, "__repr__", cls.__repr__)

    def __repr__(self) -> str:
        names: list[str] = [one.name for one in fields(self)] if is_dataclass(self) else []
        named = [f"{name}={rounded(getattr(self, name))!r}" for name in names if getattr(self, name) is not None]
        return f"{type(self).__name__}({', '.join(named)})"

    def to_dict(self) -> dict[str, Any]:
        """The values by the names of their fields, nested ones too: for JSON, or for a table of pandas."""
        written: dict[str, Any] = plain(self)
        return written


def rounded(value: Any) -> Any:
    """The value with no more digits than a text for people has."""
    match value:
        case float():
            return round(value, DIGITS)
        case tuple():
            return tuple(map(rounded, value))
        case list() if type(value) is list:
            return [rounded(one) for one in value]
    return value


class Tabled(Value):
    """A result that a notebook shows as a table."""

    def rows(self) -> list[dict[str, Any]]:
        """A row for each thing that the result lists, by the names of the columns; `pandas.DataFrame(result.rows())` takes them."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        return table(self.rows())


class Listing(Tabled, Generic[T]):
    """A result that lists things: `for one in result`, `len(result)` and `result[0]` are of these."""

    def _listed(self) -> Sequence[T]:
        raise NotImplementedError

    def __iter__(self) -> Iterator[T]:
        return iter(self._listed())

    def __len__(self) -> int:
        return len(self._listed())

    def __getitem__(self, index: int) -> T:
        return self._listed()[index]


class Rows(list[T]):
    """A list that a notebook shows as a table; otherwise it is a list."""

    def rows(self) -> list[dict[str, Any]]:
        """A row for each entry, by the names of the columns."""
        return [row(one) for one in self]

    def to_dict(self) -> list[dict[str, Any]]:
        """The entries as dictionaries."""
        return [plain(one) for one in self]

    def _repr_html_(self) -> str:
        return table(self.rows())


def row(value: Any) -> dict[str, Any]:
    """The row for a value: its own where it has one, else its fields."""
    own = getattr(value, "row", None)
    written: dict[str, Any] = own() if own is not None else plain(value)
    return written


def table(rows: Sequence[Mapping[str, Any]]) -> str:
    """The rows as a table of HTML. Empty columns are left out; numbers are aligned right."""
    names = list(dict.fromkeys(name for one in rows for name, value in one.items() if value not in (None, "")))
    if not names:
        return "<p>nothing</p>"
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    body = "".join(f"<tr>{''.join(_cell(one.get(name)) for name in names)}</tr>" for one in rows[:MOST_ROWS])
    left = len(rows) - MOST_ROWS
    more = f"<p>… and {left} more</p>" if left > 0 else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _cell(value: Any) -> str:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    side = "right" if is_number or isinstance(value, tuple) else "left"
    return f'<td style="text-align:{side}">{escape(_said(value))}</td>'


def _said(value: Any) -> str:
    match value:
        case None:
            return ""
        case bool():
            return "yes" if value else "no"
        case float():
            return f"{value:.{DIGITS}f}"
        case list() | tuple():
            return ", ".join(map(_said, value))
    return str(value)


def counted(number: int, name: str, names: str | None = None) -> str:
    """A number with the word for what it counts: `1 entity`, `2 entities`."""
    return f"{number} {name if number == 1 else names or f'{name}s'}"


def listed(parts: Iterable[str]) -> str:
    """The parts that are not empty, with commas."""
    return ", ".join(part for part in parts if part)

"""What is expected of an answer, where it is less than the whole of it."""

from __future__ import annotations

import math
from typing import Any


class Every:
    """Stands in an expectation for a value that `holds` accepts."""

    def __init__(self, holds: Any, what: str) -> None:
        self.holds, self.what = holds, what

    def __repr__(self) -> str:
        return self.what


def near(number: float) -> Every:
    return Every(lambda value: isinstance(value, (int, float)) and math.isclose(value, number, abs_tol=1e-6), f"near {number}")


def text(*parts: str) -> Every:
    return Every(lambda value: isinstance(value, str) and all(part in value for part in parts), f"a text with {parts}")


def some(*expected: Any) -> Every:
    """A list in which each of the expected stands."""

    def holds(value: Any) -> bool:
        return isinstance(value, list) and all(any(differs(one, found) is None for found in value) for one in expected)

    return Every(holds, f"a list with {expected}")


anything = Every(lambda value: bool(value), "something")


def differs(expected: Any, found: Any, at: str = "") -> str | None:
    """Where the found is not as expected; keys that are not expected do not count."""
    if isinstance(expected, Every):
        return None if expected.holds(found) else f"{at}: {found!r} is not {expected}"
    if isinstance(expected, dict):
        if not isinstance(found, dict):
            return f"{at}: {found!r} is no object"
        return next((said for key, value in expected.items() if (said := differs(value, found.get(key), f"{at}.{key}"))), None)
    if isinstance(expected, list):
        if not isinstance(found, list) or len(found) != len(expected):
            return f"{at}: {found!r} has not {len(expected)} entries"
        return next((said for n, (one, other) in enumerate(zip(expected, found, strict=True)) if (said := differs(one, other, f"{at}[{n}]"))), None)
    return None if expected == found else f"{at}: {found!r}, expected {expected!r}"

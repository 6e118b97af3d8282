"""What the server says of a request while it works on it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from .shown import Value

# Seconds after which it is told again how long it has taken, though the server has said nothing more.
_REMINDER = 5.0


@dataclass(frozen=True)
class Progress(Value):
    """How far a long request is: of ``fix``, how many in a hundred of the findings are repaired."""

    #: What the server is doing, in its language.
    message: str
    #: Seconds since it was asked.
    seconds: float
    #: None while the server has not said.
    percentage: int | None = None


#: Gets the progress of a request, on the thread that has asked.
Told = Callable[[Progress], None]


class Heard:
    """What is heard of one request. The thread that reads messages writes, the one that waits for the answer tells."""

    def __init__(self, told: Told) -> None:
        self._told = told
        self._lock = threading.Lock()
        self._waiting: list[tuple[str, int | None]] = []
        self._last: tuple[str, int | None] = ("", None)
        self._asked = self._told_at = self._heard_at = time.monotonic()

    def hear(self, value: Mapping[str, Any]) -> None:
        """Takes the ``value`` of a ``$/progress``."""
        with self._lock:
            self._heard_at = time.monotonic()
            if value.get("kind") != "end":
                self._waiting.append((str(value.get("message") or value.get("title") or self._last[0]), value.get("percentage")))

    @property
    def silence(self) -> float:
        """Seconds since the server has said something of it."""
        return time.monotonic() - self._heard_at

    def tell(self) -> None:
        """Hands on what has been heard since; after a while also that nothing has."""
        with self._lock:
            waiting, self._waiting = self._waiting, []
        now = time.monotonic()
        if not waiting and now - self._told_at < _REMINDER:
            return
        self._told_at = now
        for message, percentage in waiting or [self._last]:
            self._last = (message, percentage)
            self._told(Progress(message, now - self._asked, percentage))

"""How often a server that ends is started again, and after what pause.

"When the server ends" in docs/protocol.md is the same for every client.
"""

from __future__ import annotations

_PAUSES = (0.0, 0.5, 1.0, 2.0, 4.0)
# Seconds. After a server that has lived this long, the count of ends in a row begins again.
_SOUND_LIFE = 60.0

#: Ends in a row after which it is not started again.
MOST_ENDS = len(_PAUSES) + 1


class Restarts:
    """Counts ends in a row."""

    def __init__(self) -> None:
        self._ends = 0

    def after_life_of(self, life: float) -> float | None:
        """The pause before the next start; None when the server has ended too often.

        :param life: seconds from its answer to ``initialize`` to its end; 0 where none came.
        """
        if life >= _SOUND_LIFE:
            self._ends = 0
        if self._ends == len(_PAUSES):
            return None
        self._ends += 1
        return _PAUSES[self._ends - 1]

    def reset(self) -> None:
        """Another start is wanted: earlier ends no longer count."""
        self._ends = 0

"""A map: parcels whose borders are single lines; some are drawn twice, and some miss the corner that they lead to."""

from __future__ import annotations

import random

_HEAD = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
# mm from one parcel to the next, of its side, and by how much its corners lie off a square.
_GRID, _SIDE, _OFF = 20.0, 12.0, 2.0
# By how much the ends of borders miss their corner, and how often a border is drawn: one of the values, each as likely.
_MISSED = (0.0, 0.0, 0.0, 0.004)
_DRAWN = (1, 1, 1, 1, 1, 2)


def map_of(parcels: int, seed: int = 1) -> str:
    """DXF text of so many parcels along each side; about 300 bytes for each of them."""
    chance = random.Random(seed)
    lines: list[str] = []
    for column in range(parcels):
        for row in range(parcels):
            square = [(0.0, 0.0), (_SIDE, 0.0), (_SIDE, _SIDE), (0.0, _SIDE)]
            corners = [(column * _GRID + x + chance.uniform(-_OFF, _OFF), row * _GRID + y + chance.uniform(-_OFF, _OFF)) for x, y in square]
            for (x, y), (end_x, end_y) in zip(corners, [*corners[1:], corners[0]], strict=True):
                line = f"0\nLINE\n8\nMAP\n10\n{x + chance.choice(_MISSED):.4f}\n20\n{y:.4f}\n11\n{end_x:.4f}\n21\n{end_y:.4f}\n"
                lines += [line] * chance.choice(_DRAWN)
    return f"{_HEAD}{''.join(lines)}0\nENDSEC\n0\nEOF\n"

"""A map: parcels whose borders are single lines, each drawn once, some of which miss the corner that they lead to."""

from __future__ import annotations

import random

_HEAD = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
# mm of a parcel, by how much its corners lie off the grid, and by how much the ends of borders miss them.
_PARCEL = 20.0
_OFF = 4.0
_MISSED = (0.0, 0.0, 0.0, 0.004)


def map_of(parcels: int, seed: int = 1) -> str:
    """DXF text of so many parcels along each side; about 115 bytes for each of its lines, of which a parcel has two."""
    chance = random.Random(seed)
    corners = {
        (column, row): (column * _PARCEL + chance.uniform(-_OFF, _OFF), row * _PARCEL + chance.uniform(-_OFF, _OFF))
        for column in range(parcels + 1)
        for row in range(parcels + 1)
    }
    lines = []
    for (column, row), (x, y) in corners.items():
        for to in ((column + 1, row), (column, row + 1)):
            if to in corners:
                end_x, end_y = corners[to]
                lines.append(
                    f"0\nLINE\n8\nMAP\n10\n{x + chance.choice(_MISSED):.4f}\n20\n{y:.4f}\n11\n{end_x:.4f}\n21\n{end_y + chance.choice(_MISSED):.4f}\n"
                )
    return f"{_HEAD}{''.join(lines)}0\nENDSEC\n0\nEOF\n"

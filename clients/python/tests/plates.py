"""Outlines that more than one test needs."""

from __future__ import annotations

QUARTER = 0.41421356237309503

#: A plate 20 × 10 whose only rounded corner has R 0.080: the wire with correction 0.100 cannot follow it.
TIGHT = [(0.0, 0.0), (19.92, 0.0, QUARTER), (20.0, 0.08), (20.0, 10.0), (0.0, 10.0)]
#: The same with R 2.
ROUND = [(0.0, 0.0), (18.0, 0.0, QUARTER), (20.0, 2.0), (20.0, 10.0), (0.0, 10.0)]

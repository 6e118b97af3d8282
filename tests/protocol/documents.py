"""The documents that are opened in the tests of methods."""

from __future__ import annotations

from typing import Any

from conftest import Client

QUARTER = 0.41421356237309503
DXF, PROGRAM, CAD = "file:///session/tight_fillet.dxf", "file:///session/numbered.3b", "cad:plate"
UNTIDY = "file:///session/untidy.3b"
NUMBERED = "; a hole\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nDD\n"


def plate(handle: str, radius: float, lift: float = 0.0) -> dict[str, Any]:
    """A plate 20 × 10 with one rounded corner."""
    vertices = [[0, lift], [20 - radius, lift, QUARTER], [20, lift + radius], [20, lift + 10], [0, lift + 10]]
    return {"handle": handle, "type": "polyline", "closed": True, "role": "opening", "vertices": vertices}


async def open_everything(client: Client) -> None:
    await client.open_text("tight_fillet.dxf")
    await client.open_text("numbered.3b", NUMBERED, "3b")
    await client.open_text("untidy.3b", "b9900 b0 b9900 gx l1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n", "3b")
    await client.open_drawing(CAD, plate("2A", 0.05), plate("2B", 2.0, 30))
    await client.open_drawing("cad:clean", plate("2A", 2.0))

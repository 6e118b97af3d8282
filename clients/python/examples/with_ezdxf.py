"""A drawing made with ezdxf: checked and repaired before it is saved.

python with_ezdxf.py DRAWING.dxf
"""

from __future__ import annotations

import sys

from ezdxf.filemanagement import new

from wedm_client import Drawing, Server, write_back


def main() -> None:
    target = sys.argv[1] if len(sys.argv) > 1 else "with_ezdxf.dxf"
    document = new(units=4)
    space = document.modelspace()
    # A rack of slots with rounded ends; the narrowest ones are too tight for the wire.
    for number in range(5):
        left, radius = number * 10, 0.06 + 0.02 * number
        points = [(left, 0, 0), (left + 6, 0, 0.4142), (left + 6 + radius, radius, 0), (left + 6 + radius, 8, 0), (left, 8, 0)]
        space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": "SLOTS"})

    with Server(settings={"correction": 0.11, "layers": {"SLOTS": "opening"}}) as server:
        drawing = server.open(space, units="mm")
        assert isinstance(drawing, Drawing)
        for diagnostic in server.diagnostics(drawing):
            if diagnostic.severity == "error":
                print(diagnostic)
        server.fix(drawing)
        print(f"{write_back(drawing)} polylines repaired")
    document.saveas(target)


if __name__ == "__main__":
    main()

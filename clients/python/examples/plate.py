"""A plate from numbers: checked, repaired, and the 3B program for the machine written.

python plate.py [PROGRAM.3b]
"""

from __future__ import annotations

import math
import sys

from wedm_client import Circle, Polyline, Server, Text

QUARTER = math.tan(math.pi / 8)  # bulge of a quarter of a turn

# An opening 20 × 10 with one corner of R 0.08 that somebody typed in place of R 0.8, and a hole in which it is threaded.
OPENING = Polyline(
    [(1, 0), (19.92, 0, QUARTER), (20, 0.08), (20, 9, QUARTER), (19, 10), (1, 10, QUARTER), (0, 9), (0, 1, QUARTER)],
    handle="OPENING",
    role="opening",
)
DOWEL = Circle((30, 5), 2.5, handle="DOWEL", role="opening")
THREAD_HOLES = [Text((10, 5), "O"), Text((30, 5), "O")]


def main() -> None:
    target = sys.argv[1] if len(sys.argv) > 1 else "plate.3b"
    with Server(settings={"correction": 0.12}) as server:
        drawing = server.open([OPENING, DOWEL, *THREAD_HOLES])
        for diagnostic in drawing.diagnostics():
            print(diagnostic)

        fixed = drawing.fix()
        print(f"{len(fixed.before) - len(fixed.after)} repaired, {len(fixed.after)} left")

        program = drawing.generate("3b")
        program.save(target)
        print(f"{target}: {program.blocks} blocks, cut {program.length:.3f} mm, at most {program.deviation:.2f} µm from the path")


if __name__ == "__main__":
    main()

"""Repairs a DXF file and writes the result to another one; every byte that is not at fault stays.

python repair_file.py DRAWING.dxf REPAIRED.dxf [CORRECTION]
"""

from __future__ import annotations

import sys

from wedm_client import Server


def main() -> int:
    source, target = sys.argv[1:3]
    correction = float(sys.argv[3]) if len(sys.argv) > 3 else 0.10
    with Server(settings={"correction": correction}) as server:
        document = server.open(source)
        fixed = document.fix()
        document.save(target)
        for diagnostic in fixed.after:
            print(diagnostic)
    print(f"{target}: {len(fixed.before)} findings before, {len(fixed.after)} after")
    return 1 if fixed.after.errors else 0


if __name__ == "__main__":
    sys.exit(main())

"""Reads DXF files with ezdxf down to the numbers of every entity; prints seconds and numbers for each file.

Run by `cargo bench --bench reading`, which finds an interpreter with ezdxf in `target/ezdxf`:

    python3 -m venv target/ezdxf && target/ezdxf/bin/pip install -r benches/requirements.txt
"""

import sys
import time

try:
    import ezdxf
except ImportError:
    sys.exit("not installed")


def numbers_of(entity):
    """How many numbers an entity holds, each of them fetched."""
    kind, dxf = entity.dxftype(), entity.dxf
    if kind == "LWPOLYLINE":
        return 3 * len(entity.get_points("xyb"))
    if kind == "LINE":
        return len(dxf.start) + len(dxf.end)
    if kind == "ARC":
        return len(dxf.center) + len((dxf.radius, dxf.start_angle, dxf.end_angle))
    return 0


for path in sys.argv[1:]:
    began = time.perf_counter()
    drawing = ezdxf.readfile(path)
    numbers = sum(numbers_of(entity) for entity in drawing.modelspace())
    print(time.perf_counter() - began, numbers, flush=True)

#!/usr/bin/env python3
"""How many drawings `check_many` checks in a second, by kind and number of workers; prints the table of the README.

    python scaling.py [--files 1000] [--workers 1 2 4] [--repeat 3] [--keep FOLDER]

The archive is made from scratch, from a fixed seed: plates with 8 to 400 rounded openings, a third of them with a corner too tight.
"""

from __future__ import annotations

import argparse
import math
import os
import platform
import random
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from wedm_client import check_many

QUARTER = math.tan(math.pi / 8)


def opening(handle: int, x: float, y: float, radii: tuple[float, float, float, float]) -> list[str]:
    """A rectangle 6 × 4 with the four radii as an LWPOLYLINE."""
    tags = ["0", "LWPOLYLINE", "5", f"{handle:X}", "100", "AcDbEntity", "8", "DIE", "100", "AcDbPolyline", "90", "8", "70", "1"]
    # Each corner, the direction in which it is left, and that in which it is reached is the one before.
    corners = [(0.0, 0.0, 1.0, 0.0), (6.0, 0.0, 0.0, 1.0), (6.0, 4.0, -1.0, 0.0), (0.0, 4.0, 0.0, -1.0)]
    for (cx, cy, dx, dy), radius in zip(corners, radii, strict=True):
        # The contour turns left: it comes in the direction (dy, -dx).
        tags += ["10", repr(x + cx - dy * radius), "20", repr(y + cy + dx * radius), "42", repr(QUARTER)]
        tags += ["10", repr(x + cx + dx * radius), "20", repr(y + cy + dy * radius)]
    return tags


def drawing(random_numbers: random.Random) -> str:
    count = int(8 * 50 ** random_numbers.random())
    columns = math.ceil(math.sqrt(count))
    tags = ["0", "SECTION", "2", "HEADER", "9", "$ACADVER", "1", "AC1015", "9", "$INSUNITS", "70", "4", "0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"]
    tight = random_numbers.randrange(count) if random_numbers.random() < 1 / 3 else -1
    for number in range(count):
        radii = [random_numbers.uniform(0.2, 1.5) for _ in range(4)]
        if number == tight:
            radii[random_numbers.randrange(4)] = 0.06
        tags += opening(0x2A + number, 10.0 * (number % columns), 8.0 * (number // columns), (radii[0], radii[1], radii[2], radii[3]))
    return "\n".join([*tags, "0", "ENDSEC", "0", "EOF", ""])


def make_archive(folder: Path, files: int) -> None:
    random_numbers = random.Random(1)
    for number in range(files):
        path = folder / f"customer {number % 20:02}" / f"plate {number:04}.dxf"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(drawing(random_numbers))


@contextmanager
def threads(workers: int) -> Iterator[Executor]:
    with ThreadPoolExecutor(workers) as executor:
        yield executor


@contextmanager
def processes(workers: int) -> Iterator[Executor]:
    with ProcessPoolExecutor(workers) as executor:
        yield executor


@contextmanager
def dask(workers: int) -> Iterator[Executor]:
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client.get_executor()


KINDS = {"threads": threads, "processes": processes, "Dask LocalCluster": dask}


def main() -> None:
    arguments = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    arguments.add_argument("--files", type=int, default=1000)
    arguments.add_argument("--workers", type=int, nargs="+", default=[1, 2, 4])
    arguments.add_argument("--repeat", type=int, default=3, help="of each measurement; the best counts")
    arguments.add_argument("--keep", type=Path, help="where the archive is made; otherwise it is removed again")
    asked = arguments.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder: Path = asked.keep or Path(temporary)
        make_archive(folder, asked.files)
        size = sum(path.stat().st_size for path in folder.rglob("*.dxf"))
        expected: int | None = None
        rows: dict[int, list[float]] = {workers: [] for workers in asked.workers}
        for measured in KINDS.values():
            for workers in asked.workers:
                best = math.inf
                with measured(workers) as executor:
                    # Workers are started and the files are in memory before the clock runs.
                    check_many(sorted(folder.rglob("*.dxf"))[: 8 * workers], executor, chunk=1)
                    for _ in range(asked.repeat):
                        started = time.perf_counter()
                        checked = check_many(folder, executor)
                        best = min(best, time.perf_counter() - started)
                        bad = sum(not file.ok for file in checked)
                        unread = [file for file in checked if file.error is not None]
                        if unread:
                            raise SystemExit(f"{unread[0].path}: {unread[0].error}")
                        if bad != (expected := bad if expected is None else expected):
                            raise SystemExit(f"{bad} drawings with errors, expected {expected}")
                rows[workers].append(asked.files / best)
    print(f"{asked.files} drawings, {size / 1e6:.0f} MB, {expected} of them with errors; {os.cpu_count()} cores, {platform.system()},", end=" ")
    print(f"Python {platform.python_version()}; files/s, best of {asked.repeat}:\n")
    print("| workers | " + " | ".join(KINDS) + " |")
    print("|---" * (len(KINDS) + 1) + "|")
    for workers, rates in rows.items():
        print(f"| {workers} | " + " | ".join(f"{rate:.0f}" for rate in rates) + " |")


if __name__ == "__main__":
    main()

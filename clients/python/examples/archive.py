"""Checks a whole archive, on all cores or on a Dask cluster, and lists the drawings that cannot be cut as they are.

python archive.py FOLDER [tcp://SCHEDULER:8786]
"""

from __future__ import annotations

import sys
import time

from wedm_client import check_many


def main() -> int:
    folder = sys.argv[1]
    executor = None
    if len(sys.argv) > 2:
        from distributed import Client

        executor = Client(sys.argv[2]).get_executor()
    started = time.perf_counter()
    checked = check_many(folder, executor, progress=lambda done, total: print(f"\r{done} of {total}", end="", file=sys.stderr))
    took = time.perf_counter() - started
    print(file=sys.stderr)
    for file in checked:
        if not file.ok:
            print(f"{file.path}: {file.error or f'{len(file.errors)} errors, the first: {file.errors[0]}'}")
    bad = sum(not file.ok for file in checked)
    print(f"{len(checked)} files, {bad} of them with errors, {len(checked) / took:.0f} files/s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

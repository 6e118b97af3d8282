"""Archives: the same findings whoever does the work."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import pytest

from wedm_client import Checked, Server, check_many

from .test_bad_days import nowhere as nowhere


@pytest.fixture
def archive(tmp_path: Path, data: Path) -> Path:
    """Two folders of drawings, and the other files that archives contain."""
    tight, clean = (data / "tight.dxf").read_bytes(), (data / "clean.dxf").read_bytes()
    for number in range(30):
        path = tmp_path / f"customer {number % 2}" / f"plate {number:02}.dxf"
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(tight if number % 3 == 0 else clean)
    (tmp_path / "garbage.DXF").write_bytes((data / "garbage.dxf").read_bytes())
    (tmp_path / "customer 1" / "hole.3b").write_bytes((data / "hole.3b").read_bytes())
    (tmp_path / "notes.txt").write_text("not a drawing")
    return tmp_path


@contextmanager
def threads() -> Iterator[Executor]:
    with ThreadPoolExecutor(3) as executor:
        yield executor


@contextmanager
def processes() -> Iterator[Executor]:
    with ProcessPoolExecutor(2) as executor:
        yield executor


@contextmanager
def dask() -> Iterator[Executor]:
    from distributed import Client, LocalCluster

    # The scheduler and two worker processes, as on the machines of a company.
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client.get_executor()


@contextmanager
def nothing() -> Iterator[None]:
    yield None


@pytest.mark.parametrize("workers", [nothing, threads, processes, dask])
def test_all_executors_find_the_same(archive: Path, workers: Callable[[], object]) -> None:
    seen: list[tuple[int, int]] = []
    with workers() as executor:  # type: ignore[attr-defined]
        checked = check_many(archive, executor, chunk=4, progress=lambda done, total: seen.append((done, total)))
    assert [Path(one.path).name for one in checked[:2]] == ["plate 00.dxf", "plate 02.dxf"]
    assert len(checked) == 32 and all(one.error is None for one in checked)
    assert sorted(Path(one.path).name for one in checked if not one.ok) == sorted(
        [f"plate {number:02}.dxf" for number in range(0, 30, 3)] + ["garbage.DXF"]
    )
    assert len(seen) == 8 and seen[-1] == (32, 32)


def test_the_same_as_a_server_says(data: Path) -> None:
    paths = sorted(data.glob("*.dxf"))
    with Server() as server:
        said = [sorted(str(one) for one in server.diagnostics(server.open(path))) for path in paths]
    assert [sorted(str(one) for one in checked.diagnostics) for checked in check_many(paths)] == said


def test_settings_reach_the_workers(data: Path, tmp_path: Path) -> None:
    def radii(checked: list[Checked]) -> list[str]:
        return [one.rule for file in checked for one in file.diagnostics if one.severity == "error"]

    tight = data / "tight.dxf"
    config = tmp_path / "own.toml"
    config.write_text("correction = 0.05\n")
    assert radii(check_many(tight)) == ["small-radius"]
    assert radii(check_many(tight, config=config)) == []
    assert radii(check_many(tight, config=config, correction=0.2)) == ["small-radius"]
    assert radii(check_many(tight, side="punch")) == []


def test_what_cannot_be_read_is_named_and_costs_nothing_else(archive: Path) -> None:
    paths = [archive / "customer 0/plate 00.dxf", archive / "no such.dxf", archive / "notes.txt", archive / "customer 0/plate 02.dxf"]
    checked = check_many(paths)
    assert [Path(one.path) for one in checked] == paths
    assert [one.ok for one in checked] == [False, False, False, True]
    assert checked[1].error == "no such file or directory"
    assert len(checked[0].diagnostics) == 1 and checked[3].diagnostics == []


def test_a_worker_without_the_program_says_so(archive: Path, nowhere: Path) -> None:
    with ThreadPoolExecutor(1) as executor:
        checked = check_many([archive / "garbage.DXF"], executor)
    assert checked[0].error is not None and "no program wedm" in checked[0].error


def test_one_file_that_hangs_costs_itself(archive: Path, program: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    """A wrapper of the program that hangs on one file, as a broken network folder does."""
    wrapper = tmp_path_factory.mktemp("wrapper") / "wedm"
    wrapper.write_text(f'#!/bin/sh\ncase "$*" in *"plate 04"*) exec sleep 60;; esac\nexec "{program}" "$@"\n')
    wrapper.chmod(0o755)
    checked = check_many(archive / "customer 0", command=wrapper, chunk=3, timeout=1)
    (hung,) = [one for one in checked if one.error is not None]
    assert hung.path.endswith("plate 04.dxf") and hung.error is not None and "timed out" in hung.error
    assert len(checked) == 15


def _die(*_: object) -> None:
    os._exit(9)


def test_lost_workers_are_told_of(archive: Path) -> None:
    with ProcessPoolExecutor(1) as executor:
        executor.submit(_die)
        checked = check_many([archive / "garbage.DXF"], executor)
    assert checked[0].error is not None and "the worker was lost" in checked[0].error


@pytest.mark.parametrize("chunk", [0, -1])
def test_chunks_have_files(chunk: int) -> None:
    with pytest.raises(ValueError, match="expected 1 or more"):
        check_many([], chunk=chunk)

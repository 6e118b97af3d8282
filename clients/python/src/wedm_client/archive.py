"""Whole archives: files checked by as many workers as an executor has, here or on a cluster.

A worker runs ``wedm check`` over a handful of files at a time. That keeps nothing alive between them: a worker may be a thread, a
process or another machine, and one that dies loses only its own handful. How many run at once is up to the executor,
so each ``wedm`` uses one thread.
"""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .documents import WireFormat
from .errors import NoAnswer, WedmError
from .find import find
from .findings import Diagnostic, Findings
from .settings import Side
from .shown import Rows, Value

#: Files that one call of ``wedm check`` looks at: few enough to share the work out, many enough to make the start cheap.
CHUNK = 16

_SUFFIXES = frozenset({".dxf", ".dxb", ".3b", ".4b", ".iso", ".nc"})


@dataclass(frozen=True)
class Checked(Value):
    """What was found in one file; ``error`` says why it could not be checked."""

    path: str
    diagnostics: Findings = field(default_factory=Findings)
    error: str | None = None

    @property
    def errors(self) -> list[Diagnostic]:
        """The errors, which spoil the part: no program is made while there is one."""
        return self.diagnostics.errors

    @property
    def warnings(self) -> list[Diagnostic]:
        """The warnings, to be looked at before the part is cut."""
        return self.diagnostics.warnings

    def row(self) -> dict[str, Any]:
        """The row of a table for it."""
        first = self.error or (str((self.errors or self.diagnostics)[0]) if self.diagnostics else None)
        return {"file": self.path, "ok": self.ok, "errors": len(self.errors), "warnings": len(self.warnings), "first": first}

    def _repr_html_(self) -> str | None:
        return self.diagnostics._repr_html_() if self.error is None else None

    def __repr__(self) -> str:
        said = self.error or f"{len(self.errors)} errors, {len(self.warnings)} warnings, {len(self.diagnostics)} findings"
        return f"<Checked {self.path}: {said}>"

    @property
    def ok(self) -> bool:
        """The file was read, and holds no error."""
        return self.error is None and not self.errors


def check_many(
    paths: Iterable[str | os.PathLike[str]] | str | os.PathLike[str],
    executor: Executor | None = None,
    *,
    correction: float | None = None,
    side: Side | None = None,
    config: str | os.PathLike[str] | None = None,
    command: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None,
    chunk: int = CHUNK,
    timeout: float = 60.0,
    progress: Callable[[int, int], None] | None = None,
) -> Rows[Checked]:
    """Checks many files and returns what was found, in their order; a notebook shows it as a table.

    :param paths: files and folders; of a folder all drawings and programs below it.
    :param executor: any executor of :mod:`concurrent.futures`: processes, or a Dask or Ray cluster. Without one, a thread for
        each core. Workers on other machines must see the files under the same paths.
    :param correction: mm; overrides all other settings.
    :param side: where the wire runs; overrides all other settings.
    :param config: a settings file, which overrides the ``wedm.toml`` above each file.
    :param command: the program; without it each worker looks for it by itself, as :func:`wedm_client.find` does.
    :param chunk: how many files a worker takes at a time.
    :param timeout: seconds for one file; a handful has that for each of its files.
    :param progress: called with the number of files done and of all files, on the calling thread.
    :raises ServerNotFound: there is no program (without ``executor``; a worker of an executor says so in ``Checked.error``).
    """
    if chunk < 1:
        raise ValueError(f"chunk is {chunk}, expected 1 or more")
    options = _options(correction, side, config)
    named = list(_files(paths))
    program = None if command is None and executor is not None else find(command)
    chunks = [named[start : start + chunk] for start in range(0, len(named), chunk)]
    if executor is not None:
        return _gather(executor, chunks, program, options, timeout, progress)
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1, thread_name_prefix="wedm-check") as threads:
        return _gather(threads, chunks, program, options, timeout, progress)


def report(
    paths: Iterable[str | os.PathLike[str]] | str | os.PathLike[str],
    folder: str | os.PathLike[str] = "report",
    *,
    format: WireFormat = "3b",
    correction: float | None = None,
    side: Side | None = None,
    config: str | os.PathLike[str] | None = None,
    command: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None,
    timeout: float = 600.0,
) -> Path:
    """Writes a page for each drawing, and an index of them, whose path it returns: picture, contours, radius list, findings, program.

    A drawing with errors has its page too.

    :param paths: drawings, and folders of them.
    :param folder: where the pages are written; made where it is not there.
    :param format: the language of the programs.
    :param timeout: seconds for all of them.
    :raises WedmError: the pages could not be written; the message says why.
    """
    named = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    words = [*find(command), "report", "--output", os.fspath(folder), "--format", format, *_options(correction, side, config), "--"]
    try:
        ended = subprocess.run([*words, *(os.fspath(path) for path in named)], capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        raise NoAnswer(f"wedm report did not end within {timeout:g} s") from None
    if ended.returncode not in (0, 1):
        said = ended.stderr.decode("utf-8", "replace").strip()
        raise WedmError(f"wedm report ended with code {ended.returncode}: {said or 'it said nothing'}")
    return Path(folder, "index.html")


def _options(correction: float | None, side: Side | None, config: str | os.PathLike[str] | None) -> list[str]:
    options = ["--correction", repr(float(correction))] if correction is not None else []
    options += ["--side", side] if side is not None else []
    return options + (["--config", os.fspath(Path(config).resolve())] if config is not None else [])


def _files(paths: Iterable[str | os.PathLike[str]] | str | os.PathLike[str]) -> Iterator[str]:
    for path in [paths] if isinstance(paths, (str, os.PathLike)) else paths:
        resolved = Path(path).resolve()
        if resolved.is_dir():
            found = (below for below in resolved.rglob("*") if below.suffix.lower() in _SUFFIXES and below.is_file())
            yield from sorted(str(below) for below in found)
        else:
            yield str(resolved)


def _gather(
    executor: Executor,
    chunks: list[list[str]],
    program: list[str] | None,
    options: list[str],
    timeout: float,
    progress: Callable[[int, int], None] | None,
) -> Rows[Checked]:
    futures: list[Future[list[Checked]]] = [executor.submit(check_chunk, chunk, program, options, timeout) for chunk in chunks]
    if progress is not None:
        sizes = {id(future): len(chunk) for future, chunk in zip(futures, chunks, strict=True)}
        done, total = 0, sum(sizes.values())
        for future in as_completed(futures):
            done += sizes[id(future)]
            progress(done, total)
    checked: Rows[Checked] = Rows()
    for future, chunk in zip(futures, chunks, strict=True):
        try:
            checked.extend(future.result())
        except Exception as error:  # A worker that was lost, in whatever way this executor says it.
            checked.extend(Checked(path, error=f"the worker was lost: {type(error).__name__}: {error}") for path in chunk)
    return checked


def check_chunk(paths: list[str], program: list[str] | None, options: list[str], timeout: float) -> list[Checked]:
    """What a worker does: checks a handful of files, one by one where the handful as a whole cannot be checked."""
    try:
        command = program or find()
    except WedmError as error:
        return [Checked(path, error=str(error)) for path in paths]
    try:
        return _run(command, paths, options, timeout * len(paths))
    except (OSError, ValueError, subprocess.SubprocessError) as error:
        if len(paths) == 1:
            return [Checked(paths[0], error=str(error))]
    return [checked for path in paths for checked in check_chunk([path], command, options, timeout)]


def _run(command: list[str], paths: list[str], options: list[str], timeout: float) -> list[Checked]:
    words = [*command, "check", "--output", "json", *options, "--", *paths]
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
    ended = subprocess.run(words, capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout, env=environment, check=False)
    said = ended.stderr.decode("utf-8", "replace").strip()
    if ended.returncode not in (0, 1, 2) or not ended.stdout:
        raise ValueError(f"wedm check ended with code {ended.returncode}: {said or 'it said nothing'}")
    found = {path: Findings() for path in paths}
    for written in json.loads(ended.stdout)["diagnostics"]:
        found[written["path"]].append(_diagnostic(written))
    if ended.returncode != 2:
        return [Checked(path, diagnostics) for path, diagnostics in found.items()]
    # Some of them could not be read: its own words say which.
    reasons = {path: line for line in said.splitlines() for path in paths if f" {path}: " in f" {line}"}
    return [Checked(path, found[path], _reason(reasons.get(path), path)) for path in paths]


def _reason(line: str | None, path: str) -> str | None:
    return line.split(f"{path}: ", 1)[1] if line is not None else None


def _diagnostic(written: Mapping[str, Any]) -> Diagnostic:
    return Diagnostic(
        rule=written["rule"],
        severity=written["severity"],
        message=written["message"],
        line=written["line"],
        column=written["column"],
        end_line=written["endLine"],
        end_column=written["endColumn"],
        data=written["data"] or {},
    )

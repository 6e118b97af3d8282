"""Gap and corrections from what was measured on a cut test piece."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from .errors import NoAnswer, WedmError
from .find import find
from .shown import Value


@dataclass(frozen=True)
class Kerf(Value):
    """What one pass has cut, mm: half of its kerf, with the half of its 95 % confidence interval."""

    pass_: int
    #: With which the piece was cut.
    correction: float
    half_kerf: float
    uncertainty: float
    #: Measured features.
    features: int
    #: Where the wire is known.
    gap: float | None = None
    #: Half of the kerf by the outer and by the inner features alone.
    outer: float | None = None
    inner: float | None = None


@dataclass(frozen=True)
class Calibration(Value):
    """The kerf of each pass that was measured, and the keys of ``wedm.toml`` that follow, as ``gap`` or ``passes.corrections``."""

    passes: list[Kerf]
    settings: dict[str, float | list[float]]


def calibrate(
    table: str | os.PathLike[str] | None = None,
    *,
    outer: Iterable[tuple[float, float]] = (),
    inner: Iterable[tuple[float, float]] = (),
    pass_: int | None = None,
    correction: float | None = None,
    passes: Sequence[float] | None = None,
    wire_diameter: float | None = None,
    uncertainty: float | None = None,
    config: str | os.PathLike[str] | None = None,
    write: bool = False,
    command: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None,
    timeout: float = 60.0,
) -> Calibration:
    """Works out gap and corrections from the sizes of a test piece, as ``wedm calibrate`` does.

    :param table: a CSV file with the columns ``kind``, ``nominal``, ``measured`` and, where wanted, ``feature`` and ``pass``.
    :param outer: nominal and measured sizes over material, mm, as of a punch.
    :param inner: the same of openings.
    :param pass_: after which pass these were measured, from 1; the last without it.
    :param correction: with which the piece was cut, mm; else ``passes`` or the nearest ``wedm.toml`` says it.
    :param passes: the correction of each pass, mm.
    :param uncertainty: of a single measurement, mm: 95 of 100 are nearer to the truth.
    :param config: the settings file, in place of the nearest ``wedm.toml``.
    :param write: sets the values in that file, with the date.
    :raises WedmError: the sizes contradict each other, or something is missing; the message says what.
    """
    words = [*find(command), "calibrate", "--output", "json"]
    for option, sizes in (("--outer", outer), ("--inner", inner)):
        for nominal, measured in sizes:
            words += [option, f"{nominal!r}={measured!r}"]
    values = {"--pass": pass_, "--correction": correction, "--wire-diameter": wire_diameter, "--uncertainty": uncertainty}
    for option, value in values.items():
        words += [option, repr(value)] if value is not None else []
    words += ["--passes", ",".join(map(repr, passes))] if passes is not None else []
    words += ["--config", os.fspath(config)] if config is not None else []
    words += ["--write"] if write else []
    words += ["--", os.fspath(table)] if table is not None else []
    try:
        ended = subprocess.run(words, capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        raise NoAnswer(f"wedm calibrate did not end within {timeout:g} s") from None
    if ended.returncode != 0:
        raise WedmError(ended.stderr.decode("utf-8", "replace").strip() or f"wedm calibrate ended with code {ended.returncode}")
    answer = json.loads(ended.stdout)
    names = {"pass": "pass_", "halfKerf": "half_kerf"}
    return Calibration([Kerf(**{names.get(key, key): value for key, value in kerf.items()}) for kerf in answer["passes"]], answer["settings"])

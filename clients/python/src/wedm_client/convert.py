"""Programs as drawings or in another language, by ``wedm convert``: the protocol has no request for it."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlparse
from urllib.request import url2pathname

from .connection import REQUEST_FAILED
from .documents import LANGUAGES, TextDocument
from .errors import NoAnswer, Refused
from .settings import Settings

# Exit codes of `wedm`: the program has errors; wrong usage, or a file that cannot be read.
_UNDERSTOOD = (1, 2)


def converted(
    command: Sequence[str],
    program: TextDocument,
    settings_file: str | None,
    to: str,
    options: Settings,
    force: bool,
    timeout: float,
) -> str:
    """The text of what the program becomes.

    :param settings_file: URI of the ``wedm.toml`` that holds for the document.
    :raises Refused: it cannot be converted.
    """
    words = [*_flags(options), *(["--force"] if force else [])]
    if settings_file is not None:
        words += ["--config", url2pathname(unquote(urlparse(settings_file).path))]
    suffixes = [suffix for suffix, language in LANGUAGES.items() if language == program.language]
    with tempfile.TemporaryDirectory(prefix="wedm-client-") as folder:
        source, target = Path(folder, f"program{suffixes[0]}"), Path(folder, f"converted.{to}")
        source.write_bytes(program._told().encode("utf-8"))
        try:
            ended = subprocess.run(
                [command[0], "convert", *words, "-o", str(target), "--", str(source)],
                capture_output=True,
                stdin=subprocess.DEVNULL,
                timeout=timeout,
                env={**os.environ, "NO_COLOR": "1"},
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise NoAnswer(f"wedm convert did not end within {timeout:g} s") from None
        if ended.returncode != 0 or not target.exists():
            said = ended.stderr.decode("utf-8", "replace").replace(f"{folder}{os.sep}", "").strip()
            code = "" if ended.returncode in _UNDERSTOOD else f"wedm convert ended with code {ended.returncode}: "
            raise Refused(code + said, REQUEST_FAILED, None, [])
        return target.read_bytes().decode("utf-8")


def _flags(options: Settings) -> list[str]:
    """The options as the command line takes them.

    :raises ValueError: it has no option for one of them.
    """
    told: dict[str, Any] = dict(options)
    program: Mapping[str, Any] = told.pop("program", {})
    taken: dict[str, Any] = {key: told.pop(key) for key in ("correction", "side") if key in told}
    for key in ("direction", "corner", "layout", "compensation", "digits", "profile", "end", "pause", "lead_in", "order", "thread", "entry"):
        if key in program:
            taken[key] = program[key]
    left = [*told, *(f"program.{key}" for key in program if key not in taken)]
    left += [f"program.{key} by handle" for key in ("thread", "entry") if isinstance(taken.get(key), Mapping)]
    if left:
        raise ValueError(f"{', '.join(left)}: expected what `wedm convert` has an option for; a wedm.toml takes all of them")
    return [f"--{key.replace('_', '-')}={_written(value)}" for key, value in taken.items()]


def _written(value: Any) -> str:
    if isinstance(value, (str, int, float)):
        return str(value)
    return ",".join(repr(float(number)) for number in value)

"""Where the program ``wedm`` is: named by the caller, by the environment, beside this Python, on the PATH, or where cargo puts it."""

from __future__ import annotations

import os
import shutil
import sys
import sysconfig
from collections.abc import Sequence
from pathlib import Path

from .errors import ServerNotFound

#: The environment variable that names the program.
VARIABLE = "WEDM"

HOW_TO_GET_IT = (
    "build it in a checkout of wedm with `cargo install --path .` (Rust 1.90 or later), "
    f"or say where it is: Server(command=...) or the environment variable {VARIABLE}"
)


def find(command: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None) -> list[str]:
    """The command that starts the server.

    ``command`` is a path, the name of a program on the PATH, or a program with its arguments. Without it the environment
    variable ``WEDM`` names it; else it is looked for in the folder of this Python's programs, on the PATH, and in ``~/.cargo/bin``,
    which is often not on the PATH of notebooks and services.

    :raises ServerNotFound: there is none; the message says where it was looked for and how to get it.
    """
    if command is not None:
        words = [os.fspath(command)] if isinstance(command, (str, os.PathLike)) else [os.fspath(word) for word in command]
        if not words:
            raise ServerNotFound(f"the command is empty; {HOW_TO_GET_IT}")
        return [_program(words[0], "the command"), *words[1:]]
    named = os.environ.get(VARIABLE)
    if named:
        return [_program(named, f"the environment variable {VARIABLE}")]
    name = "wedm.exe" if sys.platform == "win32" else "wedm"
    beside = [Path(sysconfig.get_path("scripts")) / name, Path(sys.executable).parent / name]
    for candidate in beside:
        if os.access(candidate, os.X_OK) and candidate.is_file():
            return [str(candidate)]
    on_path = _on_path("wedm")
    if on_path is not None:
        return [on_path]
    installed = Path.home() / ".cargo/bin" / name
    if os.access(installed, os.X_OK) and installed.is_file():
        return [str(installed)]
    folders = ", ".join(dict.fromkeys(str(candidate.parent) for candidate in beside))
    raise ServerNotFound(f"no program wedm in {folders}, on the PATH or in {installed.parent}; {HOW_TO_GET_IT}")


def _program(named: str, by: str) -> str:
    is_bare = not os.path.dirname(named)
    found = _on_path(named) if is_bare else shutil.which(os.path.expanduser(named))
    if found is None:
        raise ServerNotFound(f"{by} names {named}, and there is no program there; {HOW_TO_GET_IT}")
    return found


def _on_path(name: str) -> str | None:
    """A program in a folder of the PATH. A relative one depends on the current folder: it is skipped."""
    folders = [folder for folder in os.environ.get("PATH", "").split(os.pathsep) if os.path.isabs(folder)]
    return next((found for folder in folders if (found := shutil.which(os.path.join(folder, name))) is not None), None)

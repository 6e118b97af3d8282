"""What a step leaves, and why a case falls short."""

import os


class Short(Exception):
    """Why a case falls short."""


class Skip(Exception):
    """Why a case cannot be run here."""


def environment():
    return {**os.environ, "LC_ALL": "C.UTF-8", "LANG": "C.UTF-8", "NO_COLOR": "1", "WEDM_LOG": "error"}


class Result:
    code, out, err, cpu, memory, got, argv = 0, "", "", 0.0, 0.0, None, ()

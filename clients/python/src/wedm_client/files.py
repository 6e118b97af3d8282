"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path


def write_beside(path: Path, content: bytes) -> None:
    """Writes the content to a new file beside ``path`` and renames it: nobody ever reads half a file.

    Owner and rights of a file that stands there are kept, and a link stays a link.

    :raises OSError: it cannot be written, or not with that owner; nothing is changed then.
    """
    path = path.resolve()
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as beside:
            beside.write(content)
            beside.flush()
            os.fsync(beside.fileno())
        # A new file of `mkstemp` is for its owner only; take what the old one has, or the rights of any new file.
        old, own = path.stat() if path.exists() else None, os.stat(name)
        if old is not None and hasattr(os, "chown") and (old.st_uid, old.st_gid) != (own.st_uid, own.st_gid):
            os.chown(name, old.st_uid, old.st_gid)
        os.chmod(name, 0o666 & ~_umask() if old is None else old.st_mode & 0o7777)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def _umask() -> int:
    now = os.umask(0)
    os.umask(now)
    return now

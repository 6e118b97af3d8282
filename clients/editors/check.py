#!/usr/bin/env python3
"""Runs a session in each editor named and says what was seen; prints one line of counts at the end.

Each editor opens a drawing with one fault, shows it, applies the fix that the server offers, and saves. Nothing is taken from the
editor's word alone: the file that it wrote is compared with the one it was given, and checked by `wedm check`.
"""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path

from sessions import emacs, helix, kate, neovim
from sessions.place import Failed, Place

TOOLS = Path(__file__).resolve().parent / ".tools"


def tool(name: str) -> str | None:
    """A program that `test` has put into .tools, else one on the PATH."""
    own = {"nvim-0.11": TOOLS / "neovim/bin/nvim", "hx": TOOLS / "helix/hx"}.get(name)
    if own is not None:
        return str(own) if own.exists() else None
    return shutil.which(name)


def checks() -> list[tuple[str, str, Callable[[str], None]]]:
    """What is checked: a name, the program that it needs, and the session."""
    return [
        ("Neovim 0.7, require('wedm'): repair, death of the server", "nvim", lambda program: neovim.repair(program, False, "neovim-0.7")),
        ("Neovim 0.7, require('wedm'): the server by its path", "nvim", neovim.by_path),
        ("Neovim 0.7, require('wedm'): no server", "nvim", lambda program: neovim.without_server(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: repair, death of the server", "nvim-0.11", lambda program: neovim.repair(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): the server where cargo installs it", "nvim", lambda program: neovim.installed(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: the server where cargo installs it", "nvim-0.11", lambda program: neovim.installed(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server that dies at every start", "nvim", lambda program: neovim.that_dies(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server that dies at every start", "nvim-0.11", lambda program: neovim.that_dies(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server of another version", "nvim", lambda program: neovim.of_another_version(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server of another version", "nvim-0.11", lambda program: neovim.of_another_version(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server that does not answer", "nvim", lambda program: neovim.that_is_silent(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server that does not answer", "nvim-0.11", lambda program: neovim.that_is_silent(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server that writes what is no message", "nvim", lambda program: neovim.that_babbles(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server that writes what is no message", "nvim-0.11", lambda program: neovim.that_babbles(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server that the user stops", "nvim", lambda program: neovim.that_is_stopped(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server that the user stops", "nvim-0.11", lambda program: neovim.that_is_stopped(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): the pauses between two starts", "nvim", neovim.pauses),
        ("Neovim 0.7, require('wedm'): as a package", "nvim", lambda program: neovim.package(program, False, "neovim-0.7")),
        ("Neovim 0.11, require('wedm'): as a package", "nvim-0.11", lambda program: neovim.package(program, False, "neovim-0.11-setup")),
        ("Neovim 0.11, vim.lsp.config: as a package", "nvim-0.11", lambda program: neovim.package(program, True, "neovim-0.11")),
        ("Neovim 0.11, vim.lsp.config: no server", "nvim-0.11", lambda program: neovim.without_server(program, True, "neovim-0.11")),
        ("Emacs, eglot: repair, death of the server", "emacs", lambda program: emacs.repair(program, "emacs")),
        ("Emacs, eglot: the server where cargo installs it", "emacs", emacs.installed),
        ("Emacs, eglot: no server", "emacs", emacs.without_server),
        ("Helix: repair, death of the server", "hx", lambda program: helix.repair(program, "helix")),
        ("Helix: no server", "hx", helix.without_server),
        ("Kate: repair, death of the server", "kate", lambda program: kate.repair(program, "kate")),
    ]


def main() -> int:
    wanted = sys.argv[1:]
    passed = failed = skipped = 0
    for name, program, session in checks():
        if wanted and not any(word.lower() in name.lower() for word in wanted):
            continue
        found = tool(program)
        if found is None:
            print(f"!! {name}: {program} is not there")
            if os.environ.get("CI") == "true":
                failed += 1
            else:
                skipped += 1
            continue
        started = time.monotonic()
        Place.made.clear()
        try:
            session(found)
        except Failed as reason:
            failed += 1
            print(f"FAILED {name}: {reason}\nkept: {', '.join(str(place.folder) for place in Place.made)}", flush=True)
        else:
            passed += 1
            for place in Place.made:
                shutil.rmtree(place.folder, ignore_errors=True)
            print(f"ok {name} ({time.monotonic() - started:.1f} s)", flush=True)
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

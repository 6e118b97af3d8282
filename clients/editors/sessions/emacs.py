"""Sessions in Emacs, with eglot."""

from __future__ import annotations

from .place import EDITORS, FAULT, OFFERED, Failed, Place, saw


def repair(program: str, editor: str) -> None:
    place = Place(editor)
    seen = place.folder / "seen.txt"
    # A terminal of its own: as a batch Emacs has no command loop, and does not hear of the server's death.
    words = ["script", "-qec", f"stty rows 40 cols 120; {program} -nw -q -l {EDITORS}/emacs/session.el", "/dev/null"]
    try:
        place.run(words, WEDM_CONFIGURATION=str(EDITORS / "emacs"), WEDM_SEEN=str(seen), TERM="xterm")
    except Failed as failed:
        raise Failed(f"{seen.read_text() if seen.exists() else ''}{failed}") from None
    said = seen.read_text()
    place.log(f"{editor}.txt", said)
    saw(said, FAULT, "mode: dxf-mode", f"offered: {OFFERED}", "fixed and written", "the server was killed and started again: 1 fault")
    place.check_drawing()


def installed(program: str) -> None:
    """The server is where cargo puts it, and that is not on the PATH."""
    place = Place("emacs-installed")
    place.move_to_where_cargo_installs()
    show = "(princ (wedm--contact))"
    said = place.run([program, "--batch", "-q", "-l", "package", "-f", "package-initialize", "-l", f"{EDITORS}/emacs/wedm.el", "--eval", show], PATH=place.path_without_server())
    saw(said, f"{place.folder}/home/.cargo/bin/wedm")


def without_server(program: str) -> None:
    place = Place("emacs-without")
    (place.folder / "programs/wedm").unlink()
    # Batch: nothing has to come from a server.
    show = '(progn (find-file (getenv "WEDM_DRAWING")) (princ (format "%s" major-mode)))'
    said = place.run([program, "--batch", "-q", "-l", "package", "-f", "package-initialize", "-l", f"{EDITORS}/emacs/wedm.el", "--eval", show], PATH=place.path_without_server())
    saw(said, "cargo install --path .", "dxf-mode")

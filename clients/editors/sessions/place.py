"""A folder in which an editor runs for one session, and what is expected of what was seen there."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

#: The folder of the editors' configurations.
EDITORS = Path(__file__).resolve().parents[1]
ROOT = EDITORS.parents[1]
WEDM = os.environ.get("WEDM", str(ROOT / "target/release/wedm"))
DRAWING = ROOT / "tests/data/tight_fillet.dxf"
ARTIFACTS = ROOT / "target/artifacts/editors"
#: Folder in which the messages between editor and server are recorded; empty for none.
RECORD = os.environ.get("WEDM_RECORD_SESSIONS")

FAULT = "arc R 0.050 mm is below the correction 0.100 mm"
OFFERED = "Replace the arc by one of R 0.101 mm"


class Failed(Exception):
    """What was expected and not seen."""


def expect(holds: bool, what: str) -> None:
    if not holds:
        raise Failed(what)


class Place:
    """A folder with a drawing, a home, and a PATH on which `wedm` stands."""

    #: The places of the current session: removed after it, kept where it fails.
    made: list[Place] = []

    def __init__(self, editor: str) -> None:
        self.made.append(self)
        self.folder = Path(tempfile.mkdtemp(prefix=f"wedm-{editor}-"))
        self.drawing = self.folder / "die.dxf"
        shutil.copy(DRAWING, self.drawing)
        (self.folder / "home/.config").mkdir(parents=True)
        programs = self.folder / "programs"
        programs.mkdir()
        server = programs / "wedm"
        if RECORD:
            target = Path(RECORD).resolve() / f"{editor}.jsonl"
            server.write_text(f'#!/bin/sh\nWEDM_RECORD="{target}" WEDM="{WEDM}" exec python3 "{ROOT}/tests/protocol/record.py" "$@"\n')
            server.chmod(0o755)
        else:
            server.symlink_to(WEDM)
        # No desktop, no settings of the one who runs the tests.
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("XDG_", "DBUS_", "WAYLAND_"))}
        self.environment = {
            **kept,
            "HOME": str(self.folder / "home"),
            "XDG_CONFIG_HOME": str(self.folder / "home/.config"),
            "XDG_DATA_HOME": str(self.folder / "home/.local/share"),
            "PATH": f"{programs}:{os.environ['PATH']}",
            "LANG": "C.UTF-8",
            "TERM": "xterm-256color",
            "WEDM_DRAWING": str(self.drawing),
        }

    def run(self, words: list[str], limit: float = 300, **environment: str) -> str:
        try:
            ended = subprocess.run(
                words, cwd=self.folder, env={**self.environment, **environment}, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired as late:
            raise Failed(f"{words[0]} did not end within {limit:g} s\n{(late.stdout or b'').decode(errors='replace')}") from None
        said = ended.stdout.decode(errors="replace").replace("\r", "")
        expect(ended.returncode == 0 and "\nFAIL" not in f"\n{said}", f"{words[0]} ended with {ended.returncode}:\n{said}")
        return said

    def move_to_where_cargo_installs(self) -> None:
        target = self.folder / "home/.cargo/bin/wedm"
        target.parent.mkdir(parents=True)
        (self.folder / "programs/wedm").rename(target)

    def path_without_server(self) -> str:
        return ":".join(path for path in self.environment["PATH"].split(":") if not os.path.exists(f"{path}/wedm"))

    def server(self) -> int:
        """The process of the server that this place's editor has started."""
        program = os.path.realpath(WEDM)
        for process in filter(str.isdigit, os.listdir("/proc")):
            try:
                environment = Path("/proc", process, "environ").read_bytes().split(b"\0")
                if os.readlink(f"/proc/{process}/exe") == program and f"WEDM_DRAWING={self.drawing}".encode() in environment:
                    return int(process)
            except OSError:
                continue
        raise Failed("there is no process of the server")

    def check_drawing(self) -> None:
        """Only numbers of the arc's two vertices have changed, and the drawing is clean."""
        old, new = DRAWING.read_bytes().split(b"\n"), self.drawing.read_bytes().split(b"\n")
        expect(len(old) == len(new), f"the file had {len(old)} lines and has {len(new)}")
        changed = [number for number, pair in enumerate(zip(old, new, strict=True), 1) if pair[0] != pair[1]]
        expect(bool(changed) and set(changed) <= set(range(37, 49)), f"lines {changed} differ")
        ended = subprocess.run([WEDM, "check", str(self.drawing)], capture_output=True, text=True, timeout=90, check=False)
        expect(ended.returncode == 0, f"the repaired drawing has errors:\n{ended.stdout}")

    def log(self, name: str, content: str) -> None:
        ARTIFACTS.mkdir(parents=True, exist_ok=True)
        (ARTIFACTS / name).write_text(content)


def saw(said: str, *expected: str) -> None:
    for line in expected:
        expect(line in said, f"no {line!r} in:\n{said[-4000:]}")

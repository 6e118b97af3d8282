"""A session in Kate, by its keys and by what it says to the server."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .place import ARTIFACTS, EDITORS, FAULT, OFFERED, RECORD, ROOT, WEDM, Failed, Place, expect


class Screen:
    """An X server of its own, with a window manager."""

    def __init__(self, place: Place) -> None:
        self._place = place
        self._started: list[subprocess.Popen[bytes]] = []
        read, write = os.pipe()
        words = ["Xvfb", "-noreset", "-displayfd", str(write), "-screen", "0", "1280x900x24", "-nolisten", "tcp"]
        self._started.append(subprocess.Popen(words, pass_fds=[write], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        os.close(write)
        # To the end of the line: a pipe that is closed before it ends the server.
        with open(read, encoding="ascii") as told:
            number = told.readline().strip()
        expect(bool(number), "Xvfb did not start")
        runtime = place.folder / "run"
        runtime.mkdir(mode=0o700, exist_ok=True)
        place.environment |= {"DISPLAY": f":{number}", "QT_QPA_PLATFORM": "xcb", "XDG_RUNTIME_DIR": str(runtime)}
        self.start("openbox")

    def start(self, *words: str) -> None:
        quiet: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self._started.append(subprocess.Popen(words, env=self._place.environment, cwd=self._place.folder, start_new_session=True, **quiet))

    def type(self, *keys: str) -> None:
        subprocess.run(["xdotool", "key", *keys], env=self._place.environment, timeout=90, check=False)
        time.sleep(0.4)

    def shot(self, name: str) -> None:
        ARTIFACTS.mkdir(parents=True, exist_ok=True)
        subprocess.run(["import", "-window", "root", str(ARTIFACTS / name)], env=self._place.environment, timeout=90, check=False)

    def close(self) -> None:
        for process in reversed(self._started):
            process.terminate()
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()


def repair(program: str, editor: str) -> None:
    place = Place(editor)
    configuration, data = place.folder / "home/.config", place.folder / "home/.local/share/org.kde.syntax-highlighting/syntax"
    (configuration / "kate/lspclient").mkdir(parents=True)
    shutil.copy(EDITORS / "kate/settings.json", configuration / "kate/lspclient")
    shutil.copytree(EDITORS / "kate/syntax", data)
    # As a user who has allowed this server to be started, and who wants no automatic changes.
    allowed = place.folder / "programs/wedm"
    (configuration / "katerc").write_text(
        "[General]\nShow welcome view for new window=false\n[Kate Plugins]\nlspclientplugin=true\n"
        f"[lspclient]\nAllowedServerCommandLines={allowed}\n[KTextEditor Document]\nRemove Spaces=0\nNewline at End of File=false\n"
    )
    # The messages are the only part of it that a program can read: the rest is in the pictures.
    said = Path(RECORD).resolve() / "kate.jsonl" if RECORD else place.folder / "kate.jsonl"
    allowed.unlink()
    allowed.write_text(f'#!/bin/sh\nWEDM_RECORD="{said}" WEDM="{WEDM}" exec python3 "{ROOT}/tests/protocol/record.py" "$@"\n')
    allowed.chmod(0o755)

    def wait(what: str, holds: Callable[[str], bool]) -> None:
        end = time.monotonic() + 90
        while not (said.exists() and holds(said.read_text())):
            if time.monotonic() > end:
                screen.shot("kate-failed.png")
                raise Failed(f"no {what} within 90 s; see {ARTIFACTS}/kate-failed.png")
            time.sleep(0.2)
        time.sleep(1.0)

    screen = Screen(place)
    try:
        screen.start("dbus-run-session", "--", program, "-b", "-n", "-l", "42", str(place.drawing))
        wait("diagnostic", lambda text: FAULT in text)
        screen.shot("kate-fault.png")
        screen.type("alt+Return")
        wait("code actions", lambda text: OFFERED in text)
        screen.shot("kate-actions.png")
        screen.type("Down")
        screen.type("Return")
        wait("repaired drawing", lambda text: text.count("publishDiagnostics") >= 2)
        screen.type("ctrl+s")
        wait("saved drawing", lambda text: "textDocument/didSave" in text)
        screen.shot("kate-fixed.png")
        place.check_drawing()
        screen.type("ctrl+z")
        wait("fault after undo", lambda text: text.rpartition("publishDiagnostics")[2].count(FAULT) > 0)
        before = said.read_text().count('"method":"initialize"')
        os.kill(place.server(), 9)
        time.sleep(0.5)
        # The next edit makes Kate start another one.
        screen.type("End", "1")
        wait("new server", lambda text: text.count('"method":"initialize"') > before)
        wait("fault from the new server", lambda text: FAULT in text.rpartition('"method":"initialize"')[2])
        screen.shot("kate-restarted.png")
    finally:
        screen.close()

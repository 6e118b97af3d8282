"""Sessions in Helix, by its keys and its screen."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from .place import EDITORS, FAULT, OFFERED, Failed, Place, saw


class Terminal:
    """A program in a terminal that keys are typed into and whose screen is read."""

    def __init__(self, place: Place, words: list[str]) -> None:
        self._socket = f"{place.folder}/tmux"
        self._place = place
        self._tmux("new-session", "-d", "-x", "140", "-y", "40", "--", *words)

    def _tmux(self, *words: str) -> str:
        command = ["tmux", "-S", self._socket, "-f", "/dev/null", *words]
        ended = subprocess.run(command, env=self._place.environment, cwd=self._place.folder, capture_output=True, text=True, timeout=90, check=False)
        return ended.stdout

    def type(self, *keys: str) -> None:
        self._tmux("send-keys", *keys)
        time.sleep(0.2)

    def screen(self) -> str:
        return self._tmux("capture-pane", "-p")

    def wait(self, what: str, holds: Callable[[str], bool], limit: float = 90) -> str:
        end = time.monotonic() + limit
        while time.monotonic() < end:
            screen = self.screen()
            if holds(screen):
                return screen
            time.sleep(0.1)
        raise Failed(f"no {what} within {limit:g} s; on the screen:\n{self.screen()}")

    def server(self) -> int | None:
        """The process of the server that runs on this terminal."""
        pane = self._tmux("display-message", "-p", "#{pane_pid}").strip()
        children = subprocess.run(["pgrep", "-P", pane], capture_output=True, text=True, check=False).stdout.split()
        return int(children[0]) if children else None

    def close(self) -> None:
        self._tmux("kill-server")


def repair(program: str, editor: str) -> None:
    place = Place(editor)
    configuration = place.folder / "home/.config/helix"
    configuration.mkdir()
    shutil.copy(EDITORS / "helix/languages.toml", configuration)
    # Messages stand beside the lines, so that they are on the screen.
    (configuration / "config.toml").write_text('[editor.inline-diagnostics]\ncursor-line = "hint"\n')
    runtime = Path(program).parent / "runtime"
    health = place.run([program, "--health", "dxf"], HELIX_RUNTIME=str(runtime))
    saw(health, "wedm")
    terminal = Terminal(place, ["env", f"HELIX_RUNTIME={runtime}", program, str(place.drawing)])
    try:
        terminal.wait("the file", lambda screen: "SECTION" in screen)
        # To the next finding, and what it is.
        end = time.monotonic() + 20
        while FAULT not in re.sub(r"\s+", " ", terminal.screen()) and time.monotonic() < end:
            terminal.type("]", "d")
        screen = terminal.wait("diagnostic", lambda screen: FAULT in re.sub(r"\s+", " ", screen))
        terminal.type("Space", "a")
        screen += terminal.wait("code actions", lambda screen: OFFERED in screen)
        # The first of the menu.
        terminal.type("Enter")
        terminal.type("Enter")
        terminal.type("Escape")
        screen += terminal.wait("repaired numbers", lambda screen: "19.899" in screen and FAULT not in re.sub(r"\s+", " ", screen))
        terminal.type(":", "w", "Enter")
        screen += terminal.wait("written file", lambda screen: "written" in screen)
        place.check_drawing()
        # The server is killed, the text edited, and the server started again with Helix's own command.
        terminal.type("u")
        terminal.wait("undo", lambda screen: "19.95" in screen)
        first = terminal.server()
        if first is not None:
            os.kill(first, 9)
        terminal.type(":", "l", "s", "p", "-", "r", "e", "s", "t", "a", "r", "t", "Enter")
        terminal.type("g", "g")
        end = time.monotonic() + 20
        while FAULT not in re.sub(r"\s+", " ", terminal.screen()) and time.monotonic() < end:
            terminal.type("]", "d")
        screen += terminal.wait("fault from the new server", lambda screen: FAULT in re.sub(r"\s+", " ", screen))
        terminal.type(":", "q", "!", "Enter")
        time.sleep(0.5)
    finally:
        terminal.close()
    place.log(f"{editor}.txt", screen)


def without_server(program: str) -> None:
    """What the README names reports that the server is missing."""
    place = Place("helix-without")
    (place.folder / "programs/wedm").unlink()
    configuration = place.folder / "home/.config/helix"
    configuration.mkdir()
    shutil.copy(EDITORS / "helix/languages.toml", configuration)
    said = place.run([program, "--health", "dxf"], HELIX_RUNTIME=str(Path(program).parent / "runtime"), PATH=place.path_without_server())
    saw(said, "wedm", "not found in $PATH")

#!/usr/bin/env python3
"""Runs a session in each editor named and says what was seen; prints one line of counts at the end.

Each editor opens a drawing with one fault, shows it, applies the fix that the server offers, and saves. Nothing is taken from the
editor's word alone: the file that it wrote is compared with the one it was given, and checked by `wedm check`.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WEDM = os.environ.get("WEDM", str(ROOT / "target/release/wedm"))
DRAWING = ROOT / "tests/data/tight_fillet.dxf"
ARTIFACTS = ROOT / "target/artifacts/editors"
TOOLS = HERE / ".tools"
#: Folder in which the messages between editor and server are recorded; empty for none.
RECORD = os.environ.get("WEDM_RECORD_SESSIONS")

FAULT = "arc R 0.050 mm is below the correction 0.100 mm"
#: Keeps in `said` what Neovim tells its user.
HEAR = "local notify, said = vim.notify, ''\nvim.notify = function(text, ...) said = said .. text notify(text, ...) end\n"
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


def neovim(program: str, native: bool, editor: str) -> None:
    place = Place(editor)
    words = [program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(HERE / "neovim/session.lua")]
    said = place.run(words, WEDM_CONFIGURATION=str(HERE / "neovim"), WEDM_NATIVE="1" if native else "0")
    place.log(f"{editor}.txt", said)
    saw(said, FAULT, f"offered: {OFFERED}", "fixed and written", "undo has overtaken changed nothing", "the server was killed and started again: 1 fault")
    place.check_drawing()


def neovim_by_path(program: str) -> None:
    """The command in the options is used where no `wedm` is on the PATH."""
    place = Place("neovim-by-path")
    server = place.folder / "programs/wedm"
    server.rename(place.folder / "my-wedm")
    script = place.folder / "start.lua"
    script.write_text(
        f"vim.opt.runtimepath:append('{HERE}/neovim') require('wedm').setup {{ cmd = {{ '{place.folder}/my-wedm' }} }}\n"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\n"
        "vim.wait(90000, function() return #vim.diagnostic.get(0) > 0 end, 20)\n"
        "for _, found in ipairs(vim.diagnostic.get(0)) do io.stdout:write(found.message .. '\\n') end\nvim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)], PATH=place.path_without_server())
    saw(said, FAULT)


def move_to_where_cargo_installs(place: Place) -> None:
    target = place.folder / "home/.cargo/bin/wedm"
    target.parent.mkdir(parents=True)
    (place.folder / "programs/wedm").rename(target)


def neovim_installed(program: str, native: bool, editor: str) -> None:
    """The server is where cargo puts it, and that is not on the PATH."""
    place = Place(editor + "-installed")
    move_to_where_cargo_installs(place)
    words = [program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(HERE / "neovim/session.lua")]
    said = place.run(words, WEDM_CONFIGURATION=str(HERE / "neovim"), WEDM_NATIVE="1" if native else "0", PATH=place.path_without_server())
    saw(said, FAULT, "fixed and written")


def neovim_that_dies(program: str, native: bool, editor: str) -> None:
    """A server that dies at every start is given up, with a message; opening the drawing again starts it again."""
    place = Place(editor + "-dies")
    server = place.folder / "programs/wedm"
    server.unlink()
    server.write_text('#!/bin/sh\necho >>"$WEDM_DRAWING.starts"\nexit 3\n')
    server.chmod(0o755)
    if native:
        start = f"vim.opt.runtimepath:append('{HERE}/neovim') vim.lsp.enable('wedm') vim.cmd('filetype on') vim.cmd('runtime! ftdetect/wedm.lua')"
    else:
        start = f"vim.opt.runtimepath:append('{HERE}/neovim') require('wedm').setup()"
    script = place.folder / "start.lua"
    script.write_text(
        f"{start}\n{HEAR}"
        "vim.api.nvim_create_autocmd('VimEnter', { nested = true, callback = function()\n"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\n"
        "vim.wait(90000, function() return said:find('not started again') ~= nil end, 20)\nvim.wait(1000)\n"
        "io.stdout:write('starts: ' .. #vim.fn.readfile(vim.env.WEDM_DRAWING .. '.starts') .. '\\n')\nvim.cmd('edit')\n"
        "vim.wait(90000, function() return #vim.fn.readfile(vim.env.WEDM_DRAWING .. '.starts') > 6 end, 20)\nvim.cmd('qall!')\nend })\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)])
    saw(said, "wedm has ended with code 3 and is started again in 0.5 s", "wedm has ended 6 times in a row, the last time with code 3", "starts: 6")
    starts = Path(f"{place.drawing}.starts").read_text().count("\n")
    expect(starts > 6, "opening the drawing again has not started it again")


def neovim_pauses(program: str) -> None:
    """The pauses between two starts are those of every client."""
    place = Place("neovim-pauses")
    script = place.folder / "pauses.lua"
    script.write_text(
        f"vim.opt.runtimepath:append('{HERE}/neovim')\n"
        f"local cases = vim.fn.json_decode(vim.fn.readfile('{HERE.parent}/restarts.json')).cases\n"
        "for _, case in ipairs(cases) do\n"
        "local after_life_of = require('wedm.restarts').row()\n"
        "for index, life in ipairs(case.lives) do\n"
        "local pause, expected = after_life_of(life * 1000), case.pauses[index]\n"
        "io.stdout:write((pause == (expected ~= vim.NIL and expected * 1000 or nil) and 'as expected' or 'WRONG') .. '\\n')\n"
        "end end vim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)])
    saw(said, "as expected")
    expect("WRONG" not in said, said)


def neovim_package(program: str, native: bool, editor: str) -> None:
    """The folder as a plugin manager puts it on the runtime path, with a user's init.lua, and nothing else."""
    place = Place(editor + "-package")
    package = place.folder / "home/.local/share/nvim/site/pack/manager/start/wedm"
    package.parent.mkdir(parents=True)
    package.symlink_to(HERE / "neovim")
    (place.folder / "home/.config/nvim").mkdir(parents=True)
    (place.folder / "home/.config/nvim/init.lua").write_text("vim.lsp.enable('wedm')\n" if native else "require('wedm').setup()\n")
    script = place.folder / "seen.lua"
    script.write_text(
        "vim.wait(90000, function() return #vim.diagnostic.get(0) > 0 end, 20)\n"
        "io.stdout:write('type: ' .. vim.bo.filetype .. '\\n')\n"
        "for _, found in ipairs(vim.diagnostic.get(0)) do io.stdout:write(found.message .. '\\n') end\nvim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-i", "NONE", "-n", str(place.drawing), "-S", str(script)])
    saw(said, "type: dxf", FAULT)
    # What the server says of the settings that were sent.
    expect("expected a table" not in said, said)


def neovim_without_server(program: str, native: bool, editor: str) -> None:
    place = Place(editor + "-without")
    (place.folder / "programs/wedm").unlink()
    if native:
        start = f"vim.opt.runtimepath:append('{HERE}/neovim') vim.lsp.enable('wedm') vim.cmd('filetype on') vim.cmd('runtime! ftdetect/wedm.lua')"
    else:
        start = f"vim.opt.runtimepath:append('{HERE}/neovim') require('wedm').setup()"
    script = place.folder / "start.lua"
    script.write_text(
        f"{start}\n{HEAR}"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\nvim.wait(90000, function() return said:find('cargo install', 1, true) ~= nil end, 20)\nvim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)], PATH=place.path_without_server())
    saw(said, "cargo install --path .")


def emacs(program: str, editor: str) -> None:
    place = Place(editor)
    seen = place.folder / "seen.txt"
    # A terminal of its own: as a batch Emacs has no command loop, and does not hear of the server's death.
    words = ["script", "-qec", f"stty rows 40 cols 120; {program} -nw -q -l {HERE}/emacs/session.el", "/dev/null"]
    try:
        place.run(words, WEDM_CONFIGURATION=str(HERE / "emacs"), WEDM_SEEN=str(seen), TERM="xterm")
    except Failed as failed:
        raise Failed(f"{seen.read_text() if seen.exists() else ''}{failed}") from None
    said = seen.read_text()
    place.log(f"{editor}.txt", said)
    saw(said, FAULT, "mode: dxf-mode", f"offered: {OFFERED}", "fixed and written", "the server was killed and started again: 1 fault")
    place.check_drawing()


def emacs_installed(program: str) -> None:
    """The server is where cargo puts it, and that is not on the PATH."""
    place = Place("emacs-installed")
    move_to_where_cargo_installs(place)
    show = "(princ (wedm--contact))"
    said = place.run([program, "--batch", "-q", "-l", "package", "-f", "package-initialize", "-l", f"{HERE}/emacs/wedm.el", "--eval", show], PATH=place.path_without_server())
    saw(said, f"{place.folder}/home/.cargo/bin/wedm")


def emacs_without_server(program: str) -> None:
    place = Place("emacs-without")
    (place.folder / "programs/wedm").unlink()
    # Batch: nothing has to come from a server.
    show = '(progn (find-file (getenv "WEDM_DRAWING")) (princ (format "%s" major-mode)))'
    said = place.run([program, "--batch", "-q", "-l", "package", "-f", "package-initialize", "-l", f"{HERE}/emacs/wedm.el", "--eval", show], PATH=place.path_without_server())
    saw(said, "cargo install --path .", "dxf-mode")


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


def helix(program: str, editor: str) -> None:
    place = Place(editor)
    configuration = place.folder / "home/.config/helix"
    configuration.mkdir()
    shutil.copy(HERE / "helix/languages.toml", configuration)
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


def helix_without_server(program: str) -> None:
    """What the README names reports that the server is missing."""
    place = Place("helix-without")
    (place.folder / "programs/wedm").unlink()
    configuration = place.folder / "home/.config/helix"
    configuration.mkdir()
    shutil.copy(HERE / "helix/languages.toml", configuration)
    said = place.run([program, "--health", "dxf"], HELIX_RUNTIME=str(Path(program).parent / "runtime"), PATH=place.path_without_server())
    saw(said, "wedm", "not found in $PATH")


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
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
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


def kate(program: str, editor: str) -> None:
    place = Place(editor)
    configuration, data = place.folder / "home/.config", place.folder / "home/.local/share/org.kde.syntax-highlighting/syntax"
    (configuration / "kate/lspclient").mkdir(parents=True)
    shutil.copy(HERE / "kate/settings.json", configuration / "kate/lspclient")
    shutil.copytree(HERE / "kate/syntax", data)
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


def tool(name: str) -> str | None:
    """A program that `test` has put into .tools, else one on the PATH."""
    own = {"nvim-0.11": TOOLS / "neovim/bin/nvim", "hx": TOOLS / "helix/hx"}.get(name)
    if own is not None:
        return str(own) if own.exists() else None
    return shutil.which(name)


def checks() -> list[tuple[str, str, Callable[[str], None]]]:
    """What is checked: a name, the program that it needs, and the session."""
    return [
        ("Neovim 0.7, require('wedm'): repair, death of the server", "nvim", lambda program: neovim(program, False, "neovim-0.7")),
        ("Neovim 0.7, require('wedm'): the server by its path", "nvim", neovim_by_path),
        ("Neovim 0.7, require('wedm'): no server", "nvim", lambda program: neovim_without_server(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: repair, death of the server", "nvim-0.11", lambda program: neovim(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): the server where cargo installs it", "nvim", lambda program: neovim_installed(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: the server where cargo installs it", "nvim-0.11", lambda program: neovim_installed(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): a server that dies at every start", "nvim", lambda program: neovim_that_dies(program, False, "neovim-0.7")),
        ("Neovim 0.11, vim.lsp.config: a server that dies at every start", "nvim-0.11", lambda program: neovim_that_dies(program, True, "neovim-0.11")),
        ("Neovim 0.7, require('wedm'): the pauses between two starts", "nvim", neovim_pauses),
        ("Neovim 0.7, require('wedm'): as a package", "nvim", lambda program: neovim_package(program, False, "neovim-0.7")),
        ("Neovim 0.11, require('wedm'): as a package", "nvim-0.11", lambda program: neovim_package(program, False, "neovim-0.11-setup")),
        ("Neovim 0.11, vim.lsp.config: as a package", "nvim-0.11", lambda program: neovim_package(program, True, "neovim-0.11")),
        ("Neovim 0.11, vim.lsp.config: no server", "nvim-0.11", lambda program: neovim_without_server(program, True, "neovim-0.11")),
        ("Emacs, eglot: repair, death of the server", "emacs", lambda program: emacs(program, "emacs")),
        ("Emacs, eglot: the server where cargo installs it", "emacs", emacs_installed),
        ("Emacs, eglot: no server", "emacs", emacs_without_server),
        ("Helix: repair, death of the server", "hx", lambda program: helix(program, "helix")),
        ("Helix: no server", "hx", helix_without_server),
        ("Kate: repair, death of the server", "kate", lambda program: kate(program, "kate")),
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

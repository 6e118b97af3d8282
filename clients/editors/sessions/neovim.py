"""Sessions in Neovim, by both of the ways that its README names."""

from __future__ import annotations

from pathlib import Path

from .place import EDITORS, FAULT, OFFERED, WEDM, Place, expect, saw

#: Keeps in `said` what Neovim tells its user.
HEAR = "local notify, said = vim.notify, ''\nvim.notify = function(text, ...) said = said .. text notify(text, ...) end\n"


def start(native: bool) -> str:
    """What a user has in init.lua."""
    if native:
        return f"vim.opt.runtimepath:append('{EDITORS}/neovim') vim.lsp.enable('wedm') vim.cmd('filetype on') vim.cmd('runtime! ftdetect/wedm.lua')"
    return f"vim.opt.runtimepath:append('{EDITORS}/neovim') require('wedm').setup()"


def repair(program: str, native: bool, editor: str) -> None:
    place = Place(editor)
    words = [program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(EDITORS / "neovim/session.lua")]
    said = place.run(words, WEDM_CONFIGURATION=str(EDITORS / "neovim"), WEDM_NATIVE="1" if native else "0")
    place.log(f"{editor}.txt", said)
    saw(said, FAULT, f"offered: {OFFERED}", "fixed and written", "undo has overtaken changed nothing", "the server was killed and started again: 1 fault")
    place.check_drawing()


def by_path(program: str) -> None:
    """The command in the options is used where no `wedm` is on the PATH."""
    place = Place("neovim-by-path")
    server = place.folder / "programs/wedm"
    server.rename(place.folder / "my-wedm")
    script = place.folder / "start.lua"
    script.write_text(
        f"vim.opt.runtimepath:append('{EDITORS}/neovim') require('wedm').setup {{ cmd = {{ '{place.folder}/my-wedm' }} }}\n"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\n"
        "vim.wait(90000, function() return #vim.diagnostic.get(0) > 0 end, 20)\n"
        "for _, found in ipairs(vim.diagnostic.get(0)) do io.stdout:write(found.message .. '\\n') end\nvim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)], PATH=place.path_without_server())
    saw(said, FAULT)


def installed(program: str, native: bool, editor: str) -> None:
    """The server is where cargo puts it, and that is not on the PATH."""
    place = Place(editor + "-installed")
    place.move_to_where_cargo_installs()
    words = [program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(EDITORS / "neovim/session.lua")]
    said = place.run(words, WEDM_CONFIGURATION=str(EDITORS / "neovim"), WEDM_NATIVE="1" if native else "0", PATH=place.path_without_server())
    saw(said, FAULT, "fixed and written")


def that_dies(program: str, native: bool, editor: str) -> None:
    """A server that dies at every start is given up, with a message; opening the drawing again starts it again."""
    place = Place(editor + "-dies")
    server = place.folder / "programs/wedm"
    server.unlink()
    # With 3 and with 0 in turns: a code says nothing of whether it was asked to end.
    server.write_text('#!/bin/sh\necho >>"$WEDM_DRAWING.starts"\nexit $(($(wc -l <"$WEDM_DRAWING.starts") % 2 * 3))\n')
    server.chmod(0o755)
    script = place.folder / "start.lua"
    script.write_text(
        f"{start(native)}\n{HEAR}"
        "vim.api.nvim_create_autocmd('VimEnter', { nested = true, callback = function()\n"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\n"
        "vim.wait(90000, function() return said:find('not started again') ~= nil end, 20)\nvim.wait(1000)\n"
        "io.stdout:write('starts: ' .. #vim.fn.readfile(vim.env.WEDM_DRAWING .. '.starts') .. '\\n')\nvim.cmd('edit')\n"
        "vim.wait(90000, function() return #vim.fn.readfile(vim.env.WEDM_DRAWING .. '.starts') > 6 end, 20)\nvim.cmd('qall!')\nend })\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)])
    saw(said, "wedm has ended with code 0 and is started again in 0.5 s", "wedm has ended 6 times in a row, the last time with code 0", "starts: 6")
    starts = Path(f"{place.drawing}.starts").read_text().count("\n")
    expect(starts > 6, "opening the drawing again has not started it again")


def bad_server(program: str, native: bool, editor: str, how: str, act: str, *expected: str) -> None:
    """A server that does what the stand-in of the Python client's tests calls `how`, and what then is told and started."""
    place = Place(f"{editor}-{act}")
    server = place.folder / "programs/wedm"
    server.unlink()
    stand_in = f"WEDM={WEDM} exec python3 {EDITORS.parent}/python/tests/stand_in.py {how}" if how else f"exec {WEDM}"
    server.write_text(f'#!/bin/sh\necho >>"$WEDM_DRAWING.starts"\n{stand_in}\n')
    server.chmod(0o755)
    patience = "1500" if how.startswith("deaf") else ""
    words = [program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(EDITORS / "neovim/bad_server.lua")]
    said = place.run(words, WEDM_CONFIGURATION=str(EDITORS / "neovim"), WEDM_NATIVE="1" if native else "0", WEDM_ACT=act, WEDM_PATIENCE=patience)
    saw(said, "patience: 20000 ms", *expected)


def of_another_version(program: str, native: bool, editor: str) -> None:
    update = "speaks protocol 2 of wedm, these files speak 1: update these files"
    bad_server(program, native, editor, "protocol 2", "given_up", update, "starts: 1")


def that_is_silent(program: str, native: bool, editor: str) -> None:
    bad_server(program, native, editor, "deaf initialize", "given_up", "does not answer: there was nothing within 1.5 s", "starts: 1")


def that_babbles(program: str, native: bool, editor: str) -> None:
    """Bodies that are no JSON: of other bytes Neovim tells no client."""
    bad_server(program, native, editor, "raves textDocument/hover once", "babble", "starts: 2")


def that_is_stopped(program: str, native: bool, editor: str) -> None:
    bad_server(program, native, editor, "", "stop", "starts: 1")


def pauses(program: str) -> None:
    """The pauses between two starts are those of every client."""
    place = Place("neovim-pauses")
    script = place.folder / "pauses.lua"
    script.write_text(
        f"vim.opt.runtimepath:append('{EDITORS}/neovim')\n"
        f"local cases = vim.fn.json_decode(vim.fn.readfile('{EDITORS.parent}/restarts.json')).cases\n"
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


def package(program: str, native: bool, editor: str) -> None:
    """The folder as a plugin manager puts it on the runtime path, with a user's init.lua, and nothing else."""
    place = Place(editor + "-package")
    package = place.folder / "home/.local/share/nvim/site/pack/manager/start/wedm"
    package.parent.mkdir(parents=True)
    package.symlink_to(EDITORS / "neovim")
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


def without_server(program: str, native: bool, editor: str) -> None:
    place = Place(editor + "-without")
    (place.folder / "programs/wedm").unlink()
    script = place.folder / "start.lua"
    script.write_text(
        f"{HEAR}{start(native)}\n"
        "vim.cmd('edit ' .. vim.env.WEDM_DRAWING)\nvim.wait(90000, function() return said:find('cargo install', 1, true) ~= nil end, 20)\nvim.cmd('qall!')\n"
    )
    said = place.run([program, "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S", str(script)], PATH=place.path_without_server())
    saw(said, "cargo install --path .")

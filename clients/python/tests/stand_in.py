"""A real server behind a pipe on which one thing is changed, for days on which things are not as they should be.

    python stand_in.py protocol N      says that it speaks protocol N
    python stand_in.py dies METHOD     ends when it is asked for METHOD
    python stand_in.py deaf METHOD     never answers METHOD
    python stand_in.py slow METHOD     passes METHOD on after seven seconds, in which it says that it works on it
    python stand_in.py babbles METHOD  writes a line that is no message, directly before the answer to METHOD
    python stand_in.py raves METHOD    the same with a body that is no JSON
    python stand_in.py counts METHOD   the same with JSON that is no message
    python stand_in.py mute METHOD     closes its stdout when it is asked for METHOD, and lives on

With the name of a file behind METHOD the last four do so once: they make the file, and do nothing of the kind where it stands.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import IO, Any


def read(stream: IO[bytes]) -> dict[str, Any] | None:
    length = 0
    while (line := stream.readline()) not in (b"\r\n", b""):
        if line.lower().startswith(b"content-length:"):
            length = int(line.split(b":")[1])
    body = stream.read(length) if length else b""
    return json.loads(body) if body else None


def write(stream: IO[bytes], message: dict[str, Any]) -> None:
    body = json.dumps(message).encode()
    stream.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
    stream.flush()


def misbehave(what: str, once: list[str]) -> None:
    for mark in map(Path, once):
        if mark.exists():
            return
        mark.touch()
    if what == "mute":
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    said = {"babbles": b"the cutter is warm\n", "raves": b"Content-Length: 7\r\n\r\nno json", "counts": b"Content-Length: 2\r\n\r\n42"}
    sys.stdout.buffer.write(said.get(what, b""))
    sys.stdout.buffer.flush()


def report(token: str | None) -> None:
    for _ in range(28):
        write(sys.stdout.buffer, {"jsonrpc": "2.0", "method": "$/progress", "params": {"token": token, "value": {"kind": "report", "message": "still cutting"}}})
        time.sleep(0.25)


def main() -> None:
    what, detail, *once = sys.argv[1:]
    server = subprocess.Popen([os.environ["WEDM"]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert server.stdin is not None and server.stdout is not None
    out, into = server.stdout, server.stdin

    def answers() -> None:
        while (message := read(out)) is not None:
            result = message.get("result")
            experimental = result.get("capabilities", {}).get("experimental") if isinstance(result, dict) else None
            if what == "protocol" and experimental:
                experimental["wedm"]["protocol"] = int(detail)
            write(sys.stdout.buffer, message)
        os._exit(0)

    threading.Thread(target=answers, daemon=True).start()
    while (message := read(sys.stdin.buffer)) is not None:
        if message.get("method") == detail:
            if what == "dies":
                print("the roof fell in", file=sys.stderr, flush=True)
                server.kill()
                os._exit(3)
            if what == "deaf":
                continue
            if what == "slow":
                report(message["params"].get("workDoneToken"))
            misbehave(what, once)
        write(into, message)
    into.close()
    server.wait()


if __name__ == "__main__":
    main()

"""A real server behind a pipe on which one thing is changed, for days on which things are not as they should be.

    python stand_in.py protocol N      says that it speaks protocol N
    python stand_in.py dies METHOD     ends when it is asked for METHOD
    python stand_in.py deaf METHOD     never answers METHOD
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
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


def main() -> None:
    what, detail = sys.argv[1:3]
    server = subprocess.Popen([os.environ["WEDM"]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert server.stdin is not None and server.stdout is not None
    out, into = server.stdout, server.stdin

    def answers() -> None:
        while (message := read(out)) is not None:
            experimental = (message.get("result") or {}).get("capabilities", {}).get("experimental") if "result" in message else None
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
        write(into, message)
    into.close()
    server.wait()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Stands between a client and the server and writes down what they say, one JSON object a line.

    WEDM_RECORD=session.jsonl WEDM=/path/to/wedm record.py [ARGUMENTS OF WEDM]

A client is told that this program is the server. Bytes pass through unchanged and at once; a frame that is no JSON is passed on and
not written down. Needs nothing but Python, so that it runs wherever a client does.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from typing import BinaryIO, TextIO


def frames(stream: BinaryIO, onward: BinaryIO, said_by: str, record: TextIO, started: float, lock: threading.Lock) -> None:
    """Passes one direction on until its end, and writes down its frames."""
    waiting = b""
    while chunk := os.read(stream.fileno(), 1 << 16):
        waiting += chunk
        while (end := waiting.find(b"\r\n\r\n")) >= 0:
            length = next((int(line[15:]) for line in waiting[:end].split(b"\r\n") if line.lower().startswith(b"content-length:")), 0)
            if len(waiting) < end + 4 + length:
                break
            body, waiting = waiting[end + 4 : end + 4 + length], waiting[end + 4 + length :]
            try:
                message = json.loads(body)
            except ValueError:
                continue
            with lock:
                line = {"at": round(time.monotonic() - started, 3), "from": said_by, "message": message}
                record.write(json.dumps(line, ensure_ascii=False, separators=(",", ":")) + "\n")
                record.flush()
        # Passed on when it is written down: what it brings about stands after it.
        onward.write(chunk)
        onward.flush()


def main() -> int:
    target = os.environ.get("WEDM_RECORD")
    if not target:
        print("record.py: WEDM_RECORD names no file", file=sys.stderr)
        return 2
    server = subprocess.Popen([os.environ.get("WEDM", "wedm"), *sys.argv[1:]], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert server.stdin is not None and server.stdout is not None
    # Added to, so that a server that the client starts again stands after the first one.
    with open(target, "a", encoding="utf-8") as record:
        started, lock = time.monotonic(), threading.Lock()
        answers = threading.Thread(target=frames, args=(server.stdout, sys.stdout.buffer, "server", record, started, lock), daemon=True)
        answers.start()
        try:
            frames(sys.stdin.buffer, server.stdin, "client", record, started, lock)
        except BrokenPipeError:
            pass
        try:
            server.stdin.close()
        except BrokenPipeError:
            pass
        code = server.wait()
        answers.join(2)
    return code


if __name__ == "__main__":
    sys.exit(main())

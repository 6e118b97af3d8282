#!/usr/bin/env python3
"""Makes recorded sessions fit to be kept: no names of folders, no process numbers, no log lines, no pictures, which are not compared.

    tidy.py SESSION.jsonl...      rewrites each file
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

# Whatever folder the drawing stood in, and the home that a test made in it.
FOLDER = re.compile(r"/(?:tmp|root|home|work|var|private|usr)/(?:[\w.+-]+/)*(?=[\w.+-]+\.(?:dxf|3b|iso|nc)\b)|/(?:tmp|root|home|work|var)(?:/[\w.+-]+)+/?")


def tidy(path: Path) -> None:
    kept = []
    for line in path.read_text(encoding="utf-8").splitlines():
        said: dict[str, Any] = json.loads(line)
        message = said["message"]
        if message.get("method") in ("window/logMessage", "$/setTrace"):
            continue
        if message.get("method") == "workspace/didChangeWatchedFiles":
            # What follows depends on files that are not kept with the session.
            break
        if isinstance(message.get("result"), dict) and "svg" in message["result"]:
            message["result"]["svg"] = "<svg/>"
        if message.get("method") == "initialize":
            message["params"]["processId"] = None
        kept.append(FOLDER.sub(lambda found: "/session/" if found.group().endswith("/") else "/session", json.dumps(said, ensure_ascii=False, separators=(",", ":"))))
    path.write_text("\n".join(kept) + "\n", encoding="utf-8")


for name in sys.argv[1:]:
    tidy(Path(name))

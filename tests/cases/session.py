"""A session with the language server, step by step."""

import json
import os
import pathlib
import queue
import re
import subprocess
import threading
import time

from results import Short, environment


class Session:
    """A session with the language server. Steps of `do`:

    ["open", NAME, TEXT?]            didOpen of a file of the folder, with its text or another one
    ["change", NAME, TEXT], ["close", NAME]
    ["write", NAME, TEXT], ["remove", NAME]     on disk, and told with didChangeWatchedFiles
    ["configuration", SETTINGS]      what the client answers to workspace/configuration from now on, and that it has changed
    ["drawing", DRAWING]             wedm/didOpenDrawing
    ["request", LABEL, METHOD, PARAMS]          "@NAME" in params is the URI of a file
    ["findings", LABEL, NAME]        the rules found in a document (a URI for a drawing), within 5 seconds; else "nothing"
    ["actions", LABEL, NAME]         the quick fixes of all its findings: [{title, preferred, text}]
    ["fresh", LABEL]                 whether another server, which gets the documents as they are now, finds the same: "same", or both
    ["raw", LABEL, [MESSAGE, ...]]   messages as they are, then the end of input: {code, replies}
    """
    LANGUAGES = {"dxf": "dxf", "3b": "3b", "4b": "3b", "iso": "wire-iso", "nc": "wire-iso", "toml": "toml"}

    def __init__(self, wedm, folder, server, slower, patience):
        self.wedm, self.folder, self.server, self.slower, self.patience = wedm, pathlib.Path(folder), server, slower, patience
        self.settings, self.documents, self.got = server.get("configuration", {}), {}, {}
        self.version, self.process = 1, None

    def uri(self, name):
        return name if ":" in name else (self.folder / name).resolve().as_uri()

    def start(self):
        self.process = subprocess.Popen([self.wedm], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        cwd=self.folder, env=environment())
        self.inbox, self.latest, self.replies, self.number, self.heard = queue.Queue(), {}, {}, 0, time.monotonic()
        threading.Thread(target=self.read, args=(self.process.stdout, self.inbox), daemon=True).start()
        capabilities = {"textDocument": {"publishDiagnostics": {"versionSupport": True, "dataSupport": True},
                                         "codeAction": {"codeActionLiteralSupport": {"codeActionKind": {"valueSet": []}}, "isPreferredSupport": True}},
                        "workspace": {"configuration": True}}
        capabilities.update(self.server.get("capabilities", {}))
        self.request("initialize", {"processId": os.getpid(), "rootUri": None, "capabilities": capabilities,
                                    "initializationOptions": self.server.get("settings", {})}, 20)
        self.notify("initialized", {})

    @staticmethod
    def read(out, inbox):
        try:
            while True:
                size = None
                while True:
                    line = out.readline()
                    if not line:
                        return inbox.put(None)
                    if not line.strip():
                        break
                    if line.lower().startswith(b"content-length:"):
                        size = int(line.split(b":")[1])
                inbox.put(json.loads(out.read(size)))
        except Exception:
            inbox.put(None)

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        try:
            self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            self.process.stdin.flush()
        except OSError:
            raise Short("the server has ended")

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def pump(self, end):
        """Takes one message; False at the time `end`."""
        left = end - time.monotonic()
        if left <= 0:
            return False
        try:
            message = self.inbox.get(timeout=left)
        except queue.Empty:
            return False
        if message is None:
            raise Short("the server has ended")
        self.heard = time.monotonic()
        if "method" in message and "id" in message:
            answer = None
            if message["method"] == "workspace/configuration":
                answer = [self.settings for _ in message["params"]["items"]]
            self.send({"id": message["id"], "result": answer})
        elif message.get("method") == "textDocument/publishDiagnostics":
            self.latest[message["params"]["uri"]] = message["params"]
        elif "id" in message:
            self.replies[message["id"]] = message
        return True

    def request(self, method, params, seconds=10):
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        end = time.monotonic() + seconds * self.slower
        while self.number not in self.replies:
            if not self.pump(end):
                raise Short(f"{method} is not answered in {seconds} s")
        return self.replies.pop(self.number)

    def quiet(self, seconds=0.6):
        """Until the server has said nothing for a while."""
        self.heard = time.monotonic()
        limit = time.monotonic() + 15 * self.slower
        while time.monotonic() < limit and self.pump(self.heard + seconds * self.patience):
            pass

    def open(self, name, text=None):
        if text is None:
            text = (self.folder / name).read_text()
        self.documents[name] = text
        self.notify("textDocument/didOpen", {"textDocument": {"uri": self.uri(name), "languageId": self.LANGUAGES[name.rsplit(".", 1)[1]],
                                                              "version": self.version, "text": text}})

    def rules(self, name):
        return sorted(d["code"] for d in self.latest.get(self.uri(name), {}).get("diagnostics", []))

    def uris(self, value):
        if isinstance(value, str) and value.startswith("@"):
            return self.uri(value[1:])
        if isinstance(value, dict):
            return {k: self.uris(v) for k, v in value.items()}
        return [self.uris(v) for v in value] if isinstance(value, list) else value

    def run(self, steps):
        try:
            if steps[0][0] != "raw":
                self.start()
            for op, *rest in steps:
                self.version += 1
                getattr(self, "do_" + op)(*rest)
        finally:
            if self.process:
                self.process.kill()
                self.process.wait()
        return self.got

    def do_open(self, name, text=None):
        self.open(name, text)
        self.quiet(0.4)

    def do_change(self, name, text):
        self.documents[name] = text
        self.notify("textDocument/didChange", {"textDocument": {"uri": self.uri(name), "version": self.version}, "contentChanges": [{"text": text}]})
        self.quiet(0.4)

    def do_close(self, name):
        self.documents.pop(name)
        self.notify("textDocument/didClose", {"textDocument": {"uri": self.uri(name)}})
        self.quiet(0.4)

    def do_write(self, name, text):
        path = self.folder / name
        kind = 2 if path.exists() else 1
        path.write_text(text)
        self.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": self.uri(name), "type": kind}]})
        self.quiet(0.4)

    def do_remove(self, name):
        uri = self.uri(name)
        (self.folder / name).unlink()
        self.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri, "type": 3}]})
        self.quiet(0.4)

    def do_configuration(self, settings):
        self.settings = settings
        self.notify("workspace/didChangeConfiguration", {"settings": None})
        self.quiet()

    def do_drawing(self, drawing):
        self.notify("wedm/didOpenDrawing", {"drawing": drawing})

    def do_request(self, label, method, params):
        reply = self.request(method, self.uris(params))
        self.got[label] = reply.get("result", {"refused": reply.get("error", {})})

    def do_findings(self, label, name):
        end, uri = time.monotonic() + 5 * self.slower, self.uri(name)
        while uri not in self.latest and self.pump(end):
            pass
        self.got[label] = self.rules(name) if uri in self.latest else "nothing"

    def do_actions(self, label, name):
        self.quiet()
        uri, found = self.uri(name), {}
        for diagnostic in self.latest.get(uri, {}).get("diagnostics", []):
            reply = self.request("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": diagnostic["range"],
                                                             "context": {"diagnostics": [diagnostic], "only": ["quickfix"]}})
            for action in reply.get("result") or []:
                edit = action.get("edit") or {}
                edits = (edit.get("changes") or {}).get(uri) or [e for d in edit.get("documentChanges") or [] for e in d.get("edits", [])]
                found[action["title"]] = {"title": action["title"], "preferred": bool(action.get("isPreferred")),
                                          "text": edited(self.documents[name], edits)}
        self.got[label] = list(found.values())

    def do_fresh(self, label):
        self.quiet(1.0)
        mine, documents = {n: self.rules(n) for n in self.documents}, dict(self.documents)
        self.process.kill()
        self.process.wait()
        self.start()
        self.quiet(0.3)
        for name, text in sorted(documents.items(), key=lambda d: ["toml", "3b", "4b", "iso", "nc", "dxf"].index(d[0].rsplit(".", 1)[1])):
            self.open(name, text)                       # settings first, drawings last: nothing that comes later changes what is found
            self.quiet(0.3)
        self.quiet(1.0)
        fresh = {n: self.rules(n) for n in documents}
        self.got[label] = "same" if mine == fresh else f"{mine}, but a fresh server {fresh}"

    def do_raw(self, label, messages):
        process = subprocess.Popen([self.wedm], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=self.folder, env=environment())
        data = b""
        for message in messages:
            body = json.dumps({"jsonrpc": "2.0", **message}).encode()
            data += b"Content-Length: %d\r\n\r\n" % len(body) + body
        try:
            out, _ = process.communicate(data, timeout=20 * self.slower)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            raise Short("the server does not end in 20 s")
        replies = {}
        while out:
            head, _, rest = out.partition(b"\r\n\r\n")
            size = int(re.search(rb"(?i)content-length:\s*(\d+)", head).group(1))
            message, out = json.loads(rest[:size]), rest[size:]
            if "id" in message and "method" not in message:
                replies[str(message["id"])] = "error" if "error" in message else "result"
        self.got[label] = {"code": process.returncode, "replies": replies}


def edited(text, edits):
    lines = text.split("\n")
    def offset(p):
        return sum(len(l) + 1 for l in lines[:p["line"]]) + p["character"] if p["line"] < len(lines) else len(text)
    for e in sorted(edits, key=lambda e: offset(e["range"]["start"]), reverse=True):
        text = text[:offset(e["range"]["start"])] + e["newText"] + text[offset(e["range"]["end"]):]
    return text

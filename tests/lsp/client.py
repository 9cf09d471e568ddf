"""A client that talks to `crt lsp` as an editor does."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

COMMAND = os.environ["CRT_COMMAND"]


def framed(body):
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


class Client:
    """A server with the client's end of its pipes."""

    def __init__(self):
        self.process = subprocess.Popen([COMMAND, "lsp"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
        self.last_id = 0
        self.diagnostics = {}  # what was published last, by URI
        self.logged = []

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        self.send_bytes(framed(json.dumps(message).encode()))

    def receive(self):
        """Returns the next message, or None at the end."""
        length = None
        for line in iter(self.process.stdout.readline, b""):
            if line == b"\r\n":
                return json.loads(self.process.stdout.read(length))
            name, value = line.split(b":")
            if name.lower() == b"content-length":
                length = int(value)
        return None

    def take_note(self, message):
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        if message.get("method") == "window/logMessage":
            self.logged.append(message["params"]["message"])

    def answer(self):
        """Returns the next message that is no notification."""
        while True:
            message = self.receive()
            if message is None or "method" not in message:
                return message
            self.take_note(message)

    def ask(self, method, params=None):
        """Returns the whole answer to a request."""
        self.last_id += 1
        request = {"jsonrpc": "2.0", "id": self.last_id, "method": method}
        self.send(request if params is None else {**request, "params": params})
        answer = self.answer()
        assert answer["id"] == self.last_id, answer
        return answer

    def result(self, method, params=None):
        answer = self.ask(method, params)
        assert "result" in answer, answer
        return answer["result"]

    def error(self, method, params=None):
        answer = self.ask(method, params)
        assert "error" in answer, answer
        return answer["error"]

    def notify(self, method, params=None):
        self.send({"jsonrpc": "2.0", "method": method, "params": params or {}})

    def wait_for_diagnostics(self, uri):
        """Returns the diagnostics of a file that are published next."""
        self.diagnostics.pop(uri, None)
        while uri not in self.diagnostics:
            message = self.receive()
            assert message is not None, "the server ended"
            self.take_note(message)
        return self.diagnostics[uri]

    def kill(self):
        """Ends the server if it still runs."""
        if self.process.poll() is None:
            self.process.kill()
        for pipe in (self.process.stdin, self.process.stdout):
            pipe.close()
        self.process.wait()

    def end(self):
        """Closes the pipes and returns the exit code."""
        self.process.stdin.close()
        self.process.stdout.read()
        self.process.stdout.close()
        return self.process.wait()


class ServerTest(unittest.TestCase):
    """A test with a server that is initialized, and a folder."""

    capabilities = {}

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(self.remove_folder)
        self.client = Client()
        self.addCleanup(self.client.kill)
        self.server = self.client.result(
            "initialize", {"processId": None, "rootUri": self.folder.as_uri(),
                           "capabilities": self.capabilities})
        self.client.notify("initialized")

    def remove_folder(self):
        for file in self.folder.iterdir():
            file.unlink()
        self.folder.rmdir()

    def uri(self, name="scene.crt"):
        return (self.folder / name).as_uri()

    def open(self, text, name="scene.crt"):
        """Opens a text. A '|' in it is the cursor and no part of it."""
        place = text.find("|")
        text = text.replace("|", "", 1)
        self.client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.uri(name), "languageId": "crt", "version": 1, "text": text}})
        before = text[:max(place, 0)]
        line = before.rpartition("\n")[2]
        return {"textDocument": {"uri": self.uri(name)},
                "position": {"line": before.count("\n"),
                             "character": len(line.encode("utf-16-le")) // 2}}

    def change(self, changes, version=2, name="scene.crt"):
        self.client.notify("textDocument/didChange", {
            "textDocument": {"uri": self.uri(name), "version": version},
            "contentChanges": changes})

    def document(self, name="scene.crt"):
        return {"textDocument": {"uri": self.uri(name)}}


def span(line, begin, end):
    return {"start": {"line": line, "character": begin}, "end": {"line": line, "character": end}}


def apply_edits(text, edits):
    """Applies edits of an ASCII text."""
    lines = text.splitlines(keepends=True)

    def offset(position):
        return sum(len(line) for line in lines[:position["line"]]) + position["character"]

    for edit in sorted(edits, key=lambda e: offset(e["range"]["start"]), reverse=True):
        begin, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:begin] + edit["newText"] + text[end:]
    return text

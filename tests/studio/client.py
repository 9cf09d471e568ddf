"""A client of the studio: WebSocket by hand, so that it can also send what no browser would."""

import base64
import json
import os
import pathlib
import re
import signal
import socket
import ssl
import struct
import subprocess
import tempfile
import time
import unittest

STUDIO = os.environ["CRT_STUDIO"]
COMMAND = os.environ["CRT_COMMAND"]
SECONDS = 60


class Server:
    """The studio on a folder. `words` are more that the command passes. `certificate` is what it
    shows by TLS, if it does. `before` is called in its process."""

    def __init__(self, folder, script="", words=(), certificate=None, before=None):
        self.process = subprocess.Popen(
            [STUDIO, f"folder={folder}", f"script={script}", "threads=2", *words],
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=before,
        )
        self.take(self.process.stdout.readline())
        if certificate:
            self.tls = ssl.create_default_context(cafile=certificate)

    def take(self, line):
        """Takes the address that a server has printed."""
        found = re.search(r"(https?)://([^/]+):(\d+)/#token=([0-9a-f]+)", line)
        self.scheme, self.host, self.port, self.token = found[1], found[2], int(found[3]), found[4]
        self.tls = None

    def connect(self, seconds=SECONDS):
        """Connects by TCP, and by TLS if the server has it."""
        connection = socket.create_connection((self.host.strip("[]"), self.port), seconds)
        if not self.tls:
            return connection
        return self.tls.wrap_socket(connection, server_hostname=self.host.strip("[]"))

    def end(self, how=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(SECONDS)
        self.process.stdout.close()
        return code

    def request(self, target, host=None, origin=None, method="GET", more=()):
        """Sends a request. Returns the socket, the status and the rest of what came."""
        lines = [f"{method} {target} HTTP/1.1", f"Host: {host or f'{self.host}:{self.port}'}"]
        if origin:
            lines.append(f"Origin: {origin}")
        connection = self.connect()
        connection.sendall(("\r\n".join([*lines, *more]) + "\r\n\r\n").encode())
        data = b""
        while b"\r\n\r\n" not in data:
            piece = connection.recv(65536)
            if not piece:
                break
            data += piece
        head, _, rest = data.partition(b"\r\n\r\n")
        status = int(head.split(b" ")[1]) if head else 0
        return connection, status, head.decode(), rest

    def status(self, target, **how):
        connection, status, _, _ = self.request(target, **how)
        connection.close()
        return status

    def answer_to_noise(self, noise):
        """Sends what is no request. Returns all that comes until the end of the connection."""
        answer = b""
        with self.connect() as connection:
            try:
                connection.sendall(noise)
                connection.shutdown(socket.SHUT_WR)
            except OSError:
                pass  # the server was done with it before
            try:
                while piece := connection.recv(65536):
                    answer += piece
            except OSError:
                pass  # the connection was cut
        return answer

    def send_noise(self):
        """Sends what is no request, on a connection for each, and reads until its end."""
        for noise in (b"\0" * 100, b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 5000, b"\r\n\r\n"):
            self.answer_to_noise(noise)

    def upgrade(self, token=None, **how):
        key = base64.b64encode(os.urandom(16)).decode()
        return self.request(
            f"/socket?token={self.token if token is None else token}",
            more=(
                "Upgrade: websocket",
                "Connection: Upgrade",
                "Sec-WebSocket-Version: 13",
                f"Sec-WebSocket-Key: {key}",
            ),
            **how,
        )


class Client:
    """A page, as the server sees it."""

    def __init__(self, server):
        self.socket, status, _, self.buffer = server.upgrade()
        assert status == 101, status
        self.revision = 0
        self.ids = 0
        self.hello = self.wait("hello")

    def close(self):
        self.socket.close()

    def send_frame(self, opcode, payload, is_masked=True, length=None):
        length = len(payload) if length is None else length
        mask_bit = 0x80 if is_masked else 0
        head = bytes([0x80 | opcode])
        if length < 126:
            head += bytes([mask_bit | length])
        elif length < 65536:
            head += bytes([mask_bit | 126]) + struct.pack(">H", length)
        else:
            head += bytes([mask_bit | 127]) + struct.pack(">Q", length)
        # A mask of zeros leaves the payload as it is.
        self.socket.sendall(head + (bytes(4) if is_masked else b"") + payload)

    def send(self, **message):
        self.send_frame(1, json.dumps(message).encode())

    def _read(self, count):
        while len(self.buffer) < count:
            piece = self.socket.recv(1 << 20)
            if not piece:
                raise ConnectionError("the server closed the connection")
            self.buffer += piece
        data, self.buffer = self.buffer[:count], self.buffer[count:]
        return data

    def receive(self):
        """Returns the next message: an object, or bytes."""
        content = b""
        while True:
            first, second = self._read(2)
            length = second & 0x7F
            if length == 126:
                (length,) = struct.unpack(">H", self._read(2))
            elif length == 127:
                (length,) = struct.unpack(">Q", self._read(8))
            payload = self._read(length)
            opcode = first & 0xF
            if opcode == 8:
                raise ConnectionError("the server closed the connection")
            if opcode == 9:
                self.send_frame(10, payload)
                continue
            kind = opcode or kind
            content += payload
            if first & 0x80:
                break
        if kind == 1:
            return json.loads(content)
        if content[:4] == b"CRTF":
            numbers = struct.unpack("<10I", content[:40])
            if numbers[1] & 0x100:
                self.send(type="acknowledge", picture=numbers[2])
        return content

    def wait(self, kind, where=lambda message: True):
        """Returns the next message of a type, and passes over all others."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            message = self.receive()
            if isinstance(message, dict) and message["type"] == kind and where(message):
                return message
        raise TimeoutError(kind)

    def open(self, script):
        self.send(type="open", script=script)
        return self.wait("opened")["text"]

    def set_text(self, text):
        self.revision += 1
        self.send(type="text", revision=self.revision, text=text)
        return self.revision

    def ask(self, what, at=0, **more):
        self.ids += 1
        self.send(type="ask", id=self.ids, what=what, at=at, revision=self.revision, **more)
        return self.wait("answer", lambda answer: answer["id"] == self.ids)["result"]

    def pick(self, x, y):
        self.ids += 1
        self.send(type="pick", id=self.ids, x=x, y=y)
        return self.wait("answer", lambda answer: answer["id"] == self.ids)["result"]

    def code(self, language, span=None):
        """Asks for source code of the scene, or of what comes from a piece of the text."""
        self.ids += 1
        piece = {} if span is None else {"span": span}
        self.send(type="code", id=self.ids, language=language, **piece)
        return self.wait("answer", lambda answer: answer["id"] == self.ids)["result"]

    def finish(self):
        """Waits for the picture of the newest text."""
        return self.wait("finished", lambda message: message["revision"] == self.revision)

    def picture(self, form="png"):
        self.send(type="picture", format=form)
        while True:
            message = self.receive()
            if isinstance(message, bytes) and message[:4] == b"CRTI":
                return message[8:]


class OpenedFolder(unittest.TestCase):
    """Has a server on a folder with the script a.crt, which has the text SCENE."""

    SCENE = ""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "a.crt").write_text(self.SCENE)
        self.server = Server(self.folder, "a.crt")
        self.addCleanup(self.server.end)

    def connect(self):
        client = Client(self.server)
        self.addCleanup(client.close)
        return client


# A view that shows all as files have it.
ALL = {"channel": "color", "hidden": [], "section": None, "region": None, "t": 0}


class ViewedFolder(OpenedFolder):
    """Has a client that looks at SCENE, which has WIDTH and HEIGHT, and its picture."""

    WIDTH, HEIGHT = 0, 0

    def setUp(self):
        super().setUp()
        self.client = self.connect()
        self.client.open("a.crt")
        self.client.set_text(self.SCENE)
        self.pixels = bytearray(4 * self.WIDTH * self.HEIGHT)
        self.picture, _ = self.whole()

    def whole(self):
        """Returns the pixels that a page has at the end of a render, and the kinds of pictures.
        `marks` has how these are marked, and `stats` what is said of the last."""
        kinds = []
        self.marks = set()
        while True:
            message = self.client.receive()
            if isinstance(message, dict):
                if message["type"] == "finished":
                    self.stats = message["stats"]
                    return bytes(self.pixels), kinds
                continue
            numbers = struct.unpack("<10I", message[:40])
            kinds.append(numbers[1] & 0xFF)
            self.marks.add(numbers[1] & 0x200)
            if kinds[-1] > 0:
                begin = 4 * self.WIDTH * numbers[8]
                self.pixels[begin : begin + len(message) - 40] = message[40:]

    def show(self, **options):
        self.client.send(type="view", view={**ALL, **options})
        return self.whole()[0]

    def at(self, pixels, place):
        begin = 4 * (self.WIDTH * place[1] + place[0])
        return tuple(pixels[begin : begin + 4])

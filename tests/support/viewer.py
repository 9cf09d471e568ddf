"""A stand-in for the viewer tev, which takes its messages apart."""

import socket
import struct
import threading

import numpy as np

SECONDS = 60
CHANNELS = ["R", "G", "B", "A"]


class Message:
    """A Message is read from its begin to its end."""

    def __init__(self, content):
        self.content = content
        self.place = 0

    def take(self, layout):
        numbers = struct.unpack_from("<" + layout, self.content, self.place)
        self.place += struct.calcsize("<" + layout)
        return numbers

    def text(self):
        end = self.content.index(0, self.place)
        text = self.content[self.place : end].decode()
        self.place = end + 1
        return text

    def channels(self):
        (count,) = self.take("i")
        return [self.text() for _ in range(count)]


class Viewer(threading.Thread):
    """A Viewer keeps what it is sent, as tev does."""

    def __init__(self, port=0):
        super().__init__(daemon=True)
        self.server = socket.create_server(("127.0.0.1", port))
        self.port = self.server.getsockname()[1]
        self.pictures = {}
        self.updates = 0
        self.incomplete = 0  # pictures with rows that are not rendered
        self.failure = None

    def run(self):
        try:
            self.server.settimeout(SECONDS)
            connection, _ = self.server.accept()
            connection.settimeout(SECONDS)
            with connection, connection.makefile("rb") as stream:
                while head := stream.read(4):
                    (length,) = struct.unpack("<I", head)
                    content = stream.read(length - 4)
                    if len(content) == length - 4:  # the last may be cut off by an interrupt
                        self.show(Message(content))
        except (AssertionError, OSError, struct.error, ValueError) as failure:
            self.failure = failure
        finally:
            self.server.close()

    def show(self, message):
        kind, focus = message.take("BB")
        name = message.text()
        if kind == 4:
            assert focus == 1 and name not in self.pictures
            width, height = message.take("ii")
            assert message.channels() == CHANNELS
            self.pictures[name] = np.full((height, width, 4), np.nan, np.float32)
        else:
            assert kind == 6 and focus == 0, kind
            assert message.channels() == CHANNELS
            x, y, width, height = message.take("iiii")
            offsets, strides = message.take("4q"), message.take("4q")
            floats = np.frombuffer(message.content, "<f4", offset=message.place)
            assert len(floats) == width * height * 4
            message.place = len(message.content)
            part = self.pictures[name][y : y + height, x : x + width]
            assert part.shape == (height, width, 4), part.shape
            for channel in range(4):
                values = floats[offsets[channel] :: strides[channel]]
                part[:, :, channel] = values.reshape(height, width)
            self.updates += 1
            self.incomplete += bool((part[:, :, 3] == 0).any())
        assert message.place == len(message.content)

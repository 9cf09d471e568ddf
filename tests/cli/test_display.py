"""`crt render --display` sends pictures to a viewer. A stand-in for the viewer takes its messages
apart, and must end with the picture that the same run has written."""

import os
import pathlib
import re
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest

import numpy as np

import crt

COMMAND = os.environ["CRT_COMMAND"]
SECONDS = 60
CHANNELS = ["R", "G", "B", "A"]
BALL = """Settings {
    width -> %d height -> %d supersampling -> %d
    background -> Background { color -> rgba(0.2, 0.4, 0.6, 0.5) }
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
Scene { for (i in range(0, 60)) {
    Sphere { center -> vec3(2 * sin(i), 2 * cos(2 * i), 0.05 * i) radius -> 0.4
             material -> Material { reflectivity -> 0.5 } } } }
"""


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

    def __init__(self):
        super().__init__()
        self.server = socket.create_server(("127.0.0.1", 0))
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


class Display(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, width=200, height=150, supersampling=2):
        (self.folder / "a.crt").write_text(BALL % (width, height, supersampling))

    def render(self, *words):
        return subprocess.run(
            [COMMAND, "render", "a.crt", *words],
            cwd=self.folder, capture_output=True, text=True, timeout=SECONDS, check=False,
        )

    def show(self, *words):
        viewer = Viewer()
        viewer.start()
        run = self.render("--display", f"127.0.0.1:{viewer.port}", *words)
        viewer.join(SECONDS)
        self.assertIsNone(viewer.failure)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("no viewer", run.stderr)
        return viewer

    def pixels(self, name):
        with crt.Image.read(self.folder / name) as image:
            return image.pixels.copy()

    def test_the_viewer_ends_with_the_picture_that_is_written(self):
        self.write()
        viewer = self.show("-o", "a.exr")
        self.assertEqual(list(viewer.pictures), ["a.exr"])
        np.testing.assert_array_equal(viewer.pictures["a.exr"], self.pixels("a.exr"))

    def test_the_file_has_the_bytes_that_it_has_without_a_viewer(self):
        self.write()
        self.show("-o", "a.exr", "--reproducible")
        self.render("-o", "b.exr", "--reproducible")
        self.assertEqual(
            (self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes()
        )

    def test_a_long_render_is_seen_in_progress(self):
        self.write(640, 480, 8)
        viewer = self.show("-o", "a.exr")
        self.assertGreater(viewer.incomplete, 0)
        np.testing.assert_array_equal(viewer.pictures["a.exr"], self.pixels("a.exr"))

    def test_each_frame_and_each_region_is_a_picture_of_its_size(self):
        self.write()
        viewer = self.show("--frames", "1-3", "-o", "f#.exr", "--region", "10,20,70,90")
        self.assertEqual(list(viewer.pictures), ["f1.exr", "f2.exr", "f3.exr"])
        for name, picture in viewer.pictures.items():
            self.assertEqual(picture.shape, (90, 70, 4))
            np.testing.assert_array_equal(picture, self.pixels(name))

    def test_without_a_viewer_the_picture_is_rendered_and_a_warning_says_why(self):
        self.write()
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]
        run = self.render("--display", f"127.0.0.1:{port}", "--frames", "1-2")
        self.assertEqual(run.returncode, 0)
        warnings = [line for line in run.stderr.splitlines() if "warning: no viewer" in line]
        self.assertEqual(len(warnings), 1, run.stderr)
        self.assertIn(f"127.0.0.1:{port}", warnings[0])
        self.assertIn("Connection refused", warnings[0])
        self.assertTrue((self.folder / "a_0002.png").exists())

    def test_a_viewer_that_takes_nothing_holds_the_render_up_for_seconds_at_most(self):
        self.write(1200, 900, 1)  # more bytes than sockets keep
        with socket.create_server(("127.0.0.1", 0)) as server:
            begin = time.monotonic()
            run = self.render("--display", f"127.0.0.1:{server.getsockname()[1]}")
            self.assertLess(time.monotonic() - begin, 30)
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stderr, "warning: no viewer .*takes no more")
        self.assertTrue((self.folder / "a.png").exists())

    def test_a_viewer_that_goes_away_is_a_warning(self):
        self.write(1200, 900, 1)
        with socket.create_server(("127.0.0.1", 0)) as server:
            leave = threading.Thread(target=lambda: server.accept()[0].close())
            leave.start()
            run = self.render("--display", f"127.0.0.1:{server.getsockname()[1]}")
            leave.join()
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stderr, "warning: no viewer .*it has gone")
        self.assertTrue((self.folder / "a.png").exists())

    def test_what_is_no_address_is_refused(self):
        self.write()
        for wrong in ("", ":14158", "a:0", "a:65536", "a:b", "a:1:2", "[::1", "[::1]x"):
            run = self.render("--display", wrong)
            self.assertEqual(run.returncode, 2, wrong)
            self.assertTrue(re.search("--display needs HOST:PORT", run.stderr), run.stderr)


if __name__ == "__main__":
    unittest.main()

"""`crt render` and `crt watch` send pictures to a viewer by `--display`. It must end with the
picture that the same run has written."""

import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import crt

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from viewer import Viewer

COMMAND = os.environ["CRT_COMMAND"]
SECONDS = 60
BALL = """Settings {
    width -> %d height -> %d supersampling -> %d
    background -> Background { color -> rgba(0.2, 0.4, 0.6, 0.5) }
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
Scene { for (i in range(0, 60)) {
    Sphere { center -> vec3(2 * sin(i), 2 * cos(2 * i), 0.05 * i) radius -> 0.4
             material -> Material { reflectivity -> 0.5 } } } }
"""


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

    # ---- crt watch

    def watch(self, port):
        """Watches the script until the test ends. What it says goes to the file `said`."""
        with open(self.folder / "said", "w", encoding="utf-8") as said:
            process = subprocess.Popen(
                [COMMAND, "watch", "a.crt", "-o", "a.exr", "--display", f"127.0.0.1:{port}"],
                cwd=self.folder, stderr=said,
            )
        self.addCleanup(process.wait, SECONDS)
        self.addCleanup(process.terminate)
        return process

    def wait_for(self, count, text):
        """Waits until `crt watch` has said something so many times."""
        end = time.monotonic() + SECONDS
        while (self.folder / "said").read_text().count(text) < count:
            self.assertLess(time.monotonic(), end, (self.folder / "said").read_text())
            time.sleep(0.02)

    def test_each_picture_that_is_watched_goes_to_the_viewer(self):
        self.write()
        viewer = Viewer()
        viewer.start()
        process = self.watch(viewer.port)
        self.wait_for(1, "pixels")
        np.testing.assert_array_equal(viewer.pictures["a.exr"], self.pixels("a.exr"))
        before = self.pixels("a.exr")
        (self.folder / "a.crt").write_text(BALL.replace("0.4", "0.5", 1) % (200, 150, 2))
        self.wait_for(2, "pixels")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(SECONDS), 0)
        viewer.join(SECONDS)
        self.assertIsNone(viewer.failure)
        np.testing.assert_array_equal(viewer.pictures["a.exr"], self.pixels("a.exr"))
        self.assertTrue((self.pixels("a.exr") != before).any())

    def test_a_viewer_may_be_started_while_a_script_is_watched(self):
        self.write()
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]
        self.watch(port)
        self.wait_for(1, "pixels")
        self.assertIn("warning: no viewer", (self.folder / "said").read_text())
        viewer = Viewer(port)
        viewer.start()
        self.write(210, 150)
        self.wait_for(2, "pixels")
        np.testing.assert_array_equal(viewer.pictures["a.exr"], self.pixels("a.exr"))


if __name__ == "__main__":
    unittest.main()

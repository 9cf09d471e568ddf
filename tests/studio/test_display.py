"""`crt studio --display` sends what the live view shows to a viewer, too."""

import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import crt
import numpy as np
from client import COMMAND, SECONDS, Client, Server

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from viewer import Viewer

SCENE = """Settings { width -> 160 height -> 120 supersampling -> %d }
Scene { Sphere { center -> vec3(0, 0, 3) radius -> %g } }
"""


class Display(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "a.crt").write_text(SCENE % (2, 1))

    def serve(self, viewer):
        server = Server(self.folder, "a.crt", [f"display=127.0.0.1:{viewer.port}"])
        self.addCleanup(server.end)
        client = Client(server)
        self.addCleanup(client.close)
        client.open("a.crt")
        return client

    def show(self, client, *numbers):
        """Renders a script. Returns the pixels of the picture that the page would save."""
        client.set_text(SCENE % numbers)
        client.finish()
        file = self.folder / "shown.exr"
        file.write_bytes(client.picture("exr"))
        with crt.Image.read(file) as image:
            return image.pixels.copy()

    def start(self):
        viewer = Viewer()
        viewer.start()
        return viewer, self.serve(viewer)

    def wait_for(self, viewer, pixels):
        end = time.monotonic() + SECONDS
        while not np.array_equal(viewer.pictures.get("a.crt"), pixels):
            self.assertLess(time.monotonic(), end)
            self.assertIsNone(viewer.failure)
            time.sleep(0.02)

    def test_the_viewer_shows_each_whole_picture(self):
        viewer, client = self.start()
        for numbers in ((2, 1), (3, 0.5), (2, 1)):
            self.wait_for(viewer, self.show(client, *numbers))

    def test_it_shows_pictures_in_progress(self):
        viewer, client = self.start()
        pixels = self.show(client, 64, 1)
        self.wait_for(viewer, pixels)
        self.assertGreater(viewer.incomplete, 0)

    def test_what_shows_no_colours_is_not_sent(self):
        viewer, client = self.start()
        pixels = self.show(client, 2, 1)
        self.wait_for(viewer, pixels)
        updates = viewer.updates
        client.send(type="view", view={"channel": "depth", "hidden": [], "section": None,
                                       "region": None, "t": 0})  # fmt: skip
        client.finish()
        client.send(type="view", view={"channel": "color", "hidden": [[0, 0]], "section": None,
                                       "region": None, "t": 0})  # fmt: skip
        client.finish()
        client.ask("hover")
        self.assertEqual(viewer.updates, updates)
        np.testing.assert_array_equal(viewer.pictures["a.crt"], pixels)

    def test_a_viewer_may_be_started_later(self):
        early = Viewer()
        early.server.close()
        client = self.serve(early)
        self.show(client, 2, 1)
        viewer = Viewer(early.port)
        viewer.start()
        self.wait_for(viewer, self.show(client, 3, 0.5))

    def test_what_is_no_address_is_refused(self):
        run = subprocess.run(
            [COMMAND, "studio", "--display", "a:b", self.folder],
            capture_output=True, text=True, timeout=SECONDS, check=False,
        )  # fmt: skip
        self.assertEqual(run.returncode, 2)
        self.assertIn("--display needs HOST:PORT", run.stderr)


if __name__ == "__main__":
    unittest.main()

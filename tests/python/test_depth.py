"""These tests run python -m crt.depth."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from support import SOURCE

import crt
from crt import depth

SCRIPT = """
Settings {
    width -> 40
    height -> 30
    camera -> Camera { position -> vec3(0, 0, -5) pointing -> vec3(0, 0, 0) fov -> 60 }
}
Scene {
    Box { cornerA -> vec3(-1, -1, -1) cornerB -> vec3(1, 1, 1) }
    Box { cornerA -> vec3(-9, 1, 3) cornerB -> vec3(9, 9, 4) }
}
"""


def run(*arguments: object) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", "crt.depth", *map(str, arguments)], capture_output=True, text=True
    )


class Depth(unittest.TestCase):
    def test_faces_across_the_view_have_one_depth(self):
        depths = depth.depth_map(crt.Scene.from_script(SCRIPT))
        self.assertEqual(depths.shape, (30, 40))
        np.testing.assert_allclose(depths[15, 20], 4, rtol=1e-14)
        np.testing.assert_allclose(depths[2, :], 8, rtol=1e-14)
        self.assertTrue(np.isinf(depths[29, :]).all())
        self.assertEqual(set(np.round(depths[np.isfinite(depths)], 9)), {4, 8})

    def test_near_is_white_far_is_dark_and_nothing_transparent(self):
        with tempfile.TemporaryDirectory() as folder:
            script, picture = pathlib.Path(folder) / "boxes.crt", pathlib.Path(folder) / "depth.png"
            script.write_text(SCRIPT)
            done = run(script, "-o", picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            pixels = crt.Image.read(picture).to_rgba8()
        self.assertEqual(pixels.shape, (30, 40, 4))
        self.assertEqual(tuple(pixels[15, 20]), (255, 255, 255, 255))
        self.assertEqual(tuple(pixels[2, 20]), (20, 20, 20, 255))
        self.assertEqual(pixels[29, 20, 3], 0)

    def test_floats_are_the_depth(self):
        with tempfile.TemporaryDirectory() as folder:
            script, picture = pathlib.Path(folder) / "boxes.crt", pathlib.Path(folder) / "depth.exr"
            script.write_text(SCRIPT)
            done = run(script, "-o", picture, "--width", 20, "--height", 16)
            self.assertEqual(done.returncode, 0, done.stderr)
            pixels = crt.Image.read(picture).pixels
        self.assertEqual(pixels.shape, (16, 20, 4))
        self.assertEqual((pixels[8, 10, 0], pixels[8, 10, 3], pixels[15, 10, 3]), (4, 1, 0))

    def test_a_wrong_script_is_told(self):
        done = run(SOURCE / "examples/c/wrong.crt")
        self.assertEqual(done.returncode, 1)
        self.assertIn("wrong.crt:3:38: error: unknown attribute 'raduis'", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

"""Dask works on a job, as the example shows."""

import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import SOURCE

import crt

SCRIPT = """Settings { width -> 40 height -> 30
  lights -> [PointLight { origin -> vec3(3, 5, -9) color -> rgb(1, 1, 1) }] }
Scene { Sphere { center -> vec3(t / 4, 0, 2) radius -> 0.7 } }
"""


@unittest.skipUnless(
    importlib.util.find_spec("distributed"),
    "SKIPPED: there is no dask.distributed (Debian: python3-distributed)",
)
class Dask(unittest.TestCase):
    def test_the_frames_of_a_cluster_have_the_bytes_of_one_render(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scene.crt").write_text(SCRIPT)
            program = SOURCE / "examples/python/farm_dask.py"
            done = subprocess.run(
                [sys.executable, program, "scene.crt", "--frames", "1", "3"],
                cwd=folder,
                capture_output=True,
                text=True,
                timeout=120,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("3 frames\nsheet.png shows them", done.stdout)
            for frame in range(1, 4):
                scene = crt.Scene.from_file(folder / "scene.crt", t=frame)
                expected = scene.render().encode("png", reproducible=True)
                self.assertEqual((folder / f"film_{frame:03}.png").read_bytes(), expected)
            sheet = crt.Image.read(folder / "sheet.png")
            self.assertEqual((sheet.pixels[:, :, 3] == 1).sum(), 3 * 40 * 30)

"""Type checkers find the types of the package, and mistakes by them. This needs mypy (Debian:
mypy)."""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import SOURCE

RIGHT = """
import numpy as np
import crt

ball = crt.Sphere(np.zeros(3), 1, material=crt.Material(color=(1, 0, 0), pattern=None), id=3)
scene = crt.Scene([ball - crt.Box((0, 0, 0), (1, 1, 1))], [crt.Light.point(origin=(0, 3, 0))])
scene.settings.width = 100
scene.camera.projection = crt.Projection.SPHERICAL
scene.lights[0].set(color=(1, 1, 1), falloff=2)
image: crt.Image = scene.render(progress=True, aovs=["depth"])
pixels = image.pixels[0, 0, :3].sum()
job: crt.Job = scene.prepare().start(progress=lambda fraction: fraction < 0.5)
width: int = job.wait().width

prepared = scene.prepare()
ray, rays = crt.ray((0, 0, -5), (0, 0, 1)), crt.rays((0, 0, 0), np.eye(3))
first: float = prepared.crossings(ray)["t"][0]
for crossings in (prepared.crossings(rays), prepared.crossings(np.zeros((3, 8)))):
    total: int = crossings.counts.sum()
distances, ids = prepared.distances(rays)
farthest: np.float64 = distances.max()
lengths = prepared.inside_lengths(rays) * np.linalg.norm(rays["direction"], axis=-1)
is_hit = ids != crt.NO_ENTITY

balls: list[crt.Sphere] = [crt.Sphere((0, 0, 0), np.float32(0.5), id=np.uint8(3))]
scene.entities = balls
scene.entities = (balls[0], crt.Empty())
scene.lights = (light for light in [crt.Light.spot(angle=np.float32(0.5))])
scene.entities.append(balls[0].scaled(np.float32(2)).moved((np.float32(1), 2, 3)))
scene.settings.set(width=np.int32(9), gamma=np.float32(2.2), precision="exact")
scene.settings.precision = "exact"
x: float = balls[0].center[0] + balls[0].radius
number: int | None = balls[0].id
"""

# Each line is a mistake, in which the checker has to name what stands behind it.
WRONG = """
import crt
crt.Sphere((0, 0, 0), "big")  # "Sphere"
crt.Sphere((0, 0, 0), 1, colour=1)  # "colour"
crt.Camera(fow=1)  # "fow"
crt.Material(color="red")  # "Material"
crt.Light.spot(type=1)  # "type"
crt.Settings(width=0.5)  # "Settings"
crt.Scene().camera.fow  # "fow"
crt.Scene().settings.width = "wide"  # "int"
crt.Scene().render(treads=1)  # "treads"
crt.Scene.from_file(1)  # "from_file"
crt.Sphere((0, 0, 0), 1).radius = 2  # "NoReturn"
crt.Sphere((0, 0, 0), 1).center.real  # "real"
crt.Scene().entities = [1]  # List item 0
crt.Scene().settings.set(precision="exakt")  # Literal
crt.Scene().prepare().occluded(crt.rays(1)).foo  # "foo"
crt.Scene().prepare().crossings(crt.rays(1)).foo  # "foo"
"""


@unittest.skipUnless(importlib.util.find_spec("mypy"), "there is no mypy (Debian: mypy)")
class Types(unittest.TestCase):
    def check(self, *what: object) -> list[str]:
        with tempfile.TemporaryDirectory() as cache:
            done = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--no-error-summary"]
                + ["--cache-dir", cache, *map(str, what)],
                env={name: value for name, value in os.environ.items() if name != "LD_PRELOAD"},
                capture_output=True,
                text=True,
            )
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()

    def test_the_package_and_its_users_are_right_and_mistakes_are_found(self):
        expected = [line.rsplit("# ", 1) for line in WRONG.splitlines()]
        with tempfile.TemporaryDirectory() as folder:
            right, wrong = Path(folder) / "right.py", Path(folder) / "wrong.py"
            right.write_text(RIGHT)
            wrong.write_text(WRONG)
            golf = SOURCE / "examples/python/golf.py"
            found = self.check(SOURCE / "python/crt", golf, right, wrong)
        for number, parts in enumerate(expected, 1):
            errors = [line for line in found if f"wrong.py:{number}: error" in line]
            if len(parts) == 2:
                self.assertTrue(any(parts[1] in error for error in errors), (parts, found))
        others = [line for line in found if ": error" in line and "wrong.py" not in line]
        self.assertEqual(others, [])

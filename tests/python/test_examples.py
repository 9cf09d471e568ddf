"""These tests run the example programs in Python."""

import sys
import unittest

import numpy as np
from support import SOURCE

sys.path.insert(0, str(SOURCE / "examples/python"))
import golf  # noqa: E402


class Golf(unittest.TestCase):
    def test_the_balls_dimples_are_spread_evenly(self):
        points = golf.fibonacci_sphere(336)
        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1, rtol=1e-14)
        distances = np.linalg.norm(points[:, None] - points, axis=2) + 9 * np.eye(336)
        self.assertGreater(distances.min(), 0.15)
        self.assertLess(distances.min(axis=1).max(), 0.25)

    def test_there_is_a_picture_of_it(self):
        scene = golf.scene.copy()
        scene.settings.set(width=60, height=60, supersampling=1)
        pixels = scene.render().pixels
        white, red, sky = pixels[22, 27], pixels[48, 30], pixels[2, 5]
        self.assertGreater(white[:3].min(), 0.3)
        self.assertGreater(red[0], 3 * red[1])
        self.assertGreater(sky[2], sky[0])

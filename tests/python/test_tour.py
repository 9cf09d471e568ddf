"""What docs/bindings.md shows of Python, piece by piece."""

import contextlib
import io
import unittest

import numpy as np

import crt

MATERIAL = crt.Material(color=(0.7, 0.1, 0.1), specular=0.4)


class Tour(unittest.TestCase):
    def test_a_scene_is_changed_in_place(self):
        scene = crt.Scene([crt.Sphere((0, 0, 0), 1)], [crt.Light.point(origin=(-3, 4, -5))])
        scene.settings.width = 80
        scene.settings.height = 60
        scene.camera.position = (0, 1, -5)
        scene.lights[0].color = (1, 0.9, 0.8)
        scene.entities.append(crt.Box((-3, -2, -3), (3, -1, 3), material=MATERIAL))
        with contextlib.redirect_stderr(io.StringIO()):
            image = scene.render(progress=True)
        self.assertEqual((image.width, image.height), (80, 60))
        pixels = np.asarray(image)
        self.assertEqual(pixels.shape, (60, 80, 4))
        self.assertGreater(pixels[50, 40, 0], 2 * pixels[50, 40, 1])

    def test_crossings_of_many_rays(self):
        part = crt.Box((0, 0, 0), (4, 1, 1)) - crt.Cylinder((2, 0.5, -1), (2, 0.5, 2), 0.25)
        rays = crt.rays([(-1, 0.1 + 0.2 * i, 0.5) for i in range(6)], (1, 0, 0))
        prepared = crt.Scene([part]).prepare()
        hits, offsets = prepared.crossings(rays)
        thickness = prepared.inside_lengths(rays)
        self.assertEqual(list(np.diff(offsets)), [2, 4, 4, 4, 2, 0])
        self.assertEqual(len(hits), 16)
        hole = np.sqrt(0.25**2 - 0.2**2)
        expected = [4, 4 - 2 * hole, 3.5, 4 - 2 * hole, 4, 0]
        np.testing.assert_allclose(thickness, expected, rtol=1e-12)

    def test_parts_of_an_entity(self):
        rays = crt.rays([(x, 0, 0.5) for x in (0.1, 0.35, 0.6, 0.7)], (1, 0, 0.4))
        plate = crt.Box((-2, -2, 0), (2, 2, 1), id=1)
        drill = crt.Cylinder((0, 0, -1), (0, 0, 2), 0.5, id=2)
        parts = crt.Scene([plate - drill]).prepare().hit_parts(rays)
        in_hole = parts["part_id"] == 2
        self.assertEqual(list(in_hole), [True, True, False, False])
        self.assertEqual(list(parts["face"]), [0, 0, 5, 5])

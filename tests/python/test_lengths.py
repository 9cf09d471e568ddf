"""These tests measure how much of rays is inside of solids."""

import unittest

import numpy as np
from support import INFINITY, parallel_rays, prepared_shell

import crt


def lengths(entities, rays):
    return crt.Scene(entities).prepare().inside_lengths(rays)


def along_x(x: float = -9, **limits: float) -> np.ndarray:
    return crt.ray((x, 0, 0), (1, 0, 0), **limits)


class Lengths(unittest.TestCase):
    ball, box = crt.Sphere((0, 0, 0), 1), crt.Box((0, -2, -2), (4, 2, 2))

    def test_a_ray_that_misses_has_none(self):
        rays = parallel_rays(61)
        found = prepared_shell().inside_lengths(rays)
        x = rays["origin"][:, 0]
        outer, inner = (2 * np.sqrt(np.maximum(r * r - x * x, 0)) for r in (1, 0.5))
        np.testing.assert_allclose(found, outer - inner, rtol=1e-12)
        self.assertEqual((found[0], found[-1], found.dtype), (0, 0, np.float64))
        self.assertEqual(lengths([self.ball], rays[:5]).tolist(), [0] * 5)
        self.assertEqual(lengths([], rays[:0]).shape, (0,))

    def test_a_ray_may_begin_and_end_inside(self):
        for limits, expected in (
            ({}, 2),
            ({"t_min": 8.5}, 1.5),
            ({"t_max": 8.5}, 0.5),
            ({"t_min": 8.5, "t_max": 9}, 0.5),  # which crosses nothing
            ({"t_min": 11}, 0),
            ({"t_min": 9, "t_max": 8}, 0),
            ({"t_min": -INFINITY}, 2),
        ):
            found = lengths([self.ball], along_x(**limits))
            self.assertAlmostEqual(found, expected, 12, limits)
        self.assertEqual(lengths([self.ball], along_x(0.5)), 0.5)
        self.assertEqual(lengths([crt.Plane((-1, 0, 0), (3, 0, 0))], along_x(0)), INFINITY)
        self.assertEqual(lengths([crt.Plane((1, 0, 0), (3, 0, 0))], along_x(0)), 3)

    def test_where_entities_overlap_it_counts_once(self):
        self.assertEqual(lengths([self.ball, self.box], along_x()), 5)
        self.assertEqual(lengths([self.ball, self.box, self.ball], along_x(0.25)), 3.75)
        both = [self.ball.with_id(3), self.box.with_id(3)]  # of which no hit says which it is
        self.assertEqual(lengths(both, along_x(0.5)), 3.5)
        open_ends = [crt.Plane((-1, 0, 0), (3, 0, 0)), self.ball]
        self.assertEqual(lengths(open_ends, along_x(0.5, t_max=4)), 0.5 + 1.5)

    def test_they_have_the_shape_of_the_rays(self):
        rays = parallel_rays(60).reshape(3, 20)
        prepared = prepared_shell()
        found = prepared.inside_lengths(rays)
        np.testing.assert_array_equal(found.ravel(), prepared.inside_lengths(rays.ravel()))
        alone = [prepared.inside_lengths(ray) for ray in rays.ravel()]
        np.testing.assert_allclose(found.ravel(), alone, rtol=1e-14)
        table = rays.ravel().view(np.float64).reshape(60, 8)
        np.testing.assert_array_equal(prepared.inside_lengths(table), found.ravel())

    def test_they_agree_with_points_along_the_rays(self):
        random = np.random.default_rng(7)
        centers, radii = random.normal(size=(20, 3)), random.uniform(0.2, 1, 20)
        entities = [crt.Sphere(center, radius) for center, radius in zip(centers, radii)]
        rays = crt.rays(random.normal(size=(40, 3)), random.normal(size=(40, 3)), 0, 3)
        steps = (np.arange(20000) + 0.5) / 20000 * 3
        for ray, found in zip(rays, lengths(entities, rays)):
            points = ray["origin"] + steps[:, None, None] * ray["direction"]
            inside = (np.linalg.norm(points - centers, axis=2) < radii).any(axis=1)
            self.assertAlmostEqual(found, 3 * inside.mean(), delta=2e-3)

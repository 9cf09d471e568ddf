"""A program computes a solid by itself."""

import gc
import threading
import unittest

import numpy as np
from support import small_scene

import crt
from crt.custom import _Functions


def ball(origin, direction, t_min, t_max):
    middle = -np.dot(origin, direction)
    square = 1 - np.dot(origin, origin) + middle**2
    return [middle - square**0.5, middle + square**0.5] if square > 0 else []


class Customs(unittest.TestCase):
    def test_a_ball_is_where_a_sphere_would_be(self):
        entity = crt.Custom((-1, -1, -1), (1, 1, 1), ball, lambda position, face: position)
        self.assertTrue(entity.is_solid)
        origins = np.random.default_rng(1).uniform(-1, 1, (200, 3)) - (0, 0, 3)
        rays = crt.rays(origins, (0.1, 0.2, 1))
        cutter = crt.Box((0, -2, -2), (2, 2, 2))
        ours = crt.Scene([entity - cutter]).prepare().intersect(rays)
        theirs = crt.Scene([crt.Sphere((0, 0, 0), 1) - cutter]).prepare().intersect(rays)
        np.testing.assert_allclose(ours["t"], theirs["t"], atol=1e-9)
        np.testing.assert_allclose(ours["normal"], theirs["normal"], atol=1e-9)
        self.assertGreater(np.isfinite(ours["t"]).sum(), 20)

    def test_faces_errors_and_uv_are_handed_over(self):
        def slab(origin, direction, t_min, t_max):
            first, last = sorted(((end - origin[2]) / direction[2], end) for end in (0, 1))
            return [(*first, 1e-12), last]

        def normal(position, face):
            return (0, 0, 2 * face - 1), (position[0], 0.75)

        entity = crt.Custom((-5, -5, 0), (5, 5, 1), slab, normal, faces=2, name="slab", id=9)
        prepared = crt.Scene([entity]).prepare()
        rays = crt.rays([(0.5, 0, -3), (0.25, 0, 3)], [(0, 0, 1), (0, 0, -1)])
        parts = prepared.hit_parts(rays)
        self.assertEqual(parts["face"].tolist(), [0, 1])
        self.assertEqual(parts["part_id"].tolist(), [9, 9])
        hits = prepared.intersect(rays)
        self.assertEqual(hits["t"].tolist(), [3, 2])
        self.assertEqual(hits["u"].tolist(), [0.5, 0.25])
        self.assertEqual(hits["v"].tolist(), [0.75, 0.75])
        self.assertEqual(hits["normal"][:, 2].tolist(), [-1, 1])

    def test_what_a_function_raises_comes_out_of_the_call(self):
        def broken(origin, direction, t_min, t_max):
            raise KeyError("ours")

        entity = crt.Custom((-1, -1, -1), (1, 1, 1), broken, lambda position, face: position)
        scene = small_scene()
        scene.entities = [entity]
        with self.assertRaisesRegex(KeyError, "ours"):
            scene.prepare().intersect(crt.ray((0, 0, -5), (0, 0, 1)))
        with self.assertRaisesRegex(KeyError, "ours"):
            scene.render()
        with self.assertRaisesRegex(KeyError, "ours"):
            scene.prepare().start().wait()

    def test_wrong_answers_and_arguments_are_errors(self):
        def asked(crossings, normal=lambda position, face: position, **others):
            entity = crt.Custom((-1, -1, -1), (1, 1, 1), crossings, normal, name="egg", **others)
            return crt.Scene([entity]).prepare().intersect(crt.ray((0, 0, -5), (0, 0, 1)))

        with self.assertRaisesRegex(crt.Error, "egg: there are 1 crossings, an odd number"):
            asked(lambda *_: [0.5])
        with self.assertRaisesRegex(crt.Error, "egg: there cannot be 65537 crossings"):
            asked(lambda *_: iter(lambda: 0.5, None))
        with self.assertRaisesRegex(crt.Error, "egg: the normal of face 0"):
            asked(ball, lambda position, face: (0, 0, 0))
        with self.assertRaises(ValueError):
            asked(ball, lambda position, face: (1, 2))
        with self.assertRaises(TypeError):
            asked(lambda *_: [None, None])
        with self.assertRaisesRegex(crt.Error, "Custom: egg: there must be 1 to 65536 faces"):
            asked(ball, faces=0)
        with self.assertRaisesRegex(TypeError, "Custom: crossings"):
            asked(7)

    def test_functions_live_as_long_as_anything_uses_them(self):
        gc.collect()
        before = len(_Functions._alive)
        entity = crt.Custom((-1, -1, -1), (1, 1, 1), ball, lambda position, face: position)
        prepared = crt.Scene([entity]).prepare()
        del entity
        gc.collect()
        hits: list[float] = []
        thread = threading.Thread(
            target=lambda: hits.append(
                float(prepared.intersect(crt.ray((0, 0, -5), (0, 0, 1)))["t"])
            )
        )
        thread.start()
        thread.join()
        self.assertEqual(hits, [4])
        del prepared, thread
        gc.collect()
        self.assertEqual(len(_Functions._alive), before)


if __name__ == "__main__":
    unittest.main()

"""These tests use several threads at once, as the library runs without Python's lock."""

import concurrent.futures
import threading
import unittest

import numpy as np
from support import parallel_rays, prepared_shell, small_scene

import crt


def at_once(*functions):
    """Runs all of them together, and returns their results."""
    barrier = threading.Barrier(len(functions))

    def run(function):
        barrier.wait()
        return function()

    with concurrent.futures.ThreadPoolExecutor(len(functions)) as pool:
        return list(pool.map(run, functions))


class Threads(unittest.TestCase):
    def test_many_ask_one_scene(self):
        prepared = prepared_shell()
        rays = parallel_rays(20000)
        expected = prepared.intersect(rays)
        for hits in at_once(*[lambda: prepared.intersect(rays)] * 4):
            np.testing.assert_array_equal(hits, expected)

    def test_many_render_one_scene(self):
        prepared = small_scene(64).prepare()
        first, *others = at_once(*[lambda: prepared.render().pixels] * 4)
        for pixels in others:
            np.testing.assert_array_equal(pixels, first)

    def test_each_gets_its_own_error(self):
        def message(radius):
            try:
                for _ in range(300):
                    crt.Sphere((0, 0, 0), 1).scaled(1.5)
                crt.Sphere((0, 0, 0), radius)
            except crt.Error as error:
                return str(error)

        messages = at_once(*[lambda r=r: message(r) for r in (-1.0, -2.0, -3.0, -4.0)])
        self.assertEqual(len(messages), 4)
        self.assertTrue(all("radius" in message for message in messages))

    def test_closing_pulls_nothing_from_under_another(self):
        rays = parallel_rays(20000)
        for _ in range(20):
            prepared = prepared_shell()

            def ask():
                try:
                    return np.isfinite(prepared.intersect(rays)["t"]).sum()
                except ValueError:  # it was closed before
                    return None

            counts = at_once(ask, ask, prepared.close)[:2]
            self.assertLessEqual(
                set(counts), {None, np.isfinite(prepared_shell().intersect(rays)["t"]).sum()}
            )

    def test_a_scene_may_be_put_together_by_several(self):
        scene = crt.Scene()

        def add():
            for _ in range(500):
                scene.add(crt.Sphere((0, 0, 0), 1))

        at_once(add, add, add, add)
        self.assertEqual(len(scene.entities), 2000)

    def test_a_callback_of_one_runs_while_another_renders(self):
        prepared = small_scene(100).prepare()

        def render():
            shares = []
            prepared.render(progress=shares.append)
            return shares[0], shares[-1]

        self.assertEqual(at_once(render, render, render), [(0, 1)] * 3)

    def test_a_job_is_watched_from_several(self):
        job = small_scene(100).prepare().start()
        images = at_once(job.wait, job.wait, job.snapshot)
        np.testing.assert_array_equal(images[0].pixels, images[1].pixels)

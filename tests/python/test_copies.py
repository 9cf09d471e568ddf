"""These tests copy, compare and pickle."""

import concurrent.futures
import copy
import multiprocessing
import pickle
import unittest

import numpy as np
from support import small_scene

import crt

VALUES = [
    crt.Camera(position=(1, 2, 3), projection=crt.Projection.SPHERICAL),
    crt.Material(color=(1, 0, 0), pattern=crt.Pattern.wood(scale=3), bump=crt.Pattern.noise()),
    crt.PrincipledMaterial(metallic=1, roughness_map=crt.Pattern.noise(), emission=(1, 2, 3)),
    crt.Light.spot(origin=(0, 3, 0), angle=0.5),
    crt.Background.gradient(sky=(0, 0, 1)),
    crt.Settings(width=7, title="Größe", author=None, seed=2**64 - 1),
    crt.Pattern.marble(turbulence=2),
    small_scene(8).render().stats,
    crt.Expression("rgb(1, 0, 0)"),
]


def wrong_script(_: int) -> None:
    """Runs a script that fails, in another process."""
    crt.Scene.from_script("Scene { Sphere { } }")


class Values(unittest.TestCase):
    def test_they_are_equal_if_their_fields_are(self):
        self.assertEqual(crt.Camera(), crt.Camera())
        self.assertNotEqual(crt.Camera(), crt.Camera(roll=1))
        self.assertNotEqual(crt.Camera(), crt.Light())
        self.assertNotEqual(crt.Camera(), None)

    def test_they_are_copied_and_pickled(self):
        for value in VALUES:
            for twin in (
                copy.copy(value),
                copy.deepcopy(value),
                pickle.loads(pickle.dumps(value)),
            ):
                self.assertIs(type(twin), type(value))
                self.assertEqual(twin, value)
                self.assertIsNot(twin, value)

    def test_a_copy_goes_its_own_way(self):
        material = crt.Material(pattern=crt.Pattern.wood(scale=3))
        shallow, deep = copy.copy(material), copy.deepcopy(material)
        shallow.color = deep.color = (0, 0, 1)
        self.assertEqual(material.color, (0.5, 0.5, 0.5))
        self.assertIs(shallow.pattern, material.pattern)
        deep.pattern.scale = 5
        self.assertEqual(material.pattern.scale, 3)


class Handles(unittest.TestCase):
    def test_copies_of_what_never_changes_share_it_and_are_closed_by_themselves(self):
        ball = crt.Sphere((0, 0, 0), 1)
        prepared = crt.Scene([ball]).prepare()
        image = small_scene(8).render()
        for thing, use in (
            (ball, lambda twin: twin.moved((1, 0, 0))),
            (prepared, lambda twin: twin.occluded(crt.ray((0, 0, -5), (0, 0, 1)))),
            (image, lambda twin: twin.pixels),
        ):
            for twin in (copy.copy(thing), copy.deepcopy(thing)):
                self.assertIs(type(twin), type(thing))
                thing_name = repr(thing)
                self.assertEqual(repr(twin), thing_name)
                thing.close()
                use(twin)
                thing = twin

    def test_a_copy_of_a_scene_goes_its_own_way(self):
        scene = small_scene()
        for twin in (copy.copy(scene), copy.deepcopy({"scene": scene})["scene"]):
            twin.settings.width = 5
            twin.entities.clear()
            self.assertEqual((scene.settings.width, len(scene.entities)), (48, 1))

    def test_a_job_cannot_be_copied(self):
        with small_scene(8).prepare().start() as job:
            with self.assertRaisesRegex(TypeError, "a Job cannot be copied: "):
                copy.copy(job)

    def test_pickling_says_why_not_and_what_to_do(self):
        scene = small_scene(8)
        prepared = scene.prepare()
        image = prepared.render()
        things = {
            "an Entity": scene.entities[0],
            "a Sphere": crt.Sphere((0, 0, 0), 1),
            "a Scene": scene,
            "a Prepared": prepared,
            "an Image": image,
            "a Job": prepared.start(),
        }
        for name, thing in things.items():
            with self.assertRaisesRegex(TypeError, f"^{name} lives in .* cannot be pickled: "):
                pickle.dumps(thing)
        with self.assertRaisesRegex(TypeError, "an Image lives in"):
            pickle.dumps(crt.Pattern.of_image(image))
        pixels = pickle.loads(pickle.dumps(image.pixels))
        np.testing.assert_array_equal(crt.Image.from_pixels(pixels).pixels, image.pixels)


class Errors(unittest.TestCase):
    def test_they_come_out_of_other_processes(self):
        context = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(1, context) as pool:
            with self.assertRaises(crt.ScriptError) as caught:
                pool.submit(wrong_script, 0).result()
        self.assertEqual(caught.exception.status, crt.Status.SCRIPT)
        self.assertEqual(caught.exception.diagnostics[0].line, 1)
        error = pickle.loads(pickle.dumps(crt.Error(crt.Status.IO, "gone")))
        self.assertEqual((error.status, str(error)), (crt.Status.IO, "gone"))

"""A scene's camera, background, settings, entities and lights are plain objects, and what changes
in them changes the scene."""

import math
import os
import pathlib
import tempfile
import threading
import unittest

import numpy as np
from support import small_scene

import crt

SCRIPT = """
Settings { width -> 12 height -> 8 }
Scene {
    Sphere { center -> vec3(0, 0, 0) radius -> 1 }
    Box { cornerA -> vec3(1, 0, 0) cornerB -> vec3(2, 1, 1) }
}
"""


def hits_along_x(scene: crt.Scene) -> list[float]:
    return list(scene.prepare().crossings(crt.ray((-10, 0.25, 0.25), (1, 0, 0)))["entity_id"])


class Edits(unittest.TestCase):
    def test_a_scene_is_prepared_from_what_another_was(self):
        parts = [crt.Sphere((x, 0, 0), 0.75) for x in range(100)]
        before = crt.Scene(parts).prepare()
        parts[40] = parts[40].moved((0, 0.5, 0))
        del parts[7]
        rays = np.zeros(400, crt.RAY)
        rays["origin"] = [(0.25 * i, 0.3, -9) for i in range(400)]
        rays["direction"] = (0, 0, 1)
        rays["t_max"] = np.inf
        after = crt.Scene(parts).prepare(previous=before)
        anew = crt.Scene(parts).prepare()
        self.assertEqual(after.trace(rays).tobytes(), anew.trace(rays).tobytes())
        self.assertNotEqual(after.trace(rays).tobytes(), before.trace(rays).tobytes())


class Saving(unittest.TestCase):
    def test_a_saved_scene_is_read_as_the_same(self):
        image = crt.Image.from_pixels(np.random.default_rng(1).random((4, 4, 4), np.float32))
        scene = small_scene(48)
        scene.add(crt.Mesh([(0, 0, -3), (1, 0, -3), (0, 1, -3)], [(0, 1, 2)]).with_id(7))
        scene.background = crt.Background(type="spherical", image=image)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scène.crt")
            scene.save_script(path)
            self.assertEqual(len(os.listdir(folder)), 3)
            again = crt.Scene.from_file(path)
        self.assertEqual(len(again.entities), len(scene.entities))
        np.testing.assert_array_equal(again.render(), scene.render())

    def test_what_no_script_has_is_an_error_and_nothing_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = crt.Scene(settings=crt.Settings(seed=2**63))
            with self.assertRaisesRegex(crt.Error, "a seed of 2\\^63"):
                scene.save_script(pathlib.Path(folder, "a.crt"))
            self.assertEqual(os.listdir(folder), [])


class Values(unittest.TestCase):
    def test_what_is_assigned_to_a_field_holds(self):
        for scene in (crt.Scene(), crt.Scene.from_script(SCRIPT)):
            scene.settings.width = 100
            scene.settings.height = 50
            scene.camera.fov = 0.5
            scene.camera.position = (0, 0, -20)
            scene.background.set(color=(0.25, 0.5, 0.75), alpha=1)
            self.assertEqual((scene.settings.width, scene.camera.fov), (100, 0.5))
            image = scene.render()
            self.assertEqual((image.width, image.height), (100, 50))
            self.assertEqual(tuple(image.pixels[0, 0, :3]), (0.25, 0.5, 0.75))

    def test_a_field_of_the_camera_changes_what_is_seen(self):
        scene = small_scene(48)
        self.assertLess(np.asarray(scene.render())[15, 24, 0], 1)
        scene.camera.position = (0, 0, -40)
        self.assertEqual(np.asarray(scene.render())[15, 24, 0], 1)

    def test_what_is_assigned_is_the_object_itself(self):
        camera, settings = crt.Camera(fov=1), crt.Settings(width=9, height=7)
        scene = crt.Scene(camera=camera)
        scene.settings = settings
        self.assertIs(scene.camera, camera)
        self.assertIs(scene.settings, settings)
        settings.width = 5
        self.assertEqual(scene.render().width, 5)

    def test_a_value_that_cannot_be_is_an_error_when_it_is_assigned_or_at_the_latest_used(self):
        scene = crt.Scene()
        with self.assertRaisesRegex(crt.Error, "Scene: camera: fov must be at most"):
            scene.camera = crt.Camera(fov=4)
        scene.camera.fov = 4
        for use in (scene.prepare, scene.render, scene.copy):
            with self.assertRaisesRegex(crt.Error, "Scene: camera: fov must be at most"):
                use()
        scene.camera.fov = 1
        self.assertEqual(scene.prepare().intersect(crt.ray((0, 0, 0), (0, 0, 1)))["t"], math.inf)

    def test_what_is_prepared_stays_as_it_was(self):
        scene = small_scene(16)
        prepared = scene.prepare()
        scene.settings.width = 32
        scene.entities.clear()
        self.assertEqual(prepared.render().width, 16)
        self.assertTrue(prepared.occluded(crt.ray((0, 0, -5), (0, 0, 1))))

    def test_thousands_are_ready_at_a_time(self):
        count, ray = 3000, crt.ray((0, 0, 0), (1, 0, 0))
        ready = [crt.Scene([crt.Sphere((10 + i, 0, 0), 1)]).prepare() for i in range(count)]
        distances = [float(one.distances(ray)[0]) for one in ready]
        self.assertEqual(distances, [9 + i for i in range(count)])

    def test_a_closed_scene_says_so(self):
        scene = crt.Scene()
        scene.close()
        for use in (lambda: scene.settings, lambda: scene.entities, lambda: scene.lights):
            with self.assertRaisesRegex(ValueError, "this Scene is closed"):
                use()


class Lists(unittest.TestCase):
    def test_entities_come_and_go_as_in_any_list(self):
        ball, box = crt.Sphere((0, 0, 0), 1), crt.Box((2, 0, 0), (3, 1, 1))
        scene = crt.Scene()
        self.assertEqual(hits_along_x(scene), [])
        scene.entities.append(ball)
        self.assertEqual(hits_along_x(scene), [0, 0])
        scene.entities += [box]
        self.assertEqual(hits_along_x(scene), [0, 0, 1, 1])
        scene.entities.reverse()
        self.assertEqual(hits_along_x(scene), [1, 1, 0, 0])
        del scene.entities[0]
        self.assertIs(scene.entities[0], ball)
        self.assertEqual(hits_along_x(scene), [0, 0])
        scene.entities = (box, ball, crt.Sphere((6, 0, 0), 1))
        self.assertEqual(hits_along_x(scene), [1, 1, 0, 0, 2, 2])
        scene.entities[1] = crt.Empty()
        self.assertEqual(hits_along_x(scene), [0, 0, 2, 2])

    def test_those_of_a_script_too(self):
        scene = crt.Scene.from_script(SCRIPT)
        self.assertEqual(hits_along_x(scene), [0, 0, 1, 1])
        scene.entities.pop(0)
        scene.entities.append(crt.Sphere((0, 0, 0), 0.5))
        self.assertEqual(hits_along_x(scene), [1, 1, 0, 0])

    def test_lights_and_their_fields(self):
        scene = small_scene(24)
        lit = np.asarray(scene.render())[12, 12, 0]
        scene.lights[0].color = (0.5, 0.5, 0.5)
        self.assertAlmostEqual(np.asarray(scene.render())[12, 12, 0], lit / 2, 5)
        scene.lights.append(crt.Light.point(origin=(-3, 4, -5)))
        self.assertAlmostEqual(np.asarray(scene.render())[12, 12, 0], 1.5 * lit, 5)
        scene.settings.no_head_light = 1
        scene.lights = []
        self.assertEqual(np.asarray(scene.render())[12, 12, 0], 0)
        scene.add(crt.Light.point(origin=(-3, 4, -5)))
        self.assertAlmostEqual(np.asarray(scene.render())[12, 12, 0], lit, 5)

    def test_a_wrong_thing_in_a_list_is_named(self):
        scene = crt.Scene([crt.Sphere((0, 0, 0), 1)])
        scene.entities.append("ball")
        with self.assertRaisesRegex(TypeError, r"Scene: entities\[1\] must be an Entity, not 'b"):
            scene.prepare()
        scene.entities.pop()
        scene.lights.append(crt.Light.cylinder(radius=-1))
        with self.assertRaisesRegex(crt.Error, r"Scene: lights\[0\].*radius"):
            scene.prepare()
        for wrong in (crt.Sphere((0, 0, 0), 1), "ball", 3):
            with self.assertRaisesRegex(TypeError, "Scene: entities must be a list of entities"):
                scene.entities = wrong

    def test_an_entity_that_was_added_may_be_closed(self):
        scene = crt.Scene()
        with crt.Sphere((0, 0, 0), 1) as ball:
            scene.add(ball)
        self.assertEqual(hits_along_x(scene), [0, 0])
        scene.entities.insert(0, crt.Sphere((5, 0, 0), 1))
        self.assertEqual(hits_along_x(scene), [1, 1, 0, 0])

    def test_copies_share_no_list_and_no_value(self):
        scene = small_scene()
        copy = scene.copy()
        copy.entities.append(crt.Empty())
        copy.lights.clear()
        copy.settings.width = copy.camera.fov = 1
        self.assertEqual((len(scene.entities), len(scene.lights)), (1, 1))
        self.assertEqual((scene.settings.width, scene.camera.fov), (48, math.pi / 3))
        self.assertIs(copy.entities[0], scene.entities[0])

    def test_preparing_again_while_another_thread_adds(self):
        scene = crt.Scene()

        def add():
            for place in range(200):
                scene.entities.append(crt.Sphere((3 * place, 0, 0), 1))

        thread = threading.Thread(target=add)
        thread.start()
        while thread.is_alive():
            scene.prepare()
        thread.join()
        self.assertEqual(len(hits_along_x(scene)), 400)

"""These tests check materials, lights, cameras, backgrounds and settings."""

import copy
import inspect
import math
import unittest

import numpy as np

import crt


class Values(unittest.TestCase):
    def test_what_is_not_given_has_the_librarys_default(self):
        self.assertEqual(crt.Camera().fov, math.pi / 3)
        self.assertEqual(crt.Settings().width, 640)
        self.assertEqual(crt.Material().color, (0.5, 0.5, 0.5))
        self.assertEqual(crt.Light.parallel().origin, (0, 1, 0))
        self.assertNotEqual(crt.Pattern.wood().color_a, crt.Pattern.checker().color_a)

    def test_a_sky_is_a_background_that_comes_back(self):
        scene = crt.Scene(background=crt.Background.daylight(sun=(1, 0.5, 0), turbidity=4))
        sky = scene.copy().background
        self.assertEqual(sky.type, crt.BackgroundType.SKY)
        self.assertEqual(tuple(sky.sun), (1, 0.5, 0))
        self.assertEqual((sky.turbidity, sky.scale, sky.shines), (4, 1, 1))
        with self.assertRaisesRegex(crt.Error, "turbidity"):
            scene.background = crt.Background.daylight(turbidity=1)

    def test_panoramas_are_spherical_cylindrical_or_of_equal_area(self):
        image = crt.Image.from_pixels(np.ones((2, 1, 4), np.float32))
        kinds = [crt.Background.panorama(image).type]
        kinds.append(crt.Background.panorama(image, cylindrical=True).type)
        kinds.append(crt.Background.panorama(image, equal_area=True).type)
        spherical, cylindrical, equal_area = 2, 3, 4
        self.assertEqual(kinds, [spherical, cylindrical, equal_area])
        with self.assertRaises(ValueError):
            crt.Background.panorama(image, cylindrical=True, equal_area=True)
        scene = crt.Scene(background=crt.Background.panorama(image, equal_area=True))
        self.assertEqual(scene.background.type, crt.BackgroundType.EQUAL_AREA)

    def test_8_bit_values_of_2015_are_cut(self):
        scene = crt.Scene(background=crt.Background(color=(0.999, 0.5, 1)))
        for compat, expected in ((0, [255, 128, 255, 255]), (2015, [254, 127, 255, 255])):
            scene.settings = crt.Settings(width=1, height=1, gamma=1, compat=compat)
            self.assertEqual(scene.settings.compat, compat)
            self.assertEqual(scene.render().to_rgba8()[0, 0].tolist(), expected)
        with self.assertRaisesRegex(crt.Error, "compat"):
            scene.settings = crt.Settings(compat=2014)

    def test_a_pattern_has_many_colours_and_patterns_in_it(self):
        stops = [(0, (1, 0, 0)), (1, np.array([0, 0, 1]), 0.5)]
        pattern = crt.Pattern.gradient(colors=stops)
        self.assertEqual(pattern.colors, ((0, (1, 0, 0), 1), (1, (0, 0, 1), 0.5)))
        self.assertEqual(pattern.color_count, 2)
        self.assertEqual(copy.deepcopy(pattern), pattern)
        floor = crt.Box((0, 0, 0), (1, 1, 1), material=crt.Material(pattern=pattern))
        self.assertEqual(len(crt.Scene(entities=[floor]).entities), 1)
        pattern.colors = [(1, (0, 0, 0)), (0, (1, 1, 1))]
        with self.assertRaisesRegex(crt.Error, "colors"):
            crt.Box((0, 0, 0), (1, 1, 1), material=crt.Material(pattern=pattern))
        pattern.colors = None
        self.assertEqual((pattern.colors, pattern.color_count), (None, 0))
        with self.assertRaisesRegex(AttributeError, "color_count"):
            pattern.color_count = 64
        with self.assertRaisesRegex(TypeError, r"colors\[0\] must be \(position, color\)"):
            crt.Pattern.noise(colors=[0.5])
        both = crt.Pattern.checker(pattern_a=crt.Pattern.wood(), pattern_b=pattern)
        self.assertEqual(both.pattern_b, pattern)
        with self.assertRaisesRegex(TypeError, "pattern_a must be a Pattern"):
            crt.Pattern.checker(pattern_a=crt.Camera())

    def test_keyword_arguments_and_attributes_change_fields(self):
        camera = crt.Camera(position=np.array([1.0, 2.0, 3.0]), fov=1)
        camera.roll = 0.5
        self.assertEqual((camera.position, camera.fov, camera.roll), ((1, 2, 3), 1, 0.5))

    def test_what_no_field_can_hold_is_refused(self):
        with self.assertRaisesRegex(AttributeError, "has no 'colour'; it has .*color"):
            crt.Material(colour=(1, 0, 0))
        with self.assertRaises(AttributeError):
            crt.Camera().fow = 1
        with self.assertRaises(OverflowError):
            crt.Settings(width=2**32 + 640)
        with self.assertRaises(TypeError):
            crt.Settings(width=640.5)
        with self.assertRaises(ValueError):
            crt.Camera(position=(1, 2))
        with self.assertRaises(TypeError):
            crt.Material(pattern="wood")
        with self.assertRaises(ValueError):
            crt.Settings(title="cut\0off")

    def test_one_thing_is_not_taken_for_another(self):
        ball = crt.Sphere((0, 0, 0), 1)
        image = crt.Image.from_pixels(np.zeros((1, 1, 4), np.float32))
        scene = crt.Scene()
        mistakes = [
            lambda: crt.Material(pattern=crt.Camera()),
            lambda: crt.Material(bump=image),
            lambda: crt.Pattern.of_image(ball),
            lambda: crt.Background.panorama(crt.Pattern.wood()),
            lambda: ball.with_material(crt.Pattern.wood()),
            lambda: crt.union([ball, image]),
            lambda: crt.difference(image, []),
            lambda: scene.add(crt.Camera()),
            lambda: scene.add(image),
            lambda: setattr(scene, "camera", crt.Light.point()),
            lambda: setattr(scene, "background", crt.Material()),
            lambda: setattr(scene, "settings", crt.Camera()),
            lambda: image.with_settings(crt.Camera()),
        ]
        for mistake in mistakes:
            with self.assertRaises(TypeError):
                mistake()

    def test_members_of_enumerations_have_names(self):
        settings = crt.Settings(precision="exact", filter="Blackman_Harris")
        self.assertIs(settings.precision, crt.Precision.EXACT)
        self.assertIs(settings.filter, crt.PixelFilter.BLACKMAN_HARRIS)
        settings.precision = "standard"
        self.assertIs(settings.precision, crt.Precision.STANDARD)
        with self.assertRaisesRegex(TypeError, "precision must be one of Precision.STANDARD, "):
            settings.precision = "exakt"

    def test_dir_and_signatures_have_the_fields_that_mean_something(self):
        names = dir(crt.Settings())
        self.assertTrue({"width", "compat", "set"} <= set(names))
        self.assertEqual([n for n in names if n.startswith(("reserved", "struct_size"))], [])
        spot = list(inspect.signature(crt.Light.spot).parameters)
        self.assertEqual(spot[:3], ["origin", "pointing", "color"])
        self.assertNotIn("type", spot)
        checker = inspect.signature(crt.Pattern.checker).parameters
        self.assertIs(checker["scale"].kind, inspect.Parameter.KEYWORD_ONLY)
        self.assertEqual(list(inspect.signature(crt.Pattern.of_image).parameters)[0], "image")

    def test_what_an_image_has_refuses_changes_that_would_be_lost(self):
        image = crt.Scene(settings=crt.Settings(width=2, height=2)).render()
        with self.assertRaisesRegex(AttributeError, "gamma cannot be assigned.*with_settings"):
            image.settings.gamma = 1
        with self.assertRaises(AttributeError):
            image.stats.camera_rays = 0
        settings = copy.copy(image.settings)
        settings.gamma = 1
        self.assertEqual(image.with_settings(settings).settings.gamma, 1)

    def test_defaults_are_what_displays_expect(self):
        settings = crt.Settings()
        self.assertEqual(settings.gamma, 2.2)
        self.assertEqual(settings.falloff_model, crt.FalloffModel.LIGHT)
        self.assertEqual(settings.ambient_model, crt.AmbientModel.SURFACE)

    def test_a_lens_has_one_radius(self):
        scene = crt.Scene(camera=crt.Camera(lens_radius=0.25))
        self.assertEqual((scene.camera.lens_radius, scene.camera.aperture), (0.25, 0))
        with self.assertRaisesRegex(crt.Error, "lens_radius must be 0 where there is an aperture"):
            scene.camera = crt.Camera(lens_radius=0.25, aperture=250)

    def test_a_representation_says_what_is_in_it(self):
        self.assertIn("fov=0.5", repr(crt.Camera(fov=0.5)))

    def test_a_material_keeps_its_patterns_and_a_pattern_its_image(self):
        image = crt.Image.from_pixels(np.full((2, 2, 4), 0.5, np.float32))
        material = crt.Material(pattern=crt.Pattern.of_image(image), bump=crt.Pattern.noise())
        del image
        painted = crt.Sphere((0, 0, 3), 1, material=material)
        self.assertIsInstance(material.pattern.image, crt.Image)
        scene = crt.Scene(
            [painted], [crt.Light.point(ambient=1)], settings=crt.Settings(width=9, height=9)
        )
        self.assertGreater(scene.render().pixels[4, 4, 0], 0)


class SceneValues(unittest.TestCase):
    def test_a_scene_gives_back_what_it_was_given(self):
        scene = crt.Scene(
            entities=[crt.Sphere((0, 0, 0), 1)],
            lights=[crt.Light.spot(origin=(0, 3, 0), angle=0.5), crt.Light.cylinder(radius=0.25)],
            camera=crt.Camera(position=(0, 0, -7), roll=0.25),
            settings=crt.Settings(width=12, height=8, title="Größe", seed=2**64 - 1),
        )
        self.assertEqual(len(scene.entities), 1)
        self.assertEqual(
            [light.type for light in scene.lights], [crt.LightType.SPOT, crt.LightType.CYLINDER]
        )
        self.assertEqual((scene.lights[0].angle, scene.lights[1].radius), (0.5, 0.25))
        self.assertEqual((scene.camera.position, scene.camera.roll), ((0, 0, -7), 0.25))
        settings = scene.settings
        scene.settings = crt.Settings()
        self.assertEqual((settings.width, settings.title, settings.seed), (12, "Größe", 2**64 - 1))

    def test_a_background_gives_back_its_image(self):
        image = crt.Image.from_pixels(np.full((2, 4, 4), 0.25, np.float32))
        scene = crt.Scene(background=crt.Background.panorama(image, angle=1))
        background = scene.background
        del image, scene
        self.assertEqual((background.type, background.angle), (crt.BackgroundType.SPHERICAL, 1))
        np.testing.assert_array_equal(background.image.pixels, np.full((2, 4, 4), 0.25))

    def test_a_copy_goes_its_own_way(self):
        scene = crt.Scene([crt.Sphere((0, 0, 0), 1)])
        copy = scene.copy()
        copy.add(crt.Sphere((3, 0, 0), 1))
        self.assertEqual((len(scene.entities), len(copy.entities)), (1, 2))

    def test_a_wrong_value_is_an_error_of_the_library(self):
        with self.assertRaisesRegex(crt.Error, "fov") as caught:
            crt.Scene(camera=crt.Camera(fov=4))
        self.assertEqual(caught.exception.status, crt.Status.INVALID_ARGUMENT)

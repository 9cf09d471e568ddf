"""These tests check what notebooks and consoles show of things, and what NumPy sees in them."""

import contextlib
import io
import inspect
import sys
import types
import unittest
from unittest import mock

import numpy as np
from support import small_scene

import crt
from crt import _progress, preview


def pixels_of(thing) -> np.ndarray:
    """Returns the picture that a notebook shows, as 8-bit RGBA."""
    return crt.Image.decode(thing._repr_png_()).to_rgba8()


def frame_of(pixels: np.ndarray) -> tuple[float, float, float, float]:
    """Returns the left, right, top and bottom of what is not transparent, as shares of the size."""
    rows, columns = np.nonzero(pixels[..., 3])
    height, width = pixels.shape[:2]
    return (
        columns.min() / width, (columns.max() + 1) / width,
        rows.min() / height, (rows.max() + 1) / height,
    )  # fmt: skip


class Pictures(unittest.TestCase):
    def test_an_entity_is_framed_wherever_and_however_large_it_is(self):
        ball = crt.Sphere((0, 0, 0), 1)
        for entity in (
            ball,
            crt.Sphere((5e6, -3, 2e3), 40),
            ball.scaled(1e-4).moved((100, 100, 100)),
            ball - crt.Box((0, 0, 0), (9, 9, -9)),
            ball ^ crt.Plane((0, 1, 0), (0, 0.9, 0)),
        ):
            left, right, top, bottom = frame_of(pixels_of(entity))
            self.assertGreater(min(left, top), 0, repr(entity))
            self.assertLess(max(right, bottom), 1, repr(entity))
            self.assertGreater(max(right - left, bottom - top), 0.85, repr(entity))
            self.assertAlmostEqual(left + right, 1, delta=0.05)
            self.assertAlmostEqual(top + bottom, 1, delta=0.05)

    def test_all_primitives_lie_within_their_frames(self):
        axis = (0.3, 1, 0.2)
        for entity in (
            crt.Box((1, 2, 3), (-4, 5, 6)),
            crt.Cylinder((0, 0, 0), axis, 2),
            crt.Cone((0, 0, 0), axis, 2),
            crt.Cone((0, 0, 0), axis, 0.1, 3),
            crt.Torus((7, 0, 0), axis, 2, 0.5),
            crt.Disc((0, 3, 0), axis, 2),
            crt.Triangle((0, 0, 0), (1, 0, 0), (0, 1, 0)),
            crt.Mesh(np.eye(3), [[0, 1, 2]]),
            crt.Box((0, 0, 0), (1, 1, 1)).rotated((30, 40, 50)).scaled((1, 2, 3)),
            crt.Sphere((0, 0, 0), 1) + crt.Sphere((9, 0, 0), 1),
        ):
            left, right, top, bottom = frame_of(pixels_of(entity))
            self.assertGreater(min(left, top), 0, repr(entity))
            self.assertLess(max(right, bottom), 1, repr(entity))
            self.assertGreater(max(right - left, bottom - top), 0.8, repr(entity))

    def test_an_entity_of_a_script_is_found(self):
        script = "Scene { Sphere { center -> vec3(300, 20, -7) radius -> 6 } }"
        (entity,) = crt.Scene.from_script(script).entities
        left, right, top, bottom = frame_of(pixels_of(entity))
        self.assertTrue(0 < left < 0.1 and 0.9 < right < 1, (left, right))
        self.assertTrue(0 < top < 0.1 and 0.9 < bottom < 1, (top, bottom))

    def test_it_has_its_own_colour_and_is_lit(self):
        red = crt.Sphere((0, 0, 0), 1, material=crt.Material(color=(0.8, 0.1, 0.1)))
        pixels = pixels_of(red).astype(int)
        middle = pixels[160, 160]
        self.assertGreater(middle[0], middle[1] + 60)
        grey = pixels_of(crt.Sphere((0, 0, 0), 1)).astype(int)
        self.assertGreater(grey[60:260, 60:260, 0].max() - grey[60:260, 60:260, 0].min(), 60)

    def test_what_has_no_end_has_a_picture_and_what_is_nowhere_has_none(self):
        self.assertGreater((pixels_of(crt.Plane((0, 1, 0)))[..., 3] > 0).sum(), 1000)
        self.assertIsNone(crt.Empty()._repr_png_())
        self.assertIsNone((crt.Sphere((0, 0, 0), 1) ^ crt.Sphere((9, 0, 0), 1))._repr_png_())

    def test_a_scene_is_small_and_as_its_camera_sees_it(self):
        scene = small_scene(1000, 8)
        scene.settings.height = 500
        pixels = pixels_of(scene)
        self.assertEqual(pixels.shape, (200, 400, 4))
        scene.settings.set(width=400, height=200, supersampling=2)
        np.testing.assert_array_equal(pixels, scene.render().to_rgba8())
        self.assertEqual(pixels_of(small_scene(30)).shape, (30, 30, 4))

    def test_the_scene_stays_as_it_was(self):
        scene = small_scene(1000, 8)
        scene.camera.roll = 0.5
        preview.picture_of_scene(scene)
        self.assertEqual((scene.settings.width, scene.settings.supersampling), (1000, 8))
        self.assertEqual(scene.camera.roll, 0.5)


class Words(unittest.TestCase):
    def test_a_representation_says_what_it_is(self):
        scene = small_scene(16)
        ball, disc = crt.Sphere((0, 0.5, 0), 1), crt.Disc((0, 0, 0), (0, 1, 0), 1)
        cases = {
            "Sphere(center=(0, 0.5, 0), radius=1)": ball,
            "Plane(normal=(0, 1, 0), position=(0, 0, 0))": crt.Plane((0, 1, 0)),
            "Mesh(positions=<3 x 3>, indices=<1 x 3>)": crt.Mesh(np.eye(3), [[0, 1, 2]]),
            "Empty()": crt.Empty(),
            "<crt.Entity: solid of 2 primitives>": ball - crt.Box((0, 0, 0), (1, 1, 1)),
            f"<crt.Entity: surface of 1 primitive, {disc!r}.scaled(2)>": disc.scaled(2),
            "<crt.Scene: 1 entity, 1 light, 16 x 16 pixels>": scene,
            "<crt.Prepared: open>": scene.prepare(),
            "<crt.Image: 16 x 16 pixels>": scene.render(),
            "<crt.Image: 16 x 16 pixels, and Z>": scene.render(aovs="depth"),
        }
        job = scene.prepare().start()
        job.wait()
        cases["<crt.Job: 100% done, finished>"] = job
        for expected, thing in cases.items():
            self.assertEqual(repr(thing), expected)
            thing.close()
            self.assertEqual(repr(thing), f"<crt.{type(thing).__name__}: closed>")

    def test_everything_public_is_documented(self):
        missing = []
        for name in crt.__all__:
            thing = getattr(crt, name)
            if not (inspect.isclass(thing) or inspect.isfunction(thing)):
                continue
            if not thing.__doc__:
                missing.append(name)
            if not inspect.isclass(thing) or thing.__module__.split(".")[0] != "crt":
                continue
            for member_name, member in vars(thing).items():
                function = getattr(member, "__func__", getattr(member, "fget", member))
                is_ours = inspect.isfunction(function) and not member_name.startswith("_")
                if is_ours and not function.__doc__:
                    missing.append(f"{name}.{member_name}")
        self.assertEqual(missing, [])

    def test_help_has_the_fields_with_units_and_defaults(self):
        text = inspect.getdoc(crt.Camera)
        self.assertIn("fov (float): vertical field of view, radians, in (0, pi)", text)
        self.assertIn("default Projection.PINHOLE", text)
        self.assertIn("fov=...", str(inspect.signature(crt.Camera)))

    def test_the_version_is_that_of_the_library(self):
        self.assertEqual(crt.__version__, ".".join(map(str, crt.version())))


class Arrays(unittest.TestCase):
    def test_an_image_is_an_array_of_its_pixels(self):
        image = small_scene(16).render()
        pixels = np.asarray(image)
        self.assertTrue(np.shares_memory(pixels, image.pixels))
        image.close()
        self.assertEqual((pixels.shape, pixels.dtype), ((16, 16, 4), np.float32))
        self.assertEqual(tuple(pixels[0, 0]), (1, 1, 1, 1))

    def test_other_types_and_copies_are_made_as_asked_for(self):
        image = small_scene(16).render()
        self.assertEqual(np.asarray(image, np.float64).dtype, np.float64)
        self.assertTrue(np.array(image).flags.writeable)
        self.assertFalse(np.shares_memory(image.__array__(copy=True), image.pixels))
        with self.assertRaisesRegex(ValueError, "needs a copy"):
            image.__array__(np.float64, copy=False)


class Progress(unittest.TestCase):
    def shown(self, **options) -> str:
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            small_scene(100).render(**options)
        return shown.getvalue()

    def test_a_line_is_shown_if_asked_for(self):
        with mock.patch.object(_progress, "_tqdm", lambda: None):
            shown = self.shown(progress=True)
        self.assertTrue(shown.startswith("\rrendering:   0% ["), shown)
        self.assertIn("\rrendering: 100% [##############################]", shown)
        self.assertTrue(shown.endswith("\n"))
        self.assertEqual(shown.count("\n"), 1)

    def test_nothing_is_shown_otherwise(self):
        self.assertEqual(self.shown() + self.shown(progress=False), "")

    def test_the_line_ends_if_the_render_fails(self):
        def fail(line):
            raise KeyError(line)

        with mock.patch.object(_progress, "_tqdm", lambda: None):
            with contextlib.redirect_stderr(io.StringIO()) as shown, self.assertRaises(KeyError):
                small_scene(100).prepare().start(progress=True, log=fail).wait()
        self.assertEqual(shown.getvalue()[-1:], "\n")

    def test_tqdm_is_used_if_it_is_there(self):
        bars = []

        class Bar:
            def __init__(self, **options):
                self.n, self.total, self.is_closed = 0, options["total"], False
                bars.append(self)

            def update(self, step):
                self.n += step

            def close(self):
                self.is_closed = True

        tqdm, auto = types.ModuleType("tqdm"), types.ModuleType("tqdm.auto")
        auto.tqdm = Bar
        with mock.patch.dict(sys.modules, {"tqdm": tqdm, "tqdm.auto": auto}):
            self.assertEqual(self.shown(progress=True), "")
        (bar,) = bars
        self.assertAlmostEqual(bar.n, bar.total)
        self.assertTrue(bar.is_closed)

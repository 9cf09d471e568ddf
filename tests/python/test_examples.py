"""These tests run the example programs in Python."""

import math
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from support import SOURCE

sys.path.insert(0, str(SOURCE / "examples/python"))
import golf  # noqa: E402
import histories  # noqa: E402
import measured  # noqa: E402
import tutorial_measure  # noqa: E402
import tutorial_rays  # noqa: E402
import tutorial_render  # noqa: E402
import tutorial_scene  # noqa: E402
import tutorial_script  # noqa: E402

import crt  # noqa: E402


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


class Histories(unittest.TestCase):
    def test_no_particle_is_lost_and_paths_are_spread_as_the_volume_is(self):
        random = np.random.default_rng(5)
        paths, lost, steps = histories.follow(histories.cells().prepare(), 20_000, random)
        self.assertEqual(lost, 0)
        self.assertGreater(steps, 200_000)
        np.testing.assert_allclose(paths / paths.sum(), histories.true_shares(), atol=5e-3)


def housing_volume() -> float:
    """Returns the volume of housing.crt in closed form, but for the duct, which is an integral."""
    foot = 110 * 14 - 2 * 3 * 3 / 2  # without chamfers
    hub_in_web = 22 * math.sqrt(900 - 484) + 900 * math.asin(22 / 30)
    silhouette = foot + 44 * (50 - 14) + 900 * math.pi - hub_in_web
    bores = math.pi * (21**2 * 12 + 17**2 * 16)
    drilled = math.pi * (3**2 * 44 + 2 * 4.5**2 * 14)
    # The duct ends at two cylinders across it. With x = 2 sin(angle) the integrand is periodic, and
    # the trapezoidal rule finds all digits.
    sine = np.sin(2 * math.pi * np.arange(64) / 64)
    height = np.sqrt(900 - 4 * sine**2) - np.sqrt(441 - 4 * sine**2)
    duct = 4 * math.pi * 2 * np.mean((1 - sine**2) * height)
    return 28 * silhouette - bores - drilled - float(duct)


class Measured(unittest.TestCase):
    """The program whose results docs/measured.md shows."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.scene = measured.load()
        cls.part, cls.screw = cls.scene.entities[:2]
        cls.found = measured.measure(cls.part, cls.screw)
        cls.section = measured.draw(cls.part, cls.folder / "housing.svg")
        cls.files = [cls.folder / "housing.stl", cls.folder / "housing.3mf"]
        cls.surface = measured.export(cls.part, cls.files)

    def test_intervals_hold_the_closed_forms(self):
        self.assertIn(housing_volume(), self.found.volume)
        self.assertLess(self.found.volume.width, 0.2)
        self.assertIn(1, self.found.wall.least)
        self.assertLess(self.found.wall.least.width, 2e-3)
        self.assertIn(0.3, self.found.screw.distance)
        self.assertGreater(self.found.screw.distance.lower, 0.1)
        self.assertIn(2.7, self.found.driver.distance)
        self.assertLess(self.found.driver.distance.width, 1e-3)
        low, high = self.found.box
        np.testing.assert_allclose(low, (-55, 0, 0), atol=1e-4)
        np.testing.assert_allclose(high, (55, 80, 28), atol=1e-4)

    def test_the_area_of_triangles_is_nearly_that_of_the_part(self):
        a, b, c = np.moveaxis(self.surface.positions[self.surface.triangles], 1, 0)
        area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
        self.assertAlmostEqual(area / self.found.area.middle, 1, delta=2e-3)

    def test_the_thinnest_wall_is_between_channel_and_seat(self):
        ends = sorted((self.found.wall.start, self.found.wall.end), key=lambda end: end[1])
        np.testing.assert_allclose(ends, [(0, 28, 6), (0, 29, 6)], atol=0.5)
        self.assertIn(2, measured.load(channel=26).entities[0].least_wall(1e-3).least)

    def test_the_section_has_its_closed_form_and_is_hatched(self):
        area = 28 * 80 - 12 * 42 - 16 * 34 - 4 * 9 - 9 * math.pi
        self.assertIn(area, self.section.area)
        self.assertLess(self.section.area.width, 1e-3)
        self.assertLessEqual(self.section.deviation, 1e-3)
        drawing = (self.folder / "housing.svg").read_text()
        self.assertIn('width="28.7mm" height="80.7mm"', drawing)
        self.assertGreater(drawing.count("L"), 40)

    def test_files_are_read_again_as_the_same_triangles(self):
        self.assertLessEqual(self.surface.deviation, 0.05)
        points = np.random.default_rng(3).uniform(*self.found.box, (300, 3))
        clear = points[np.abs(self.part.distance(points).distance) > 0.06]
        self.assertGreater(len(clear), 250)
        for file in self.files:
            with self.subTest(file.name):
                read = crt.load_mesh(file)
                self.assertTrue(read.is_solid)
                self.assertEqual(read.primitive_count, len(self.surface.triangles))
                self.assertEqual(crt.mesh_report(read).warnings, [])
                np.testing.assert_array_equal(read.contains(clear), self.part.contains(clear))

    def test_the_page_shows_what_is_printed(self):
        printed = "\n".join(measured.report(self.found, self.section, self.surface))
        page = (SOURCE / "docs/measured.md").read_text()
        shown = re.search(r"<!-- printed by measured.py -->\n```\n(.*?)\n```\n", page, re.DOTALL)
        # The last digits change whenever a search takes another way.
        number = re.compile(r"\d+\.?\d*")
        self.assertEqual(number.sub("#", shown[1]), number.sub("#", printed))
        numbers = [[float(text) for text in number.findall(lines)] for lines in (shown[1], printed)]
        np.testing.assert_allclose(*numbers, rtol=2e-2)

    def test_arrows_point_at_the_wall_in_a_picture_of_the_part_cut_open(self):
        cut = measured.cut_open(self.scene, self.found.wall)
        red, green, blue = np.moveaxis(small(cut).render().pixels[:, :, :3], 2, 0)
        self.assertGreater((red > 3 * np.maximum(green, blue)).sum(), 100)
        self.assertGreater((np.minimum(red, green) > 3 * blue).sum(), 5)
        self.assertEqual(len(self.scene.entities), 4)


def small(scene: crt.Scene) -> crt.Scene:
    settings = scene.settings
    settings.set(width=80, height=60, supersampling=1)
    scene.settings = settings
    return scene


class Tutorial(unittest.TestCase):
    def test_a_bracket_has_as_many_holes_as_asked_for(self):
        for holes in (2, 5):
            prepared = crt.Scene([tutorial_scene.bracket(holes)]).prepare()
            row = crt.ray((-3, 0.15, -0.6), (1, 0, 0))
            pieces = prepared.crossings(row)
            self.assertEqual(len(pieces) // 2, holes + 1)

    def test_there_is_a_picture_of_the_bracket(self):
        pixels = small(tutorial_scene.bracket_scene()).render().pixels
        plate, floor = pixels[44, 30], pixels[5, 5]
        self.assertGreater(plate[2], plate[0])
        self.assertGreater(floor[0], floor[2])

    def test_walls_are_as_thick_as_they_were_made(self):
        self.assertEqual(tutorial_rays.walls((1.9, 5, -1), (0, -1, 0)), [0.3])
        self.assertEqual(tutorial_rays.walls((-5, 1.8, 1.35), (1, 0, 0)), [0.5, 0.5])
        self.assertEqual(tutorial_rays.walls((0.5, 5, -0.6), (0, -1, 0)), [])

    def test_heights_are_those_of_plates_and_eye(self):
        heights = tutorial_rays.heights(41)
        self.assertAlmostEqual(heights.max(), 3)
        self.assertAlmostEqual(heights[-2, 1], 0.3)
        self.assertEqual(heights[28, 15], 0)  # a hole

    def test_a_bracket_is_measured_with_the_digits_that_are_sure(self):
        size, mass, centroid = tutorial_measure.report(tutorial_scene.bracket())
        self.assertEqual(size, "size: 4.00 x 3.00 x 3.00 m")
        self.assertTrue(mass.startswith("mass: 43.88 t, to 0.00"))
        self.assertTrue(centroid.endswith("0.00, 0.59, 0.55"))
        share = tutorial_measure.share_inside(tutorial_scene.bracket(), 20_000)
        self.assertAlmostEqual(share, 5.58936 / 36, delta=0.01)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "bracket.dxf"
            section = tutorial_measure.draw_section(tutorial_scene.bracket(), str(file))
            self.assertIn("HATCH", file.read_text())
        self.assertLessEqual(section.deviation, 1e-4)
        self.assertGreater(section.area.lower, 0)
        # The largest ball in a corner of the plates is a little more than half as thick as they.
        self.assertTrue(0.1 < tutorial_measure.deepest(tutorial_scene.bracket(), 300) < 0.25)

    def test_a_render_is_watched_and_may_be_stopped(self):
        scene = small(tutorial_scene.bracket_scene())
        image = tutorial_render.render(scene)
        normals = tutorial_render.normal_picture(image).pixels
        np.testing.assert_allclose(normals[5, 5, :3], (0.5, 1, 0.5), atol=1e-6)
        with self.assertRaises(crt.Error) as caught:
            scene.settings = crt.Settings(width=4000, height=3000, supersampling=8)
            tutorial_render.render(scene, stop_at=0)
        self.assertEqual(caught.exception.status, crt.Status.CANCELLED)

    def test_a_script_runs_with_other_values_of_its_variables(self):
        script = SOURCE / "examples/tutorial/step5.crt"
        few, many = (
            tutorial_script.run(script, {"balls": crt.Expression(count)})
            for count in ("3", "6 + 6")
        )
        self.assertEqual(few.settings.width, 240)
        counts = [sum(e.primitive_count for e in scene.entities) for scene in (few, many)]
        self.assertEqual(counts[1] - counts[0], 2 * 9)  # balls, and their pockets in the cage
        with self.assertRaises(crt.ScriptError):
            tutorial_script.run(SOURCE / "examples/c/wrong.crt", {})

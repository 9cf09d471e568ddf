"""These tests run the example programs in Python."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from support import SOURCE

sys.path.insert(0, str(SOURCE / "examples/python"))
import golf  # noqa: E402
import histories  # noqa: E402
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

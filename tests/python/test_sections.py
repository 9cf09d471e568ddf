"""These tests check what planes cut out of solids."""

import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

import crt

PLATE = crt.Box((-50, 0, -30), (50, 12, 30)) - crt.Cylinder((10, -1, 5), (10, 13, 5), 4)
UP = (0, 1, 0)


class Sections(unittest.TestCase):
    def test_a_drilled_plate_has_a_rectangle_and_a_circle(self):
        section = PLATE.section(UP, 6, 0.01)
        self.assertIn(6000 - 16 * math.pi, section.area)
        self.assertLessEqual(section.deviation, 0.01)
        self.assertEqual(section.offset, 6)
        outer, hole = section.contours
        self.assertEqual(outer.shape, (4, 3))
        np.testing.assert_allclose(outer[:, 1], 6)
        np.testing.assert_allclose(np.abs(outer[:, [0, 2]]), [[50, 30]] * 4)
        distance = np.hypot(hole[:, 0] - 10, hole[:, 2] - 5)
        np.testing.assert_allclose(distance, 4, atol=1e-6)
        self.assertGreater(len(hole), 20)

    def test_the_profile_can_be_drawn_out_again(self):
        profile = PLATE.section(UP, 6, 0.01).profile
        self.assertEqual([len(contour) for contour in profile], [4, 2])
        self.assertEqual([corner[2] for corner in profile[1]], [-1, -1])
        again = crt.Extrusion(profile, (0, 0, 0), (0, 0, 1))
        self.assertAlmostEqual(again.volume().middle, 6000 - 16 * math.pi, delta=0.01)

    def test_the_frame_says_where_the_drawing_is(self):
        section = PLATE.section((0, 3, 0), 6, 0.01)
        origin, x_axis, y_axis = section.frame
        np.testing.assert_allclose(origin, (0, 6, 0))
        np.testing.assert_allclose(x_axis, (1, 0, 0))
        np.testing.assert_allclose(y_axis, (0, 0, 1))

    def test_a_plane_in_a_face_is_moved_against_its_normal(self):
        section = PLATE.section(UP, 12, 0.01)
        self.assertEqual(len(section.contours), 2)
        self.assertLess(section.offset, 12)
        self.assertEqual(PLATE.section(UP, 0, 0.01).contours, [])

    def test_it_is_written_as_svg_and_dxf(self):
        section = PLATE.section(UP, 6, 0.01)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "plate.svg"
            section.write(file, unit="mm", hatch=2)
            self.assertIn('width="100.7mm"', file.read_text())
            section.write(str(file.with_suffix(".dxf")))
            self.assertIn("$INSUNITS\n70\n6\n", file.with_suffix(".dxf").read_text())
            with self.assertRaises(crt.Error):
                section.write(Path(folder) / "plate.pdf")
            with self.assertRaisesRegex(ValueError, "unit"):
                section.write(file, unit="ft")
            with self.assertRaises(crt.Error):
                section.write(file, hatch=-1)

    def test_wrong_arguments_are_named(self):
        with self.assertRaisesRegex(crt.Error, "normal"):
            PLATE.section((0, 0, 0), 6, 0.01)
        with self.assertRaisesRegex(crt.Error, "deviation"):
            PLATE.section(UP, 6, 0)
        with self.assertRaises(TypeError):
            PLATE.section(UP, "6", 0.01)
        with self.assertRaises(crt.Error):
            crt.Plane((0, 0, 0), UP).section(UP, 0, 0.01)

    def test_a_camera_cuts_the_scene_open(self):
        scene = crt.Scene()
        scene.entities.append(crt.Sphere((0, 0, 0), 1))
        scene.camera = crt.Camera(section_normal=(0, 0, -1), section_offset=-0.5)
        hits = scene.prepare().intersect(crt.rays((0, 0, -5), (0, 0, 1)))
        self.assertAlmostEqual(float(hits["t"]), 5.5)


if __name__ == "__main__":
    unittest.main()

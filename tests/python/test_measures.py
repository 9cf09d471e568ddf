"""These tests check how much entities are, where they are, and what is in them."""

import math
import os
import signal
import threading
import unittest

import numpy as np

import crt

PLATE = crt.Box((0, 0, 0), (4, 2, 1)) - crt.Cylinder((1, 1, -1), (1, 1, 2), 0.5)
VOLUME = 8 - math.pi / 4


class Intervals(unittest.TestCase):
    def test_they_have_ends_a_middle_and_a_width(self):
        number = crt.Interval(1, 4)
        self.assertEqual((number.lower, number.upper, number.middle, number.width), (1, 4, 2.5, 3))
        lower, upper = number
        self.assertEqual((lower, upper), (1, 4))

    def test_they_hold_what_is_between_their_ends(self):
        number = crt.Interval(1, 4)
        for inside in (1, 2.5, np.float64(4)):
            self.assertIn(inside, number)
        for outside in (0.999, 4.001, math.nan):
            self.assertNotIn(outside, number)
        with self.assertRaises(TypeError):
            "a" in number


class Measures(unittest.TestCase):
    def test_the_volume_is_held_and_as_narrow_as_asked(self):
        for width in (1e-2, 1e-6, 1e-9):
            volume = PLATE.volume(width)
            self.assertIsInstance(volume, crt.Interval)
            self.assertIn(VOLUME, volume)
            self.assertLessEqual(volume.width, width * 8)

    def test_the_area_is_held(self):
        area = PLATE.area(1e-4)
        self.assertIn(28 - math.pi / 2 + math.pi, area)
        self.assertLessEqual(area.width, 1e-4 * 30)

    def test_mass_properties_are_those_of_a_ball(self):
        mass = crt.Sphere((1, 2, 3), 2).mass(1e-4)
        volume = 32 / 3 * math.pi
        self.assertIn(volume, mass.volume)
        self.assertIn(16 * math.pi, mass.area)
        for place, number in zip((1, 2, 3), mass.centroid):
            self.assertIn(place, number)
        for number in mass.inertia[:3]:
            self.assertIn(0.4 * volume * 4, number)
        for number in mass.inertia[3:]:
            self.assertIn(0, number)
        np.testing.assert_allclose(mass.center, (1, 2, 3), atol=1e-3)
        np.testing.assert_allclose(mass.inertia_tensor, 1.6 * volume * np.eye(3), atol=1e-1)

    def test_a_solid_has_the_density_of_its_material(self):
        self.assertIsNone(PLATE.density)
        steel = crt.Material(density=7850)
        self.assertEqual(PLATE.with_material(steel).density, 7850)
        resin = crt.PrincipledMaterial(density=1150)
        ball = crt.Sphere((9, 0, 0), 1, material=resin)
        self.assertEqual(ball.density, 1150)
        with self.assertRaisesRegex(crt.Error, "different densities"):
            (ball + PLATE.with_material(steel)).density

    def test_the_centroid_is_that_of_the_mass(self):
        centroid = PLATE.centroid(1e-4)
        for number, place in zip(centroid, ((16 - math.pi / 4) / VOLUME, 1, 0.5)):
            self.assertIn(place, number)
            self.assertLessEqual(number.width, 2e-4)

    def test_time_ends_the_work_with_what_is_known(self):
        self.assertIn(VOLUME, PLATE.volume(1e-12, seconds=1e-9))
        ball = crt.Sphere((7, 1, 0.5), 1)
        self.assertGreater(PLATE.clearance(ball, seconds=1e-9).distance.width, 1e-3)
        self.assertLess(PLATE.least_wall(seconds=1e-9).least.lower, 0.4)
        self.assertGreater(PLATE.section((0, 0, 1), 0.5, 1e-9, seconds=1e-9).deviation, 1e-9)
        self.assertEqual(PLATE.tessellate(1e-3, seconds=1e-9).deviation, math.inf)
        self.assertGreaterEqual(PLATE.distance((7, 1, 0.5), seconds=1e-9).distance, 3)

    def test_ctrl_c_ends_a_search_and_comes_out(self):
        ring = crt.Torus((0, 0, 0), (1, 2, 3), 2, 0.5)
        for search in (lambda: ring.tessellate(1e-6), lambda: ring.least_wall(1e-9)):
            timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                search()
            timer.join()

    def test_what_is_no_solid_or_has_no_end_is_refused(self):
        with self.assertRaisesRegex(crt.Error, "solid"):
            crt.Disc((0, 0, 0), (0, 1, 0), 1).volume()
        with self.assertRaisesRegex(crt.Error, "infinite"):
            crt.Plane((0, 1, 0)).mass()

    def test_wrong_arguments_are_named(self):
        with self.assertRaisesRegex(crt.Error, "relative_width"):
            PLATE.volume(0)
        with self.assertRaisesRegex(TypeError, "volume: relative_width"):
            PLATE.volume("fine")
        with self.assertRaisesRegex(crt.Error, "seconds"):
            PLATE.area(seconds=-1)
        with self.assertRaisesRegex(TypeError, "area: seconds"):
            PLATE.area(seconds="long")


class Contains(unittest.TestCase):
    def test_points_are_inside_on_the_surface_or_outside(self):
        points = [[(3, 1, 0.5), (4, 1, 0.5)], [(1, 1, 0.5), (5, 1, 0.5)]]
        sides = PLATE.contains(points)
        self.assertEqual(sides.dtype, np.int8)
        np.testing.assert_array_equal(sides, [[1, 0], [-1, -1]])

    def test_one_point_has_one_answer(self):
        self.assertEqual(PLATE.contains((3, 1, 0.5)), 1)

    def test_arrays_with_gaps_and_of_other_types_are_taken(self):
        points = np.zeros((10, 6), np.float32)
        points[:, 0:6:2] = (3, 1, 0.5)
        points[4] = 50
        sides = PLATE.contains(points[:, ::2])
        np.testing.assert_array_equal(sides, np.where(np.arange(10) == 4, -1, 1))

    def test_none_are_no_answers(self):
        self.assertEqual(PLATE.contains(np.empty((0, 3))).shape, (0,))

    def test_what_is_no_point_is_refused(self):
        with self.assertRaisesRegex(crt.Error, r"points\[1\]"):
            PLATE.contains([(0, 0, 0), (0, math.nan, 0)])
        with self.assertRaisesRegex((TypeError, ValueError), "contains: points"):
            PLATE.contains([(0, 0), (0, 1)])


class Distances(unittest.TestCase):
    def test_points_are_as_far_away_as_formulas_say(self):
        points = [[(5, 1, 0.5), (2, 1, 0.75)], [(1, 1, 0.5), (4, 1, 0.5)]]
        found = PLATE.distance(points)
        np.testing.assert_allclose(found.distance, [[1, -0.25], [0.5, 0]], atol=1e-6)
        self.assertEqual(found.point.shape, (2, 2, 3))
        np.testing.assert_allclose(found.point[0], [(4, 1, 0.5), (2, 1, 1)], atol=1e-2)

    def test_one_point_has_one_answer(self):
        distance, point = crt.Sphere((0, 0, 0), 1).distance((3, 0, 0))
        self.assertAlmostEqual(float(distance), 2, 5)
        self.assertGreaterEqual(distance, 2 - 1e-12)
        np.testing.assert_allclose(point, (1, 0, 0), atol=1e-2)

    def test_none_are_no_answers(self):
        self.assertEqual(PLATE.distance(np.empty((0, 3))).point.shape, (0, 3))

    def test_solids_are_apart_or_overlap(self):
        ball = crt.Sphere((7, 1, 0.5), 1)
        near = PLATE.clearance(ball)
        self.assertIn(2, near.distance)
        self.assertLess(near.distance.width, 1e-5)
        np.testing.assert_allclose(near.on_a, (4, 1, 0.5), atol=1e-2)
        np.testing.assert_allclose(near.on_b, (6, 1, 0.5), atol=1e-2)
        self.assertFalse(near.overlap)
        within = PLATE.clearance(crt.Sphere((4, 1, 0.5), 1))
        self.assertTrue(within.overlap)
        self.assertEqual(PLATE.contains(within.on_a), 1)

    def test_all_pairs_that_overlap_are_found(self):
        boxes = [crt.Box((i, 0, 0), (i + 1.5, 1, 1)) for i in range(4)]
        found = crt.interference(boxes, 1e-3)
        self.assertEqual([(o.first, o.second) for o in found], [(0, 1), (1, 2), (2, 3)])
        for overlap in found:
            self.assertIn(0.5, overlap.volume)
        same = crt.interference([boxes[0]] * 20)
        self.assertEqual(len(same), 190)
        self.assertEqual(crt.interference([]), [])

    def test_what_has_no_distance_is_refused(self):
        with self.assertRaisesRegex(crt.Error, "solid"):
            crt.Disc((0, 0, 0), (0, 1, 0), 1).distance((0, 0, 0))
        with self.assertRaisesRegex(crt.Error, r"points\[0\]"):
            PLATE.distance([(0, math.inf, 0)])
        with self.assertRaisesRegex(TypeError, "clearance: other"):
            PLATE.clearance((0, 0, 0))
        with self.assertRaisesRegex(crt.Error, "relative_width"):
            PLATE.clearance(PLATE, 2)
        with self.assertRaisesRegex(TypeError, "interference: entities"):
            crt.interference([1])
        with self.assertRaisesRegex(crt.Error, "seconds"):
            crt.interference([PLATE], seconds=-1)


class Thicknesses(unittest.TestCase):
    def test_the_wall_beside_a_bore_is_the_thinnest(self):
        least, start, end = PLATE.least_wall()
        self.assertIn(0.5, least)
        self.assertLess(least.width, 0.006)
        np.testing.assert_allclose(np.linalg.norm(end - start), least.upper, rtol=1e-6)

    def test_a_corner_has_no_wall(self):
        corner = crt.Box((0, 0, 0), (1, 1, 1)) & crt.Plane((1, 1, 1), (0.3, 0.3, 0.3))
        self.assertEqual(corner.least_wall().least, (math.inf, math.inf))

    def test_wrong_widths_are_refused(self):
        with self.assertRaisesRegex(crt.Error, "relative_width"):
            PLATE.least_wall(2)
        with self.assertRaisesRegex(TypeError, "least_wall: relative_width"):
            PLATE.least_wall("thin")


class Units(unittest.TestCase):
    def test_a_script_says_what_a_scene_unit_is(self):
        scene = crt.Scene.from_script('Settings { unit -> "mm" } Scene { }')
        self.assertIs(scene.settings.unit, crt.Unit.MM)
        self.assertIs(crt.Settings().unit, crt.Unit.M)
        scene.settings.unit = "in"
        self.assertIs(scene.settings.unit, crt.Unit.IN)


if __name__ == "__main__":
    unittest.main()

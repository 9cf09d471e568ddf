"""Contours of profiles have curves, and come from drawings."""

import math
import unittest

from support import SOURCE

import crt


def crossings(profile, y):
    """Returns where a ray along x meets the extrusion of a profile."""
    scene = crt.Scene([crt.Extrusion(profile, (0, 0, 0), (0, 0, 1))])
    hits = scene.prepare().crossings(crt.ray((-100, y, 0.5), (1, 0, 0)))
    return [round(t - 100, 3) for t in hits["t"]]


class Profiles(unittest.TestCase):
    def test_curves(self):
        parabola = [(-1, 1), (0, -1, 1, 1)]
        self.assertEqual(crossings(parabola, 0.25), [-0.5, 0.5])
        closing = [(-1 / 3, -1 / 3, 1 / 3, -1 / 3, 1, 1), (-1, 1)]
        self.assertEqual(crossings(closing, 0.25), [-0.5, 0.5])
        with self.assertRaisesRegex(crt.Error, "profile: control must have finite numbers"):
            crossings([(0, 0), (math.inf, 0, 1, 1)], 0)
        with self.assertRaisesRegex(ValueError, "profile must be corners"):
            crossings([(0, 0), (1, 2, 3, 4, 5)], 0)

    def test_offset_contours(self):
        square = [(0, 0), (4, 0), (4, 4), (0, 4)]
        self.assertEqual(crossings(crt.offset_contours(square, 1), 2), [-1, 5])
        (inner,) = crt.offset_contours(square, -1)
        self.assertEqual({corner[:2] for corner in inner}, {(1, 1), (1, 3), (3, 1), (3, 3)})
        self.assertEqual(crt.offset_contours([square], -2.5), [])
        with self.assertRaisesRegex(TypeError, "offset_contours: profile must be"):
            crt.offset_contours(3, 1)
        with self.assertRaisesRegex(TypeError, "offset_contours: distance must be"):
            crt.offset_contours(square, "far")

    def test_svg_path(self):
        self.assertEqual(crt.svg_path("M0 0H2V1z"), [[(0, 0, 0), (2, 0, 0), (2, -1, 0)]])
        self.assertEqual(crt.svg_path("M0 0A1 1 0 0 1 2 0z"), [[(0, 0, 0), (2, 0, -1)]])
        rings = "M0 0H9V9H0ZM3 3H6V6H3Z"
        self.assertEqual(crossings(crt.svg_path(rings), -4), [0, 9])
        self.assertEqual(crossings(crt.svg_path(rings, even_odd=True), -4), [0, 3, 6, 9])
        curve = "M0 0Q1 1 2 0"
        coarse, fine = (crt.svg_path(curve, deviation=d) for d in (0.1, 1e-6))
        self.assertLess(len(coarse[0]), len(fine[0]))

    def test_text(self):
        self.assertEqual(len(crt.text_contours("B")), 3)
        (one,) = crt.text_contours("I", 2048)
        self.assertEqual(max(y for _, y, _ in one), 1409)
        (right,) = crt.text_contours("I", 2048, alignment="right")
        self.assertLess(max(x for x, _, _ in right), 0)
        file = SOURCE / "share/fonts/LiberationSans-Regular.ttf"
        self.assertEqual(crt.text_contours("I", 2048, font=file), [one])
        self.assertEqual(crt.text_contours(" "), [])
        with self.assertWarnsRegex(UserWarning, "the font lacks 2 of the letters"):
            crt.text_contours("\u6f22\u5b57\u6f22")
        self.assertEqual(len(crossings(crt.text_contours("H"), 0.1)), 4)
        for arguments, message in (
            ({"alignment": "middle"}, "alignment must be one of"),
            ({"size": 0}, "text_contours: size must be"),
            ({"font": "no such.ttf"}, "no such.ttf"),
        ):
            with self.assertRaisesRegex((ValueError, crt.Error), message):
                crt.text_contours("a", **arguments)
        with self.assertRaisesRegex(crt.Error, "text must be UTF-8"):
            crt.text_contours("\ud800")

    def test_errors(self):
        with self.assertRaisesRegex(crt.Error, "svg_path: path has 'X' at character 5"):
            crt.svg_path("M0 0X")
        with self.assertRaisesRegex(crt.Error, "svg_path: deviation must be 0 or at least"):
            crt.svg_path("M0 0Q1 1 2 0", deviation=-1)
        with self.assertRaisesRegex(TypeError, "svg_path: deviation must be a number"):
            crt.svg_path("M0 0Q1 1 2 0", deviation=None)
        with self.assertRaisesRegex(TypeError, "svg_path: path must be a text"):
            crt.svg_path(3)


if __name__ == "__main__":
    unittest.main()

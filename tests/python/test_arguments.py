"""An error about an argument names it, says what it must be, and shows what was given."""

import unittest

import numpy as np

import crt

ORIGIN = (0, 0, 0)


class Messages(unittest.TestCase):
    def test_of_a_wrong_type_or_form(self):
        ball = crt.Sphere(ORIGIN, 1)
        prepared = crt.Scene().prepare()
        number, three = "must be a number", "must be three numbers"
        cases = [
            (lambda: crt.Sphere(ORIGIN, "b"), "Sphere: radius must be a positive number", "'b'"),
            (lambda: crt.Sphere("red", 1), f"Sphere: center {three}", "'red'"),
            (lambda: crt.Sphere((0, 1), 1), f"Sphere: center {three}", "(0, 1)"),
            (lambda: crt.Sphere((0, 1, "a"), 1), f"Sphere: center {three}", "(0, 1, 'a')"),
            (lambda: crt.Sphere(7, 1), f"Sphere: center {three}", "7"),
            (lambda: crt.Sphere(ORIGIN, 1, id="a"), "Sphere: id must be a whole number", "'a'"),
            (lambda: crt.Sphere(ORIGIN, 1, id=-1), "Sphere: id must be a whole number", "-1"),
            (
                lambda: crt.Sphere(ORIGIN, 1, material="red"),
                "Sphere: material must be a Material",
                "'red'",
            ),
            (lambda: crt.Box(ORIGIN, None), f"Box: corner_b {three}", "None"),
            (lambda: crt.Cone(ORIGIN, (1, 0, 0), 1, []), "Cone: radius2 must be 0 or a", "[]"),
            (lambda: crt.Mesh("abc", [[0, 1, 2]]), "Mesh: positions must be n x 3", "'abc'"),
            (lambda: crt.union(ball), "union: parts must be a list of entities", "Sphere("),
            (lambda: crt.union([ball, 1]), "union: parts[1] must be an Entity", "1"),
            (lambda: crt.difference(1, [ball]), "difference: whole must be an Entity", "1"),
            (lambda: ball.moved(1), f"moved: offset {three}", "1"),
            (lambda: ball.scaled("a"), "scaled: factors must be one number or three", "'a'"),
            (lambda: ball.rotated(90), f"rotated: degrees {three}", "90"),
            (lambda: ball.transformed("abc"), "transformed: matrix must be 3 x 4", "'abc'"),
            (lambda: ball.with_material(1), "with_material: material must be a Material", "1"),
            (lambda: ball.with_id(1.5), "with_id: id must be a whole number", "1.5"),
            (lambda: crt.Material(color="red"), f"Material: color {three}", "'red'"),
            (lambda: crt.Material(pattern=1), "Material: pattern must be a Pattern", "1"),
            (lambda: crt.Camera(fov="wide"), f"Camera: fov {number}", "'wide'"),
            (lambda: crt.Camera(fov=None), f"Camera: fov {number}", "None"),
            (lambda: crt.Settings(width=640.5), "Settings: width must be a whole number", "640.5"),
            (lambda: crt.Settings(width=2**31), "Settings: width must be a whole", "2147483648"),
            (lambda: crt.Settings(title=1), "Settings: title must be a text", "1"),
            (
                lambda: crt.Light(type="sport"),
                "Light: type must be one of LightType.POINT, ",
                "'sport'",
            ),
            (lambda: crt.Scene(ball), "Scene: entities must be a list of entities", "Sphere("),
            (lambda: crt.Scene([ball], [ball]), "Scene: lights[0] must be a Light", "Sphere("),
            (lambda: crt.Scene(camera=1), "Scene: camera must be a Camera", "1"),
            (lambda: crt.Scene().add(1), "add: a thing must be an Entity or a Light", "1"),
            (lambda: crt.Scene().prepare("a"), "prepare: max_primitives must be a whole", "'a'"),
            (lambda: crt.Scene().prepare(previous=3), "prepare: previous must be a Prepared", "3"),
            (lambda: crt.Scene.from_script(1), "Scene.from_script: script must be a text", "1"),
            (lambda: crt.Scene.from_file(1), "Scene.from_file: path must be a text", "1"),
            (
                lambda: crt.Scene.from_script("Scene { }", variables=["a"]),
                "variables must be a dict",
                "['a']",
            ),
            (lambda: prepared.render(threads="a"), "render: threads must be a whole", "'a'"),
            (lambda: prepared.render(region=(1, 2)), "render: region must be x, y,", "(1, 2)"),
            (lambda: prepared.render(progress=1), "render: progress must be a function", "1"),
            (lambda: prepared.render(log="a"), "render: log must be a function", "'a'"),
            (lambda: prepared.intersect([1, 2]), "rays must be a NumPy array of crt.RAY", "[1, 2]"),
            (lambda: crt.ray("abc", ORIGIN), f"ray: origin {three}", "'abc'"),
            (lambda: crt.camera_rays(1, 2, 3), "camera_rays: camera must be a Camera", "1"),
            (lambda: crt.Image.from_pixels([1]), "pixels must be a NumPy array", "[1]"),
            (lambda: crt.Image.read(1), "Image.read: path must be a text", "1"),
            (lambda: crt.Image.decode("a"), "Image.decode: content must be bytes", "'a'"),
        ]
        for call, expected, given in cases:
            with self.assertRaises((TypeError, ValueError, OverflowError)) as caught:
                call()
            self.assertTrue(str(caught.exception).startswith(expected), caught.exception)
            self.assertIn(f", not {given}", str(caught.exception))

    def test_of_a_value_that_the_library_refuses(self):
        with self.assertRaisesRegex(crt.Error, "^Sphere: radius must be greater than 0"):
            crt.Sphere(ORIGIN, -1)
        with self.assertRaisesRegex(crt.Error, "^Sphere: material: color must not have negative"):
            crt.Sphere(ORIGIN, 1, material=crt.Material(color=(-1, 0, 0)))
        with self.assertRaisesRegex(crt.Error, "^Scene: settings: width must be"):
            crt.Scene(settings=crt.Settings(width=0))

    def test_of_ends_has_the_names_that_they_have_here(self):
        for primitive in (crt.Cylinder, crt.Cone, crt.Capsule):
            name, nowhere = primitive.__name__, (0, float("nan"), 0)
            for start, end, expected in (
                (ORIGIN, ORIGIN, "end must differ from start$"),
                (ORIGIN, (1e-200, 0, 0), "end must differ from start by at least"),
                (nowhere, ORIGIN, "start must be finite"),
                (ORIGIN, nowhere, "end must be finite"),
            ):
                with self.assertRaisesRegex(crt.Error, f"^{name}: {expected}"):
                    primitive(start, end, 1)

    def test_of_a_name_that_there_is_not(self):
        with self.assertRaisesRegex(TypeError, r"Sphere.*unexpected keyword argument 'colour'"):
            crt.Sphere(ORIGIN, 1, colour=1)
        with self.assertRaisesRegex(AttributeError, "Camera has no 'fow'; it has projection, "):
            crt.Camera(fow=1)

    def test_of_an_attribute_that_would_be_lost(self):
        with self.assertRaisesRegex(AttributeError, "crt.Scene has no 'setings'; background, ca"):
            crt.Scene().setings = crt.Settings()
        ball = crt.Sphere(ORIGIN, 1)
        with self.assertRaisesRegex(AttributeError, "crt.Sphere has no 'material' that can be as"):
            ball.material = crt.Material()
        with self.assertRaises(AttributeError):
            ball.is_solid = False

        class Ours(crt.Scene):
            pass

        ours = Ours()
        ours.name = "mine"
        self.assertEqual(ours.name, "mine")

    def test_numbers_of_numpy_are_numbers(self):
        ball = crt.Sphere(np.zeros(3), np.float32(1.5), id=np.uint8(7))
        self.assertEqual(repr(ball), "Sphere(center=(0, 0, 0), radius=1.5, id=7)")
        self.assertEqual(crt.Settings(width=np.int64(9)).width, 9)

    def test_one_aov_needs_no_list(self):
        image = crt.Scene(settings=crt.Settings(width=2, height=2)).render(aovs="depth")
        self.assertEqual(list(image.channels), ["Z"])

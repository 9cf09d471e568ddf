"""These tests make scenes from scripts."""

import gc
import os
import pathlib
import pickle
import signal
import tempfile
import unittest
import weakref

import numpy as np

import crt
from crt.expressions import to_expression

WRONG = "a = 1\nScene { Sphere { center -> vec3(0, 0, 0) raduis -> a } }\n"


class Scripts(unittest.TestCase):
    def test_a_text_and_a_file_give_the_same(self):
        text = "Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "ball.crt"
            path.write_text(text)
            self.assertEqual(len(crt.Scene.from_script(path).entities), 1)
            self.assertEqual(len(crt.Scene.from_script(text).entities), 1)

    def test_a_path_is_not_taken_for_a_script_nor_a_script_for_a_path(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "ball.crt"
            path.write_text("Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }")
            plain = pathlib.Path(folder) / "plain"
            plain.write_text("Scene { }")
            for given in (str(path), str(plain), "scene.crt", "not/there/Scene.CRT"):
                with self.assertRaisesRegex(ValueError, "is a path.*crt.Scene.from_file"):
                    crt.Scene.from_script(given)
            for named in (path, str(path)):
                self.assertEqual(len(crt.Scene.from_file(named).entities), 1)
            scene = crt.Scene.from_file(str(path), settings={"width": 9})
            self.assertEqual(scene.settings.width, 9)
        for text in ("Scene { }", "a = 1\nScene { }\n"):
            with self.assertRaisesRegex(ValueError, "is the text of a script.*from_script"):
                crt.Scene.from_file(text)
        self.assertEqual(crt.Scene.from_script("Scene { } -- as in scene.crt").entities, [])

    def test_variables_and_settings_win_over_those_of_the_script(self):
        lines = []
        scene = crt.Scene.from_script(
            'n = 2\nname = "none"\nplaces = []\nSettings { width -> 7 }\n'
            "Scene { print(n, name, places, t)\n for (p in places) { Sphere { center -> p radius"
            " -> n } } }",
            variables={"n": 3, "name": 'a "b"\n\\c', "places": [(0, 0, 0), (1.5, -2, 1e-20)]},
            settings={"width": 9, "title": "new"},
            t=4,
            print=lines.append,
        )
        self.assertEqual(
            (scene.settings.width, scene.settings.title, len(scene.entities)), (9, "new", 2)
        )
        self.assertEqual("\n".join(lines).split("[")[0], '3 a "b"\n\\c ')
        self.assertTrue(lines[-1].endswith(" 4"), lines)

    def test_a_script_of_2015_is_run_as_one(self):
        lines = []
        script = "in = 2\nprint(rand(), rand(in, 1) < 2)\nScene { }"
        with self.assertRaises(crt.ScriptError):
            crt.Scene.from_script(script)
        scene = crt.Scene.from_script(script, compat=2015, print=lines.append)
        self.assertEqual(lines, ["0.6599297847448217 true"])
        self.assertEqual(scene.settings.compat, 2015)
        self.assertEqual(scene.settings.gamma, 1)
        self.assertEqual(scene.settings.falloff_model, crt.FalloffModel.PATH)
        self.assertEqual(scene.settings.ambient_model, crt.AmbientModel.LIGHT)
        self.assertEqual((scene.camera.aperture, scene.camera.focal_distance), (3, 0.5))
        with self.assertRaisesRegex(crt.Error, "compat"):
            crt.Scene.from_script(script, compat=2014)

    def test_expressions_mean_what_the_python_values_are(self):
        cases = {
            "true": True,
            "-3": -3,
            "0.1": 0.1,
            "5": np.int64(5),
            "vec3(1, 2.5, 3)": (1, 2.5, 3),
            "[1, 2]": [1, 2],
            "[0.0, 1.0, 2.0]": np.arange(3.0),
            "rgb(1, 0, 0)": crt.Expression("rgb(1, 0, 0)"),
            '"\\u0001"': "\x01",
        }
        for expected, value in cases.items():
            self.assertEqual(to_expression(value), expected)
        for wrong in (float("nan"), None, object()):
            with self.assertRaises((TypeError, ValueError)):
                to_expression(wrong)

    def test_a_wrong_script_says_where(self):
        with self.assertRaises(crt.ScriptError) as caught:
            crt.Scene.from_script(WRONG, name="ring.crt")
        error = caught.exception
        self.assertEqual(error.status, crt.Status.SCRIPT)
        self.assertIn("ring.crt:2:42: error: unknown attribute 'raduis'", str(error))
        (diagnostic,) = error.diagnostics
        self.assertTrue(diagnostic.is_error)
        self.assertEqual((diagnostic.file, diagnostic.line, diagnostic.column), ("ring.crt", 2, 42))
        self.assertEqual(diagnostic.source_line, WRONG.splitlines()[1])
        self.assertIn("radius", diagnostic.message)

    def test_calls_that_led_to_an_error_are_told(self):
        with self.assertRaises(crt.ScriptError) as caught:
            crt.Scene.from_script("f = Macro (x) { print(1 / x) }\nScene { f(0) }")
        (call,) = caught.exception.diagnostics[0].calls
        self.assertEqual((call.name, call.line), ("f", 2))

    def test_warnings_come_with_the_scene(self):
        scene = crt.Scene.from_script("Scene { 1 + 1 }")
        self.assertEqual([d.is_error for d in scene.diagnostics], [False])
        self.assertIn("not used", scene.diagnostics[0].message)

    def test_a_missing_file_is_an_error_of_reading(self):
        path = "/nowhere/at all.crt"
        for read in (
            lambda: crt.Scene.from_file(path),
            lambda: crt.Scene.from_script(pathlib.Path(path)),
            lambda: crt.Image.read(path),
        ):
            with self.assertRaisesRegex(crt.Error, path) as caught:
                read()
            self.assertIsInstance(caught.exception, FileNotFoundError)
            self.assertNotIsInstance(caught.exception, crt.ScriptError)
            self.assertEqual(caught.exception.status, crt.Status.IO)
            self.assertEqual(caught.exception.filename, path)
            twin = pickle.loads(pickle.dumps(caught.exception))
            self.assertEqual((str(twin), twin.filename), (str(caught.exception), path))

    def test_what_is_there_but_no_script_is_another_error(self):
        for read in (crt.Scene.from_file, crt.Image.read):
            with self.assertRaises(crt.Error) as caught:
                read("/")
            self.assertIs(type(caught.exception), crt.Error)
            self.assertEqual(caught.exception.status, crt.Status.IO)

    def test_a_missing_file_that_a_script_names_is_an_error_of_the_script(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "import.crt"
            path.write_text('import "none.crt"\nScene { }')
            with self.assertRaisesRegex(crt.ScriptError, "none.crt"):
                crt.Scene.from_file(path)

    def test_limits_end_a_script(self):
        with self.assertRaises(crt.ScriptError) as caught:
            crt.Scene.from_script("while (true) { a = 1 }\nScene {}", max_steps=1000)
        self.assertEqual(caught.exception.status, crt.Status.LIMIT)
        field = """row = [0, 0.5, 1]\nScene { HeightField { heights -> [row, row]
            cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) } }"""
        crt.Scene.from_script(field, max_image_pixels=6)
        with self.assertRaises(crt.ScriptError) as caught:
            crt.Scene.from_script(field, max_image_pixels=5)
        self.assertEqual(caught.exception.status, crt.Status.LIMIT)
        with self.assertRaisesRegex(TypeError, "no argument 'max_stepz'; limits are max_steps"):
            crt.Scene.from_script("Scene {}", max_stepz=1)


class Callbacks(unittest.TestCase):
    def test_what_print_raises_comes_out(self):
        def fail(line):
            raise KeyError(line)

        with self.assertRaisesRegex(KeyError, "hello"):
            crt.Scene.from_script('print("hello")\nScene {}', print=fail)

    def test_files_come_from_the_program_or_the_file_system(self):
        asked = []

        def open_file(path):
            asked.append(os.path.basename(path))
            return b"radius = 2" if path.endswith("sizes.crt") else None

        text = 'import "sizes.crt"\nScene { Sphere { center -> vec3(0, 0, 0) radius -> radius } }'
        prepared = crt.Scene.from_script(text, open_file=open_file).prepare()
        self.assertEqual(asked, ["sizes.crt"])
        self.assertEqual(prepared.intersect(crt.ray((0, 0, -5), (0, 0, 1)))["t"], 3)
        with self.assertRaises(crt.ScriptError):
            crt.Scene.from_script('import "others.crt"\nScene {}', open_file=open_file)

    def test_what_open_file_raises_comes_out(self):
        def fail(path):
            raise PermissionError(path)

        with self.assertRaises(PermissionError):
            crt.Scene.from_script('import "sizes.crt"\nScene {}', open_file=fail)

    def test_control_c_stops_a_script_that_does_not_end_by_itself(self):
        def press(line):
            os.kill(os.getpid(), signal.SIGINT)

        text = 'print("now")\nwhile (true) { a = 1 }\nScene {}'
        with self.assertRaises(KeyboardInterrupt):
            crt.Scene.from_script(text, print=press, max_steps=2**62)

    def test_what_callbacks_raise_keeps_nothing_that_the_caller_has(self):
        class Large:
            pass

        def caller(**callbacks):
            large = Large()
            with self.assertRaises(KeyError):
                crt.Scene.from_script('print("a")\nimport "b.crt"\nScene {}', **callbacks)
            return weakref.ref(large)

        def fail(_):
            raise KeyError

        gc.disable()
        self.addCleanup(gc.enable)
        self.assertIsNone(caller(print=fail)())
        self.assertIsNone(caller(open_file=fail)())

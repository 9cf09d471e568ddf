"""The view shows a scene otherwise than its picture has it, and the picture stays what it is."""

import base64
import os
import struct
import subprocess
import unittest

from client import ALL, ViewedFolder

COMMAND = os.environ["CRT_COMMAND"]
WIDTH, HEIGHT = 96, 64
SCENE = """Settings {
    width -> 96 height -> 64 supersampling -> 2
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
red = Material { color -> rgb(0.8, 0.1, 0.1) }
ball = Macro (x) { Sphere { center -> vec3(x, 0, 0) radius -> 0.7 material -> red } }
Scene {
    ball(-1)
    Box { cornerA -> vec3(0.5, -0.5, -0.5) cornerB -> vec3(1.5, 0.5, 0.5) }
}
"""
CAMERA = {
    "position": [1, 1, -4],
    "pointing": [0, 0, 0],
    "fov": 1.0,
    "roll": 0,
    "aperture": 0,
    "focalDistance": 4,
    "projection": "pinhole",
    "apertureShape": 0,
}
LEFT, RIGHT, CORNER = (28, 32), (66, 32), (2, 2)


class View(ViewedFolder):
    SCENE, WIDTH, HEIGHT = SCENE, WIDTH, HEIGHT

    def span(self, piece):
        begin = SCENE.index(piece)
        return [begin, begin + len(piece)]

    def test_every_channel_is_shown_and_the_picture_comes_back(self):
        seen = {self.picture}
        for channel in ("depth", "normal", "id", "part", "albedo", "samples", "error"):
            with self.subTest(channel):
                pixels = self.show(channel=channel)
                self.assertEqual(pixels[3::4], b"\xff" * (WIDTH * HEIGHT))
                seen.add(pixels)
        # Without passes, all samples and all errors are the same: both are a single colour. Parts
        # that nothing names are the entities.
        self.assertEqual(len(seen), 6)
        self.assertEqual(self.show(), self.picture)

    def test_numbers_are_shown_as_they_are_ordered(self):
        depth = self.show(channel="depth")
        self.assertGreater(self.at(depth, LEFT)[0], self.at(depth, (20, 32))[0])
        normal = self.show(channel="normal")
        self.assertEqual(self.at(normal, RIGHT)[:3], (128, 128, 0))
        ids = self.show(channel="id")
        self.assertEqual(len({self.at(ids, place) for place in (LEFT, RIGHT, CORNER)}), 3)
        albedo = self.show(channel="albedo")
        self.assertEqual(self.at(albedo, LEFT)[:3], (230, 90, 90))  # 255 * 0.8^(1 / 2.2), ...

    def test_the_file_is_that_of_crt_render_whatever_channel_is_shown(self):
        output = self.folder / "a.exr"
        subprocess.run(
            [COMMAND, "render", "-q", "--reproducible", "-o", output, self.folder / "a.crt"],
            check=True,
        )
        for channel in ("depth", "samples"):
            self.show(channel=channel)
            self.assertEqual(self.client.picture("exr"), output.read_bytes())

    def test_modes_show_another_light_and_the_file_stays_that_of_crt_render(self):
        output = self.folder / "a.exr"
        subprocess.run(
            [COMMAND, "render", "-q", "--reproducible", "-o", output, self.folder / "a.crt"],
            check=True,
        )
        code = self.client.code("script")["text"]
        lens = SCENE.replace("pointing ->", "lensradius -> 0.25 pointing ->")
        seen = {self.picture}
        for mode in ("material", "clay"):
            with self.subTest(mode):
                pixels = self.show(mode=mode)
                seen.add(pixels)
                red, green, blue, _ = self.at(pixels, LEFT)
                self.assertEqual(red == green == blue, mode == "clay")
                self.assertEqual(self.client.picture("exr"), output.read_bytes())
                self.assertEqual(self.client.code("script")["text"], code)
                self.assertIn("statement", self.client.pick(*LEFT))
                # A turned camera is shown by the mode, too.
                self.client.send(type="camera", camera=CAMERA)
                seen.add(self.whole()[0])
                self.client.send(type="camera", camera=None)
                self.assertEqual(self.whole()[0], pixels)
                hidden = self.show(mode=mode, hidden=[self.span("ball(-1)")])
                self.assertEqual(self.at(hidden, LEFT), self.at(hidden, (24, 32)))
        self.assertEqual(len(seen), 5)
        # The camera that the page knows keeps its lens, though the mode shows all sharp.
        self.client.revision += 1
        self.client.send(
            type="text",
            revision=self.client.revision,
            text=lens,
            view={**ALL, "mode": "clay"},
        )
        scene = self.client.wait("scene", lambda found: found["revision"] == self.client.revision)
        self.assertEqual(scene["camera"]["lensRadius"], 0.25)
        self.assertEqual(scene["lights"], 0)
        self.client.set_text(SCENE)
        self.whole()
        self.assertEqual(self.show(mode="rendered"), self.picture)

    def test_a_mode_alone_makes_no_file(self):
        other = self.connect()
        other.open("a.crt")
        other.revision += 1
        other.send(type="text", revision=1, text=SCENE, view={**ALL, "mode": "clay"})
        other.wait("finished")
        other.send(type="picture", format="png")
        self.assertIn("'rendered'", other.wait("error")["message"])

    def test_what_is_hidden_is_gone_from_the_view_alone(self):
        background = self.at(self.picture, CORNER)
        for piece, hidden, kept in (
            ("ball(-1)", LEFT, RIGHT),
            ("Sphere { center -> vec3(x, 0, 0) radius -> 0.7 material -> red }", LEFT, RIGHT),
            (SCENE[SCENE.index("Box {") : SCENE.rindex("\n}")], RIGHT, LEFT),
        ):
            with self.subTest(piece):
                pixels = self.show(hidden=[self.span(piece)])
                self.assertEqual(self.at(pixels, hidden), background)
                self.assertEqual(self.at(pixels, kept), self.at(self.picture, kept))
                self.assertIsNone(self.client.pick(*hidden))
                self.assertIsNotNone(self.client.pick(*kept))
        pixels = self.show(hidden=[self.span(SCENE[SCENE.index("Scene {") :])])
        self.assertEqual(len(set(pixels[i : i + 4] for i in range(0, len(pixels), 4))), 1)
        self.assertEqual((self.folder / "a.crt").read_text(), SCENE)
        self.assertEqual(self.show(), self.picture)

    def test_a_text_brings_its_own_places_of_what_is_hidden(self):
        text = "-- ä😀\n" + SCENE
        begin = SCENE.index("ball(-1)") + len("-- ä😀\n".encode("utf-16-le")) // 2
        self.client.revision += 1
        self.client.send(
            type="text",
            revision=self.client.revision,
            text=text,
            view={**ALL, "hidden": [[begin, begin + 8]]},
        )
        pixels, _ = self.whole()
        self.assertEqual(self.at(pixels, LEFT), self.at(self.picture, CORNER))
        self.assertEqual(self.at(pixels, RIGHT), self.at(self.picture, RIGHT))

    def test_a_section_shows_the_inside_and_leads_to_the_same_statement(self):
        self.show(section={"axis": 2, "offset": 0.0, "isFlipped": True})
        cut = self.client.pick(*LEFT)
        self.assertAlmostEqual(cut["position"][2], 0)
        self.assertEqual(SCENE[slice(*cut["statement"])], "ball(-1)")
        self.assertAlmostEqual(cut["normal"][2], -1)
        pixels = self.show(section={"axis": 0, "offset": 0.0, "isFlipped": False})
        self.assertEqual(self.at(pixels, LEFT), self.at(self.picture, LEFT))
        self.assertEqual(self.at(pixels, RIGHT), self.at(self.picture, CORNER))
        self.assertEqual(self.show(), self.picture)

    def test_exposure_and_tone_map_are_those_of_files(self):
        text = SCENE.replace(
            "supersampling -> 2", 'supersampling -> 2 exposure -> 1.5 tonemap -> "filmic"'
        )
        self.client.set_text(text)
        pixels, _ = self.whole()
        self.assertNotEqual(pixels, self.picture)
        script, file = self.folder / "toned.crt", self.folder / "toned.ppm"
        script.write_text(text)
        subprocess.run([COMMAND, "render", "--quiet", script, "-o", file], check=True)
        shown = bytes(byte for i, byte in enumerate(pixels) if i % 4 < 3)
        self.assertEqual(shown, file.read_bytes()[-3 * WIDTH * HEIGHT :])

    def test_the_view_has_an_exposure_of_its_own_for_which_nothing_is_rendered(self):
        script, file = self.folder / "toned.crt", self.folder / "toned.ppm"
        script.write_text(
            SCENE.replace("supersampling -> 2", "supersampling -> 2 exposure -> 1.5")
            .replace("Settings {", 'Settings { tonemap -> "filmic"')
        )
        subprocess.run([COMMAND, "render", "--quiet", script, "-o", file], check=True)
        before = self.client.picture("exr")
        self.client.send(type="view", view={**ALL, "exposure": 1.5, "toneMap": "filmic"})
        message = self.client.receive()
        numbers = struct.unpack("<10I", message[:40])  # a picture, before any state of a render
        self.assertEqual((numbers[1], numbers[9]), (0x102, HEIGHT))
        self.client.send(type="acknowledge", picture=numbers[2])
        shown = bytes(byte for i, byte in enumerate(message[40:]) if i % 4 < 3)
        self.assertEqual(shown, file.read_bytes()[-3 * WIDTH * HEIGHT :])
        self.assertEqual(self.client.picture("exr"), before)
        # It stays when something is rendered, and goes without another render.
        self.client.send(type="render", action="restart")
        self.assertEqual(self.whole()[0], message[40:])
        self.client.wait("state")
        self.client.send(type="view", view=ALL)
        self.assertEqual(self.client.receive()[40:], self.picture)

    def test_what_the_camera_does_not_see_is_not_picked_and_may_be_cut(self):
        front = "Box { cornerA -> vec3(-9, -9, -2) cornerB -> vec3(9, 9, -1) visible -> false }"
        self.client.set_text(SCENE.replace("    ball(-1)\n", f"    {front}\n    ball(-1)\n"))
        pixels, _ = self.whole()
        self.assertEqual(self.at(pixels, CORNER), self.at(self.picture, CORNER))
        self.assertEqual(self.client.pick(*LEFT)["entity"], 1)
        self.assertIsNone(self.client.pick(*CORNER))
        pixels = self.show(section={"axis": 0, "offset": 0.0, "isFlipped": False})
        self.assertEqual(self.at(pixels, RIGHT), self.at(self.picture, CORNER))

    def test_only_the_region_is_refined(self):
        self.client.send(
            type="view", view={**ALL, "region": {"x": 10, "y": 8, "width": 40, "height": 300}}
        )
        pixels, kinds = self.whole()
        self.assertEqual(set(kinds), {1})
        for y in range(HEIGHT):
            begin = 4 * WIDTH * y
            row, picture = pixels[begin : begin + 4 * WIDTH], self.picture[begin:]
            inside = slice(40, 200)
            self.assertEqual(row[:40] + row[200:], bytes(4 * WIDTH - 160))
            self.assertEqual(row[inside], picture[inside] if y >= 8 else bytes(160))
        self.assertEqual(self.show(), self.picture)
        outside = {"x": 500, "y": 8, "width": 4, "height": 4}
        self.assertEqual(self.show(region=outside), self.picture)

    def test_a_large_picture_is_shown_smaller(self):
        size = "width -> 96 height -> 64 supersampling -> 2"
        self.client.set_text(SCENE.replace(size, "width -> 4801 height -> 2400"))
        scene = self.client.wait("scene", lambda found: found["width"] == 4801)
        self.assertEqual(scene["height"], 2400)
        sizes = set()
        while True:
            message = self.client.receive()
            if isinstance(message, dict):
                if message["type"] == "finished":
                    break
                continue
            _, kind, number, _, *size = struct.unpack("<8I", message[:32])
            sizes.add((kind & 0xFF, *size))
            if kind & 0x100:
                self.client.send(type="acknowledge", picture=number)
        self.assertIn((2, 4801, 2400, 2401, 1200), sizes)
        self.assertLessEqual(max(size[3] * size[4] for size in sizes), 1 << 23)

    def test_time_runs_the_script_again(self):
        moving = SCENE.replace("ball(-1)", "ball(t / 10 - 1)")
        self.client.set_text(moving)
        scene = self.client.wait("scene")
        self.assertTrue(scene["readsTime"])
        self.assertEqual(scene["frames"], 0)
        start, _ = self.whole()
        self.assertEqual(start, self.picture)
        self.assertNotEqual(self.show(t=5), start)
        self.assertAlmostEqual(self.client.pick(48, 32)["position"][0], 0, delta=0.1)
        self.assertEqual(self.show(t=0), start)
        self.client.set_text(SCENE.replace("Settings {", "Settings { frames -> 48"))
        scene = self.client.wait("scene")
        self.assertFalse(scene["readsTime"])
        self.assertEqual(scene["frames"], 48)

    def test_boxes_hold_the_entities_and_may_have_no_end(self):
        self.client.set_text(
            SCENE.replace(
                "Scene {", "Scene { Plane { normal -> vec3(0, 1, 0) position -> vec3(0, -1, 0) }"
            )
        )
        self.client.finish()
        self.client.send(type="boxes", id=7)
        boxes = self.client.wait("answer", lambda answer: answer["id"] == 7)["result"]["boxes"]
        self.assertEqual(len(boxes), 3)
        self.assertIn(None, boxes[0]["lower"])
        for found, true in zip(boxes[1]["lower"], (-1.7, -0.7, -0.7)):
            self.assertAlmostEqual(found, true)
        self.assertEqual(boxes[2]["upper"], [1.5, 0.5, 0.5])

    def test_what_is_cut_away_has_boxes_where_it_is(self):
        cutter = "Sphere { center -> vec3(1, 0, 0) radius -> 0.5 }"
        cut = f"(ball(-1) - {cutter}) <translate vec3(0, 2, 0)>"
        self.client.set_text(SCENE.replace("ball(-1)", cut))
        self.client.finish()
        self.client.send(type="boxes", id=8)
        answer = self.client.wait("answer", lambda answer: answer["id"] == 8)["result"]
        self.assertEqual(len(answer["cutters"]), 1)
        for found, true in zip(answer["cutters"][0]["upper"], (1.5, 2.5, 0.5)):
            self.assertAlmostEqual(found, true)

    def test_a_material_has_a_ball_if_it_can_be_made_by_itself(self):
        place = SCENE.index("Material")
        ball = base64.b64decode(self.client.ask("preview", place))
        self.assertEqual(ball[:8], b"\x89PNG\r\n\x1a\n")
        self.client.set_text(SCENE.replace("0.8, 0.1, 0.1", "0.1, 0.8, 0.1"))
        self.assertNotEqual(base64.b64decode(self.client.ask("preview", place)), ball)
        self.assertIsNone(self.client.ask("preview", SCENE.index("Box")))
        in_macro = SCENE.replace("-> red", "-> Material { reflectivity -> x }")
        self.client.set_text(in_macro)
        self.assertIsNone(self.client.ask("preview", in_macro.index("Material { reflec")))

    def test_the_machine_is_described(self):
        self.client.send(type="machine")
        machine = self.client.wait("machine")
        self.assertGreaterEqual(machine["cores"], 1)
        self.assertLessEqual(machine["freeMemory"], machine["memory"])
        self.assertGreater(machine["studioMemory"], 1 << 20)

    def test_wrong_options_are_refused(self):
        for wrong in (
            {"channel": "taste"},
            {"mode": "wireframe"},
            {"mode": None},
            {"hidden": [[1]]},
            {"hidden": 7},
            {"section": {"axis": 3, "offset": 0, "isFlipped": False}},
            {"section": {"axis": 0, "offset": "far", "isFlipped": False}},
            {"region": {"x": 0}},
            {"t": None},
            {"exposure": "bright"},
            {"denoise": 1},
            {"toneMap": "sepia"},
        ):
            with self.subTest(wrong):
                self.client.send(type="view", view={**ALL, **wrong})
                self.assertEqual(self.client.wait("error")["about"], "view")
        self.client.set_text(SCENE)
        self.assertEqual(self.whole()[0], self.picture)


if __name__ == "__main__":
    unittest.main()

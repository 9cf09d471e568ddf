"""The studio says how much solids are, and makes files of triangles of them."""

import json
import math
import struct

from client import ViewedFolder

SCENE = """Settings {
    width -> 32 height -> 24 unit -> "mm"
    camera -> Camera { position -> vec3(0, 0, -9) pointing -> vec3(0, 0, 0) }
}
red = Material { color -> rgb(1, 0.5, 0) density -> 7850 }
hole = Cylinder { from -> vec3(1, 1, -1) to -> vec3(1, 1, 2) radius -> 0.5 }
Scene {
    Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(4, 2, 1) material -> red } - hole
    Plane { normal -> vec3(0, 1, 0) position -> vec3(0, -3, 0) }
}
"""


class Solids(ViewedFolder):
    SCENE, WIDTH, HEIGHT = SCENE, 32, 24

    def span(self, piece):
        begin = SCENE.index(piece)
        return [begin, begin + len(piece)]

    def send(self, kind, **message):
        self.client.ids += 1
        self.client.send(type=kind, id=self.client.ids, **message)
        return self.client.ids

    def answer(self, number):
        return self.client.wait("answer", lambda answer: answer["id"] == number)["result"]

    def measure(self, piece):
        return self.answer(self.send("measure", span=self.span(piece)))

    def surface(self, **message):
        """Returns the format and the bytes of a file of triangles."""
        self.send("surface", **message)
        while True:
            message = self.client.receive()
            if isinstance(message, bytes) and message[:4] == b"CRTI":
                return message[4:7].decode(), message[8:]

    def test_measures_hold_the_truth(self):
        measures = self.measure("Box {")
        volume = 8 - math.pi / 4
        low, high = measures["volume"]
        self.assertTrue(low <= volume <= high)
        self.assertLess(high - low, 1e-3)
        low, high = measures["area"]
        self.assertTrue(low <= 28 - math.pi / 2 + math.pi <= high)
        self.assertEqual((measures["unit"], measures["metres"]), ("mm", 0.001))
        self.assertEqual(measures["density"], 7850)
        self.assertEqual(measures["entity"], 0)
        for found, truth in zip(measures["lower"] + measures["upper"], (0, 0, 0, 4, 2, 1)):
            self.assertAlmostEqual(found, truth, 3)
        self.assertNotIn("fault", measures)

    def test_what_has_no_volume_says_why_and_what_is_no_entity_has_no_measures(self):
        ground = self.measure("Plane {")
        self.assertIn("infinite", ground["fault"])
        self.assertIsNone(ground["upper"][0])
        self.assertNotIn("volume", ground)
        self.assertIsNone(self.measure("red = Material"))

    def test_each_question_is_answered_and_the_last_one_with_numbers(self):
        numbers = [self.send("measure", span=self.span("Box {")) for _ in range(20)]
        answers = {}
        while len(answers) < len(numbers):
            answer = self.client.wait("answer")
            answers[answer["id"]] = answer["result"]
        self.assertEqual(sorted(answers), numbers)
        self.assertIn("volume", answers[numbers[-1]])

    def test_surfaces_are_files_in_each_format(self):
        form, content = self.surface(format="stl", deviation=0.05)
        self.assertEqual(form, "stl")
        count = struct.unpack_from("<I", content, 80)[0]
        self.assertEqual(len(content), 84 + 50 * count)
        self.assertGreater(count, 20)
        form, content = self.surface(format="glb", span=self.span("Box {"))
        self.assertEqual(form, "glb")
        size = struct.unpack_from("<I", content, 12)[0]
        document = json.loads(content[20 : 20 + size])
        color = document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
        self.assertEqual(color, [1, 0.5, 0, 1])
        self.assertEqual(document["accessors"][0]["max"][0], 0.004)
        for form, begin in (("3mf", b"PK"), ("obj", b"#"), ("ply", b"ply\n")):
            found, content = self.surface(format=form)
            self.assertEqual(found, form)
            self.assertTrue(content.startswith(begin))

    def test_what_cannot_be_a_file_is_refused(self):
        for message in (
            {"format": "step"},
            {"format": "stl", "deviation": -1},
            {"format": "stl", "span": self.span("Plane {")},
            {"format": "stl", "span": self.span("red = Material")},
        ):
            with self.subTest(message):
                number = self.send("surface", **message)
                error = self.client.wait("error", lambda error: error.get("id") == number)
                self.assertEqual(error["about"], "surface")

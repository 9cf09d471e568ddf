"""The studio does what a page needs: pictures, what the script means, picking, files."""

import os
import signal
import struct
import subprocess
import unittest

from client import OpenedFolder

COMMAND = os.environ["CRT_COMMAND"]
SCENE = """-- Zwei Kugeln: ä, 😀.
Settings {
    width -> 96 height -> 64 supersampling -> 2
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
ball = Macro (x) { Sphere { center -> vec3(x, 0, 0) radius -> 0.7 } }
Scene {
    ball(-1)
    Sphere { center -> vec3(1, 0, 0) radius -> 0.5 }
}
"""
# It takes minutes, and can be interrupted anywhere.
LONG = """Settings { width -> 1600 height -> 1200 supersampling -> 16 recursiondepth -> 9 }
m = Material { reflectivity -> 0.9 }
Scene { for (i in range(0, 400)) {
    Sphere { center -> vec3(sin(i), cos(i * 1.7), 3 + i * 0.01) radius -> 0.3 material -> m } } }
"""


def units(text):
    """Returns the length of a text as pages count it."""
    return len(text.encode("utf-16-le")) // 2


class Work(OpenedFolder):
    SCENE = SCENE

    def start(self, text=SCENE):
        client = self.connect()
        client.open("a.crt")
        client.set_text(text)
        return client

    def marked(self, span, text=SCENE):
        data = text.encode("utf-16-le")
        return data[2 * span[0] : 2 * span[1]].decode("utf-16-le")

    def test_the_page_learns_what_there_is(self):
        client = self.connect()
        self.assertEqual(client.hello["script"], "a.crt")
        self.assertEqual(client.hello["scripts"], ["a.crt"])
        objects = {item["name"]: item for item in client.hello["objects"]}
        self.assertIn("radius", [a["name"] for a in objects["Sphere"]["attributes"]])

    def test_the_last_picture_is_that_of_crt_render(self):
        client = self.start()
        client.finish()
        for form in ("png", "exr"):
            output = self.folder / f"a.{form}"
            subprocess.run(
                [COMMAND, "render", "-q", "--reproducible", "-o", output, self.folder / "a.crt"],
                check=True,
            )
            self.assertEqual(client.picture(form), output.read_bytes())

    def test_pictures_get_finer_and_end_with_the_whole_one(self):
        client = self.start()
        sizes = []
        kinds = []
        while True:
            message = client.receive()
            if isinstance(message, bytes):
                numbers = struct.unpack("<10I", message[:40])
                self.assertEqual(numbers[4:6], (96, 64))
                self.assertEqual(len(message), 40 + 4 * numbers[6] * numbers[9])
                self.assertEqual(numbers[3], client.revision)
                kinds.append(numbers[1] & 0xFF)
                sizes.append(numbers[6])
            elif message["type"] == "finished":
                break
        self.assertEqual(sizes, sorted(sizes))
        self.assertEqual(kinds, sorted(kinds))
        self.assertEqual((kinds[0], kinds[-1], sizes[-1]), (0, 2, 96))

    def test_places_are_those_of_the_page_whatever_characters_stand_before(self):
        client = self.start()
        analysis = client.wait("analysis")
        tokens = analysis["tokens"]
        texts = {
            self.marked(tokens[i : i + 2]): tokens[i + 2] for i in range(0, len(tokens), 3)
        }
        self.assertEqual(texts["Sphere"], 4)
        self.assertEqual(texts["ball"], 8)
        self.assertEqual(texts["-- Zwei Kugeln: ä, 😀."], 0)
        spheres = [node for node in analysis["tree"] if node["name"] == "Sphere"]
        self.assertEqual(self.marked(spheres[1]["span"])[:8], "Sphere {")
        radius = spheres[1]["attributes"][1]
        self.assertEqual((self.marked(radius["span"]), radius["numbers"]), ("0.5", [0.5]))

    def test_what_is_wrong_is_said_at_its_place_and_is_gone_when_mended(self):
        client = self.start(SCENE.replace("radius -> 0.5", "radios -> 0.5"))
        found = client.wait("diagnostics")["diagnostics"]
        self.assertTrue(found)
        marked = self.marked(found[0]["span"], SCENE.replace("radius -> 0.5", "radios -> 0.5"))
        self.assertIn(marked, ("radios", "Sphere"))
        revision = client.set_text(SCENE)
        mended = client.wait("diagnostics", lambda message: message["revision"] == revision)
        self.assertEqual(mended["diagnostics"], [])
        client.finish()

    def test_questions_are_answered_about_the_newest_text(self):
        client = self.start()
        use = units(SCENE[: SCENE.index("ball(-1)")]) + 1
        definition = client.ask("definition", use)
        self.assertEqual(definition["file"], "")
        self.assertEqual(self.marked(definition["span"]), "ball")
        self.assertEqual(len(client.ask("places", use)), 2)
        hover = client.ask("hover", units(SCENE[: SCENE.index("Macro")]))
        self.assertIn("Macro", hover["markdown"])
        place = units(SCENE[: SCENE.rindex("radius")])
        labels = [item["label"] for item in client.ask("completion", place)["items"]]
        self.assertIn("material", labels)
        self.assertIsNone(client.ask("hover", 10**9))
        client.set_text("a=1")
        self.assertEqual(client.ask("format"), "a = 1\n")
        client.send(type="ask", id=99, what="format", at=0, revision=1)
        self.assertIsNone(client.wait("answer", lambda answer: answer["id"] == 99)["result"])

    def test_a_new_name_goes_to_all_places_or_is_refused(self):
        (self.folder / "part.crt").write_text("size = 1\n")
        text = '-- 😀\nimport "part.crt"\nball = size\nScene { print(ball + size) }\n'
        client = self.start(text)
        ball = units(text[: text.index("ball")])
        found = client.ask("rename", ball, name="sphere")
        self.assertEqual([self.marked(span, text) for span in found["spans"]], ["ball", "ball"])
        self.assertEqual(found["others"], [])
        size = units(text[: text.index("size)")])
        found = client.ask("rename", size, name="width")
        self.assertEqual([self.marked(span, text) for span in found["spans"]], ["size", "size"])
        self.assertEqual(found["others"], [str(self.folder.resolve() / "part.crt")])
        for at, name in ((ball, "size"), (ball, "Big"), (0, "sphere")):
            client.send(type="ask", id=99, what="rename", at=at, name=name, revision=1)
            error = client.wait("error")
            self.assertEqual((error["id"], error["about"]), (99, "ask"))
        client.send(type="ask", id=99, what="rename", at=ball, revision=1)
        self.assertEqual(client.wait("error")["id"], 99)

    def test_a_click_leads_to_the_statements_of_the_entity(self):
        client = self.start()
        client.finish()
        left = client.pick(96 * 0.29, 32)
        self.assertEqual(self.marked(left["statement"]), "ball(-1)")
        self.assertTrue(self.marked(left["origin"]).startswith("Sphere { center -> vec3(x"))
        right = client.pick(96 * 0.71, 32)
        self.assertTrue(self.marked(right["origin"]).startswith("Sphere { center -> vec3(1"))
        x, y, z = right["position"]
        self.assertAlmostEqual((x - 1) ** 2 + y**2 + z**2, 0.5**2)
        self.assertIsNone(client.pick(1, 1))

    def test_another_camera_gives_another_picture_and_the_scripts_own_comes_back(self):
        client = self.start()
        camera = client.wait("scene")["camera"]
        client.finish()
        first = client.picture()
        client.send(type="camera", camera={**camera, "position": [0, 3, -3]})
        self.assertTrue(client.wait("scene")["isOverridden"])
        client.finish()
        self.assertNotEqual(client.picture(), first)
        client.send(type="camera", camera=None)
        client.finish()
        self.assertEqual(client.picture(), first)
        client.send(type="camera", camera={**camera, "fov": 7})
        self.assertEqual(client.wait("error")["about"], "camera")

    def test_a_changed_camera_in_the_script_wins_over_the_views(self):
        client = self.start()
        camera = client.wait("scene")["camera"]
        client.send(type="camera", camera={**camera, "position": [0, 3, -3]})
        client.wait("scene", lambda scene: scene["isOverridden"])
        client.set_text(SCENE + "\n-- the same\n")
        kept = client.wait("scene", lambda scene: scene["revision"] == client.revision)
        self.assertTrue(kept["isOverridden"])
        client.set_text(SCENE.replace("vec3(0, 0, -4)", "vec3(0, 0, -5)"))
        changed = client.wait("scene", lambda scene: scene["revision"] == client.revision)
        self.assertFalse(changed["isOverridden"])
        self.assertEqual(changed["camera"]["position"], [0, 0, -5])

    def test_the_views_camera_stays_while_that_of_the_script_moves_in_time(self):
        moving = SCENE.replace("vec3(0, 0, -4)", "vec3(t, 0, -4)")
        client = self.start(moving)
        camera = client.wait("scene")["camera"]
        view = {"channel": "color", "hidden": [], "section": None, "region": None}
        client.send(type="view", view={**view, "t": 1})
        moved = client.wait("scene", lambda scene: scene["camera"]["position"][0] == 1)
        self.assertFalse(moved["isOverridden"])
        turned = {**camera, "position": [0, 3, -3]}
        client.send(type="camera", camera=turned)
        client.wait("scene", lambda scene: scene["isOverridden"])
        for t in (2, 3):
            client.send(type="view", view={**view, "t": t})
            scene = client.wait("scene")
            self.assertTrue(scene["isOverridden"])
            self.assertEqual(scene["camera"]["position"], [0, 3, -3])
            client.finish()
        # A text that leaves the camera of this frame as it is keeps the view's, too.
        client.set_text(moving + "\n-- the same\n")
        kept = client.wait("scene", lambda scene: scene["revision"] == client.revision)
        self.assertTrue(kept["isOverridden"])
        client.send(type="camera", camera=None)
        back = client.wait("scene", lambda scene: not scene["isOverridden"])
        self.assertEqual(back["camera"]["position"], [3, 0, -4])

    def test_what_goes_wrong_while_a_script_runs_is_said_with_its_place(self):
        client = self.start(SCENE + "\nwhile (true) { x = 1 }\n")
        failed = client.wait("state", lambda state: state["phase"] == "failed")
        line = SCENE.count("\n") + 2
        self.assertRegex(failed["message"], rf"^line {line}: .*steps")

    def test_an_error_in_an_import_is_said_with_its_file(self):
        parts = self.folder / "parts"
        parts.mkdir()
        (parts / "b.crt").write_text("\nball = Macro () { Spere { } }\n")
        client = self.start('import "parts/b.crt"\n' + SCENE)
        found = client.wait("diagnostics", lambda message: message["diagnostics"])
        self.assertEqual(found["diagnostics"][0]["line"], 0)
        self.assertRegex(found["diagnostics"][0]["message"], r"^parts/b\.crt:2: .*Spere")

    def test_a_new_text_ends_the_render_of_the_old_one(self):
        client = self.start(LONG)
        client.wait("state", lambda state: state["phase"] == "rendering")
        client.set_text(SCENE)
        client.finish()

    def test_a_render_can_be_cancelled_and_started_again(self):
        client = self.start(LONG)
        client.wait("state", lambda state: state["phase"] == "rendering")
        client.send(type="render", action="cancel")
        client.wait("state", lambda state: state["phase"] == "cancelled")
        client.send(type="render", action="restart")
        client.wait("state", lambda state: state["phase"] == "rendering")

    def test_it_ends_cleanly_in_the_middle_of_a_render(self):
        client = self.start(LONG)
        client.wait("state", lambda state: state["phase"] == "rendering")
        self.assertEqual(self.server.end(signal.SIGINT), 0)

    def test_a_script_that_never_ends_does_not_keep_the_next_from_running(self):
        client = self.start("i = 0 while (i < 1000000000) { i += 1 }")
        client.wait("state", lambda state: state["phase"] == "script")
        client.set_text(SCENE)
        client.finish()

    def test_what_a_script_prints_comes_and_not_without_an_end(self):
        client = self.start("for (i in range(0, 5000)) { print(i) }\n" + SCENE)
        self.assertEqual(client.wait("print")["line"], "0")
        lines = 1
        while client.wait("print")["line"] != "...":
            lines += 1
        self.assertLess(lines, 1001)

    def test_two_pages_do_not_disturb_one_another(self):
        first = self.start()
        second = self.start(SCENE.replace("0.5", "0.9"))
        first.finish()
        second.finish()
        pictures = first.picture(), second.picture()
        self.assertNotEqual(*pictures)
        second.close()
        first.set_text(SCENE)
        first.finish()
        self.assertEqual(first.picture(), pictures[0])

    def test_saving_writes_the_file_and_sees_what_others_wrote(self):
        client = self.start()
        file = self.folder / "a.crt"
        client.send(type="save", script="a.crt", text="a = 1\n")
        client.wait("saved")
        self.assertEqual(file.read_bytes(), b"a = 1\n")
        file.write_text("b = 2\n")
        client.send(type="save", script="a.crt", text="a = 3\n")
        client.wait("conflict")
        self.assertEqual(file.read_bytes(), b"b = 2\n")
        client.send(type="save", script="a.crt", text="a = 3\n", force=True)
        client.wait("saved")
        self.assertEqual(file.read_bytes(), b"a = 3\n")
        client.send(type="save", script="new.crt", text="c = 4\n")
        self.assertEqual(client.wait("saved")["scripts"], ["a.crt", "new.crt"])

    def test_what_another_program_writes_is_seen_once(self):
        client = self.start()
        client.send(type="look")
        (self.folder / "a.crt").write_text("b = 2\n")
        client.send(type="look")
        self.assertEqual(client.wait("changed")["text"], "b = 2\n")
        client.send(type="look")
        (self.folder / "a.crt").unlink()
        client.send(type="look")
        (self.folder / "a.crt").write_text("c = 3\n")
        client.send(type="look")
        self.assertEqual(client.wait("changed")["text"], "c = 3\n")
        client.send(type="save", script="a.crt", text="d = 4\n")
        client.wait("saved")
        client.send(type="look")
        client.send(type="nothing")
        seen = client.wait("error")
        self.assertEqual(seen["about"], "nothing")

    def test_line_ends_stay_those_of_the_file(self):
        (self.folder / "a.crt").write_bytes(b"a = 1\r\nb = 2\r\n")
        client = self.connect()
        self.assertEqual(client.open("a.crt"), "a = 1\nb = 2\n")
        client.send(type="save", script="a.crt", text="a = 1\nb = 3\n")
        client.wait("saved")
        self.assertEqual((self.folder / "a.crt").read_bytes(), b"a = 1\r\nb = 3\r\n")

    def test_scenes_and_entities_become_source_code(self):
        client = self.start()
        client.finish()
        whole = client.code("cpp")["text"]
        self.assertEqual(whole.count("Sphere{"), 2)
        self.assertNotIn("with_id", whole)
        place = units(SCENE[: SCENE.index("Sphere { center -> vec3(1")])
        one = client.code("python", [place, place + 3])["text"]
        self.assertIn("crt.Sphere(center=(1, 0, 0), radius=0.5)", one)
        self.assertEqual(one.count("Sphere"), 1)
        statement = units(SCENE[: SCENE.index("ball(-1)")])
        of_macro = client.code("c", [statement, statement + len("ball(-1)")])["text"]
        self.assertIn("crt_sphere_create((const double[]){-1, 0, 0}, 0.7", of_macro)
        self.assertIn("Scene {\n", client.code("script")["text"])
        for wrong in ({"language": "cobol"}, {"language": "c", "span": [0, 3]}):
            client.send(type="code", id=99, **wrong)
            self.assertEqual(client.wait("error")["id"], 99)


if __name__ == "__main__":
    unittest.main()

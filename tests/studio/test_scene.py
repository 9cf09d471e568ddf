"""A program shows a scene of its own: examples/cpp/studio_scene.cpp, by the studio's protocol."""

import os
import signal
import subprocess
import unittest

from client import Client, Server

EXAMPLE = os.environ["CRT_STUDIO_SCENE"]
SECONDS = 60


class Program(Server):
    """The program that shows the scene."""

    def __init__(self):
        self.process = subprocess.Popen(
            [EXAMPLE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.take(self.process.stdout.readline())

    def write(self, text):
        self.process.stdin.write(text)
        self.process.stdin.flush()

    def end(self, how=None):
        self.process.stdin.close()
        code = self.process.wait(SECONDS)
        self.process.stdout.close()
        return code


class Scene(unittest.TestCase):
    def setUp(self):
        self.program = Program()
        self.addCleanup(lambda: self.program.process.poll() is None and self.program.end())

    def start(self):
        """Opens the scene as the page does. Returns the client, the text and what show() does."""
        client = Client(self.program)
        self.addCleanup(client.close)
        text = client.open(client.hello["script"])
        return client, text, self.show(client, text)

    def show(self, client, text):
        """Gives the text a revision, and waits for its picture. Returns the last messages of each
        type."""
        client.set_text(text)
        seen = {}
        while not {"analysis", "scene", "finished"} <= seen.keys():
            message = client.receive()
            if isinstance(message, dict) and message.get("revision") == client.revision:
                seen[message["type"]] = message
        return seen

    def test_the_page_is_served_to_those_who_know_the_token_alone(self):
        self.assertEqual(self.program.status("/"), 200)
        connection, status, _, _ = self.program.upgrade(token="0" * 32)
        connection.close()
        self.assertEqual(status, 403)

    def test_the_scene_is_rendered_and_listed_with_its_entities(self):
        client, text, seen = self.start()
        tree, scene = seen["analysis"]["tree"], seen["scene"]
        self.assertEqual(client.hello["script"], "ring of balls")
        self.assertTrue(client.hello["readOnly"])
        self.assertEqual([node["name"] for node in tree], ["Plane"] + 7 * ["Sphere"])
        self.assertEqual({node["parent"] for node in tree}, {-1})
        center = tree[1]["attributes"][0]
        self.assertEqual(text[slice(*center["nameSpan"])], "center")
        self.assertEqual(text[slice(*center["span"])], "(2, 0.5, 0)")
        self.assertEqual(center["literal"], "none")
        self.assertEqual((scene["width"], scene["height"], scene["entities"]), (320, 240, 8))
        self.assertTrue(client.picture().startswith(b"\x89PNG"))

    def test_another_scene_is_a_new_revision(self):
        client, text, _ = self.start()
        first = client.picture()
        self.program.write("3\n")
        changed = client.wait("changed")
        self.assertNotEqual(changed["text"], text)
        seen = self.show(client, changed["text"])
        self.assertEqual(len(seen["analysis"]["tree"]), 4)
        self.assertEqual(seen["scene"]["entities"], 4)
        self.assertNotEqual(client.picture(), first)
        self.program.write("7\n")
        self.show(client, client.wait("changed")["text"])
        self.assertEqual(client.picture(), first)

    def test_messages_come_in_the_order_in_which_they_were_sent(self):
        client, text, _ = self.start()
        for _ in range(300):
            client.set_text(text)
            kinds = []
            while "scene" not in kinds:
                message = client.receive()
                if isinstance(message, dict) and message.get("revision") == client.revision:
                    kinds.append(message["type"])
            self.assertEqual(kinds[:2], ["analysis", "diagnostics"])

    def test_picking_says_which_entity_was_hit(self):
        client, text, seen = self.start()
        tree = seen["analysis"]["tree"]
        for x, y in ((160, 200), (160, 120)):
            hit = client.pick(x, y)
            node = tree[hit["entity"]]
            self.assertEqual(hit["origin"], node["span"])
            self.assertTrue(text[slice(*hit["origin"])].startswith(node["name"]))
        self.assertIsNone(client.pick(0, 0))

    def test_the_camera_moves_for_its_page_alone(self):
        client, _, seen = self.start()
        other, _, _ = self.start()
        camera = seen["scene"]["camera"]
        before = other.picture()
        client.send(type="camera", camera={**camera, "position": [4, 3, -4]})
        self.assertTrue(client.wait("scene", lambda scene: scene["isOverridden"]))
        client.finish()
        self.assertNotEqual(client.picture(), before)
        self.assertEqual(other.picture(), before)

    def test_what_would_change_the_scene_is_refused_and_what_is_no_question_answered(self):
        client, text, _ = self.start()
        client.send(type="save", script="ring of balls", text=text, force=True)
        self.assertIn("cannot be saved", client.wait("error")["message"])
        client.set_text(text + "Sphere")
        self.assertEqual(client.wait("changed")["text"], text)
        self.show(client, text)
        self.assertIsNone(client.ask("completion"))
        client.send(type="nothing")
        client.wait("error")

    def test_the_scene_is_written_as_source_code(self):
        client, _, seen = self.start()
        tree = seen["analysis"]["tree"]
        whole = client.code("cpp")
        self.assertEqual(whole["text"].count("Sphere{"), 7)
        self.assertNotIn("with_id", whole["text"])
        ball = client.code("python", tree[1]["span"])
        self.assertIn("crt.Sphere(center=(2, 0.5, 0), radius=0.5", ball["text"])
        self.assertEqual(ball["text"].count("Sphere"), 1)
        self.assertEqual(ball["warnings"], [])

    def test_json_that_is_nested_deeply_does_not_end_the_program(self):
        client, text, _ = self.start()
        deep = "[" * 200000 + "]" * 200000
        client.send_frame(1, f'{{"type": "x", "id": {deep}}}'.encode())
        self.assertNotIn("id", client.wait("error"))
        client.send_frame(1, f'{{"type": "ask", "id": {deep}}}'.encode())
        self.assertNotIn("id", client.wait("error"))
        client.send(type="ask", id=[7], what="hover")
        self.assertNotIn("id", client.wait("error"))
        self.show(client, text)

    def test_it_ends_while_pages_look(self):
        client, _, _ = self.start()
        self.assertEqual(self.program.end(), 0)
        with self.assertRaises(ConnectionError):
            while True:
                client.receive()

    def test_signals_are_left_to_the_program(self):
        self.program.process.send_signal(signal.SIGINT)
        self.assertEqual(self.program.process.wait(SECONDS), -signal.SIGINT)
        self.program.process.stdin.close()
        self.program.process.stdout.close()


if __name__ == "__main__":
    unittest.main()

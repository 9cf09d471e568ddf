"""crt.live() shows a scene or a script in a notebook: the page answers as long as the object
lives."""

import gc
import html
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

import crt
from client import Client, Server

COMMAND = os.environ["CRT_COMMAND"]
SECONDS = 60
BALL = """Settings { width -> 64 height -> 48 }
Scene { Sphere { center -> vec3(0, 0, 3) radius -> 1 } }
"""


class Reached(Server):
    """Reached is a server that runs already."""

    def __init__(self, address):
        self.take(address)


def answers(address):
    """Asks for the page without its fragment. Says whether somebody answers."""
    try:
        with urllib.request.urlopen(address.partition("#")[0], timeout=SECONDS) as answer:
            return answer.status == 200
    except OSError:
        return False


def wait_until(condition):
    end = time.monotonic() + SECONDS
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.02)


class Notebook(unittest.TestCase):
    def live(self, script=BALL, **options):
        view = crt.live(script, command=COMMAND, **options)
        self.addCleanup(view.close)
        return view

    def test_the_notebook_gets_a_frame_with_a_page_that_answers(self):
        view = self.live(height=300)
        bundle = view._repr_mimebundle_(include=None, exclude=None)
        self.assertEqual(set(bundle), {"text/html", "text/plain"})
        place = html.unescape(re.search(r'src="([^"]*)"', bundle["text/html"])[1])
        self.assertEqual(place, view.address + "&only=view")
        self.assertIn('height="300"', bundle["text/html"])
        with urllib.request.urlopen(place.partition("#")[0], timeout=SECONDS) as page:
            self.assertIn(b"CRT studio", page.read())
            policy = page.headers["Content-Security-Policy"]
        self.assertIn("frame-ancestors http://localhost:*", policy)
        whole = self.live(whole_page=True)._repr_mimebundle_()["text/html"]
        self.assertNotIn("only=view", whole)

    def test_pages_that_are_no_notebooks_may_not_frame_the_studio(self):
        with tempfile.TemporaryDirectory() as folder:
            server = Server(folder)
            self.addCleanup(server.end)
            connection, _, head, _ = server.request("/")
            connection.close()
        self.assertIn("frame-ancestors 'none'", head)

    def test_the_script_is_rendered_and_followed(self):
        view = self.live()
        client = Client(Reached(view.address))
        self.addCleanup(client.close)
        self.assertEqual(client.open(client.hello["script"]), BALL)
        client.set_text(BALL)
        client.finish()
        self.assertTrue(client.picture().startswith(b"\x89PNG"))
        view.script = BALL.replace("radius -> 1", "radius -> 0.5")
        client.send(type="look")
        self.assertEqual(client.wait("changed")["text"], view.script)

    def test_a_scene_is_shown_as_the_script_that_it_is_saved_as(self):
        corners = [(0, 0, 3), (1, 0, 3), (0, 1, 3)]
        scene = crt.Scene(
            [crt.Mesh(corners, [(0, 1, 2)])], settings=crt.Settings(width=64, height=48)
        )
        view = self.live(scene)
        client = Client(Reached(view.address))
        self.addCleanup(client.close)
        client.set_text(client.open(client.hello["script"]))
        client.finish()
        first = client.picture()
        files = os.listdir(view._file.parent)
        self.assertEqual(len(files), 2)
        scene.entities[0] = crt.Mesh(corners[::-1], [(0, 1, 2)])
        scene.entities.append(crt.Sphere((0, 0, 3), 0.5))
        view.show(scene)
        client.send(type="look")
        changed = client.wait("changed")["text"]
        self.assertIn("Sphere", changed)
        self.assertEqual(changed, view.script)
        client.set_text(changed)
        client.finish()
        self.assertNotEqual(client.picture(), first)
        self.assertEqual(len(os.listdir(view._file.parent)), 2)  # the first mesh is gone
        view.show(BALL)
        self.assertEqual(view.script, BALL)

    def test_a_studio_that_complains_a_lot_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            loud = pathlib.Path(folder, "loud")
            loud.write_text(
                "#!/bin/sh\n"
                "echo http://127.0.0.1:1/#token=0\n"
                f"head -c 1000000 /dev/zero >&2; touch {folder}/done; cat\n"
            )
            loud.chmod(0o700)
            with crt.live(BALL, command=str(loud)):
                wait_until(pathlib.Path(folder, "done").exists)

    def test_a_file_is_shown_where_it_is(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "ball.crt")
            file.write_text(BALL)
            view = self.live(file)
            self.assertEqual(view.script, BALL)
            view.script = "Scene { }"
            self.assertEqual(file.read_text(), "Scene { }")
            self.assertEqual(os.listdir(folder), ["ball.crt"])
            view.close()
            self.assertTrue(file.exists())

    def test_it_ends_when_it_is_closed_or_forgotten(self):
        with self.live() as view:
            address, folder = view.address, view._file.parent
            self.assertTrue(view.is_running)
        self.assertFalse(view.is_running)
        self.assertFalse(answers(address))
        self.assertFalse(folder.exists())
        self.assertEqual(view._repr_mimebundle_(), {"text/plain": "Live(ended)"})
        forgotten = crt.live(BALL, command=COMMAND)
        address = forgotten.address
        self.assertTrue(answers(address))
        del forgotten
        gc.collect()
        self.assertFalse(answers(address))

    def test_it_ends_when_python_is_killed(self):
        program = f"import crt, time; print(crt.live({BALL!r}, command={COMMAND!r}).address)"
        kept = program.replace("print(", "view = ").replace(".address)", "")
        with subprocess.Popen(
            [sys.executable, "-c", kept + "; print(view.address, flush=True); time.sleep(99)"],
            stdout=subprocess.PIPE,
            text=True,
        ) as process:
            address = process.stdout.readline().strip()
            self.assertTrue(answers(address))
            process.send_signal(signal.SIGKILL)
        wait_until(lambda: not answers(address))

    def test_what_cannot_be_shown_is_an_error_that_says_why(self):
        with self.assertRaisesRegex(crt.Error, "there is no program 'no-such-crt'"):
            crt.live(BALL, command="no-such-crt")
        with self.assertRaisesRegex(crt.Error, "there is no script"):
            self.live(pathlib.Path("/nonexistent/a.crt"))
        with self.assertRaisesRegex(ValueError, "use crt.live"):
            self.live("ball.crt")
        with self.assertRaisesRegex(TypeError, "live: scene"):
            self.live(7)
        port = int(re.search(r":(\d+)/", self.live().address)[1])
        with self.assertRaisesRegex(crt.Error, "cannot listen"):
            self.live(port=port)


if __name__ == "__main__":
    unittest.main()

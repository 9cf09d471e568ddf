"""The studio lets nobody in who should not be, and survives what they send."""

import json
import os
import pathlib
import resource
import signal
import tempfile
import unittest

from client import Client, Server

SCENE = """Settings { width -> 64 height -> 48 }
Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }
"""


class Access(unittest.TestCase):
    def setUp(self):
        self.parent = tempfile.TemporaryDirectory()
        self.addCleanup(self.parent.cleanup)
        self.folder = pathlib.Path(self.parent.name) / "opened"
        self.folder.mkdir()
        (self.folder / "a.crt").write_text(SCENE)
        self.outside = pathlib.Path(self.parent.name) / "secret.crt"
        self.outside.write_text("-- secret\n")
        self.server = Server(self.folder)
        self.addCleanup(self.server.end)

    def client(self):
        client = Client(self.server)
        self.addCleanup(client.close)
        return client

    def test_the_page_comes_with_a_strict_policy(self):
        connection, status, head, _ = self.server.request("/")
        connection.close()
        self.assertEqual(status, 200)
        self.assertIn("default-src 'none'; script-src 'self'", head)
        self.assertIn("style-src 'self'; style-src-attr 'unsafe-inline';", head)
        self.assertEqual(head.count("unsafe"), 1)
        self.assertIn("frame-ancestors 'none'", head)
        self.assertIn("nosniff", head)

    def test_a_wrong_token_is_refused(self):
        for token in ("", "0", "0" * 32, self.server.token[:-1], self.server.token + "0"):
            with self.subTest(token):
                connection, status, _, _ = self.server.upgrade(token=token)
                connection.close()
                self.assertEqual(status, 403)

    def test_a_page_of_another_origin_is_refused_even_with_the_token(self):
        for origin in (
            "http://evil.example",
            "null",
            f"https://127.0.0.1:{self.server.port}",
            f"http://127.0.0.1:{self.server.port}.evil.example",
            f"http://127.0.0.1:{self.server.port + 1}",
            f"http://localhost:{self.server.port}",
        ):
            with self.subTest(origin):
                connection, status, _, _ = self.server.upgrade(origin=origin)
                connection.close()
                self.assertEqual(status, 403)
        connection, status, _, _ = self.server.upgrade(
            origin=f"http://127.0.0.1:{self.server.port}"
        )
        connection.close()
        self.assertEqual(status, 101)

    def test_a_name_that_was_made_to_lead_here_is_refused(self):
        port = self.server.port
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port}1"):
            with self.subTest(host):
                self.assertEqual(self.server.status("/", host=host), 421)
                connection, status, _, _ = self.server.upgrade(host=host)
                connection.close()
                self.assertEqual(status, 421)
        self.assertEqual(self.server.status("/", host=f"localhost:{port}"), 200)

    def test_http_gives_the_page_and_nothing_else(self):
        for target in ("/a.crt", "/../secret.crt", "/%2e%2e/secret.crt", "//etc/passwd", "*"):
            with self.subTest(target):
                self.assertEqual(self.server.status(target), 404)
        self.assertEqual(self.server.status("/", method="DELETE"), 405)
        self.assertEqual(self.server.status(f"/socket?token={self.server.token}"), 426)

    def test_no_script_outside_of_the_folder_can_be_opened_or_written(self):
        (self.folder / "link.crt").symlink_to(self.outside)
        (self.folder / "up").symlink_to(self.folder.parent)
        (self.folder / "note.txt").write_text("not a script")
        client = self.client()
        for name in (
            "../secret.crt",
            str(self.outside),
            "link.crt",
            "up/secret.crt",
            "a.crt/../../secret.crt",
            "note.txt",
            "",
            "a.crt\0",
        ):
            with self.subTest(name):
                client.send(type="open", script=name)
                self.assertEqual(client.wait("error")["about"], "open")
                client.send(type="save", script=name, text="broken", force=True)
                self.assertEqual(client.wait("error")["about"], "save")
        self.assertEqual(self.outside.read_text(), "-- secret\n")
        self.assertEqual((self.folder / "note.txt").read_text(), "not a script")
        self.assertEqual(client.open("a.crt"), SCENE)

    def test_a_script_cannot_read_files_outside(self):
        client = self.client()
        client.open("a.crt")
        client.set_text('import "../secret.crt"\n' + SCENE)
        found = client.wait("diagnostics")["diagnostics"]
        self.assertEqual(len(found), 1)
        self.assertEqual(found[0]["severity"], "error")

    def test_messages_that_are_none_are_answered_by_errors(self):
        client = self.client()
        for text in (
            "",
            "{",
            "[]",
            "null",
            "7",
            '{"type": 7}',
            '{"type": "nothing"}',
            '{"type": "text"}',
            '{"type": "text", "revision": "a", "text": 7}',
            '{"type": "camera", "camera": {"position": [0, 0]}}',
            '{"type": "camera", "camera": 7}',
            '{"type": "ask", "what": "hover", "at": 0, "revision": 1, "id": 1}',
            '{"type": "acknowledge"}',
            '{"type": "picture", "format": "png"}',
            "[" * 100000,
        ):
            with self.subTest(text[:60]):
                client.send_frame(1, text.encode())
                client.wait("error")
        client.open("a.crt")

    def test_json_that_is_nested_deeply_ends_nothing(self):
        other = self.client()
        client = self.client()
        deep = "[" * 200000 + "]" * 200000
        for text in (
            f'{{"type": "x", "id": {deep}}}',
            f'{{"type": {deep}}}',
            f'{{"type": "pick", "id": {deep}, "x": 1, "y": 1}}',
            f'{{"id": {deep}}}',
            deep,
            '{"a":' * 200000 + "1" + "}" * 200000,
        ):
            with self.subTest(text[:30]):
                client.send_frame(1, text.encode())
                self.assertNotIn("id", client.wait("error"))
        self.assertEqual(client.open("a.crt"), SCENE)
        self.assertEqual(other.open("a.crt"), SCENE)

    def test_an_id_is_a_number_or_a_short_text_and_nothing_else_is_repeated(self):
        client = self.client()
        for name in (None, True, [], {}, [7], {"a": 7}, "a" * 129):
            client.send(type="pick", id=name, x=1, y=1)
            self.assertNotIn("id", client.wait("error"))
            client.send(type=name, id=7)
            self.assertNotIn("about", client.wait("error"))
        for name in (7, -7.5, "seven", "a" * 128):
            client.send(type="pick", id=name, x=1, y=1)
            self.assertEqual(client.wait("answer")["id"], name)
            client.send(type="nothing", id=name)
            self.assertEqual(client.wait("error")["id"], name)

    def test_a_message_of_too_many_values_is_refused(self):
        client = self.client()
        client.send_frame(1, json.dumps({"type": "x", "id": 7, "a": [0] * 200000}).encode())
        self.assertNotIn("id", client.wait("error"))
        self.assertEqual(client.open("a.crt"), SCENE)

    def test_numbers_that_are_none_are_refused(self):
        client = self.client()
        for number in ("1e300", "-1", "0.5", "4294967296", "1e999", "null"):
            client.send_frame(1, f'{{"type":"acknowledge","picture":{number}}}'.encode())
            client.wait("error")
            text = f'{{"type":"text","text":"a = 1","revision":{number}}}'
            client.send_frame(1, text.encode())
            client.wait("error")
        self.assertEqual(client.open("a.crt"), SCENE)

    def test_saving_follows_no_link_that_leads_nowhere(self):
        outside = pathlib.Path(self.parent.name)
        (self.folder / "new.crt").symlink_to(outside / "x")
        (self.folder / "other.crt").symlink_to(outside / "y.crt")
        (self.folder / "up").symlink_to(outside / "missing")
        client = self.client()
        for name in ("new.crt", "other.crt", "up/z.crt"):
            client.send(type="save", script=name, text="a = 1\n", force=True)
            self.assertEqual(client.wait("error")["about"], "save")
        self.assertEqual(
            sorted(path.name for path in outside.iterdir()), ["opened", "secret.crt"]
        )
        self.assertTrue((self.folder / "new.crt").is_symlink())

    def test_links_within_the_folder_lead_to_what_is_there(self):
        (self.folder / "parts").mkdir()
        (self.folder / "parts" / "b.crt").write_text("b = 1\n")
        (self.folder / "link.crt").symlink_to(self.folder / "parts" / "b.crt")
        client = self.client()
        self.assertEqual(client.open("link.crt"), "b = 1\n")
        client.send(type="save", script="link.crt", text="b = 2\n")
        client.wait("saved")
        self.assertEqual((self.folder / "parts" / "b.crt").read_text(), "b = 2\n")
        self.assertTrue((self.folder / "link.crt").is_symlink())

    def test_a_pipe_that_nobody_reads_or_writes_holds_nobody_up(self):
        os.mkfifo(self.folder / "pipe.crt")
        client = self.client()
        client.send(type="open", script="pipe.crt")
        self.assertEqual(client.wait("error")["about"], "open")
        for force in (False, True):
            client.send(type="save", script="pipe.crt", text="a = 1\n", force=force)
            self.assertEqual(client.wait("error")["about"], "save")
        self.assertTrue((self.folder / "pipe.crt").is_fifo())
        self.assertEqual(client.open("a.crt"), SCENE)
        self.assertEqual(self.client().open("a.crt"), SCENE)

    def test_names_that_are_too_long_are_refused_and_not_repeated(self):
        client = self.client()
        for name in ("a/" * 500000 + "a.crt", "a" * 5000 + ".crt"):
            client.send(type="open", script=name)
            self.assertLess(len(client.wait("error")["message"]), 200)
            client.send(type="open", script="a.crt", page=name)
            self.assertLess(len(client.wait("error")["message"]), 200)

    def test_a_message_that_is_too_long_ends_its_connection_alone(self):
        other = self.client()
        client = self.client()
        client.send_frame(1, b"", length=(16 << 20) + 1)
        with self.assertRaises(ConnectionError):
            client.wait("nothing")
        self.assertEqual(other.open("a.crt"), SCENE)

    def test_a_script_that_is_too_long_is_refused(self):
        client = self.client()
        client.set_text("-" * ((4 << 20) + 1))
        self.assertEqual(client.wait("error")["about"], "text")
        self.assertEqual(client.open("a.crt"), SCENE)

    def test_broken_frames_end_their_connection_alone(self):
        other = self.client()
        broken = (
            lambda client: client.send_frame(1, b"unmasked", is_masked=False),
            lambda client: client.send_frame(3, b"no such kind"),
            lambda client: client.send_frame(1, b"\xff\xfe not UTF-8"),
            lambda client: client.send_frame(9, b"p" * 126),
            lambda client: client.socket.sendall(b"\xff" * 64),
        )
        for number, breaking in enumerate(broken):
            with self.subTest(number):
                client = self.client()
                breaking(client)
                with self.assertRaises(ConnectionError):
                    client.wait("nothing")
        self.assertEqual(other.open("a.crt"), SCENE)

    def test_noise_instead_of_a_request_ends_its_connection_alone(self):
        self.server.send_noise()
        self.assertEqual(self.server.status("/"), 200)

    def test_what_is_no_request_is_called_so(self):
        for noise, status in (
            (b"\0" * 100, 400),
            (b"GET / HTTP/9.9\r\n\r\n", 400),
            (b"GET /\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\nno colon\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\nHost: a", 400),
            (b"\x16\x03\x01\x02\x00\x01", 400),
            (b"\0" * 5000000, 400),
            (b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 5000 + b"\r\n", 431),
            (b"POST / HTTP/1.1\r\nContent-Length: 7\r\n\r\nrequest", 413),
        ):
            with self.subTest(noise[:40]):
                answer = self.server.answer_to_noise(noise)
                self.assertEqual(answer.split(b"\r\n")[0].split(b" ")[1], str(status).encode())
                self.assertIn(b"nosniff", answer)
        # Who goes without a word gets none.
        self.assertEqual(self.server.answer_to_noise(b""), b"")

    def test_where_descriptors_run_out_strangers_give_way(self):
        self.server.end()
        self.server = Server(self.folder, before=lambda: resource.setrlimit(
            resource.RLIMIT_NOFILE, (40, 40)))  # fmt: skip
        self.addCleanup(self.server.end)
        client = self.client()
        strangers = [self.server.connect() for _ in range(60)]
        for stranger in strangers:
            self.addCleanup(stranger.close)
        self.assertEqual(self.server.status("/"), 200)
        self.assertEqual(strangers[0].recv(1), b"")
        client.send(type="nothing")  # which needs no descriptor
        client.wait("error")

    def test_it_ends_cleanly_with_clients_that_are_connected(self):
        client = self.client()
        client.open("a.crt")
        client.set_text(SCENE)
        self.assertEqual(self.server.end(signal.SIGTERM), 0)


if __name__ == "__main__":
    unittest.main()

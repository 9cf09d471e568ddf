"""The studio lets nobody in who should not be, and survives what they send."""

import pathlib
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

    def test_it_ends_cleanly_with_clients_that_are_connected(self):
        client = self.client()
        client.open("a.crt")
        client.set_text(SCENE)
        self.assertEqual(self.server.end(signal.SIGTERM), 0)


if __name__ == "__main__":
    unittest.main()

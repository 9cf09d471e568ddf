"""What is typed and not saved survives a crash, and is gone once it is saved."""

import os
import pathlib
import signal
import tempfile
import time
import unittest

from client import SECONDS, Client, Server

TEXT = "a = 1\n"


class Typed(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.file = self.folder / "a.crt"
        self.kept = self.folder / ".a.crt.typed"
        self.file.write_text(TEXT)
        self.server = Server(self.folder, "a.crt")
        self.addCleanup(lambda: self.server.end())

    def client(self):
        client = Client(self.server)
        self.addCleanup(client.close)
        return client

    def open(self, client):
        client.send(type="open", script="a.crt")
        return client.wait("opened")

    def type(self, client, text):
        client.revision += 1
        client.send(type="text", revision=client.revision, text=text, script="a.crt")

    def wait_for(self, text):
        """Waits until this is kept. None waits until nothing is."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            if (self.kept.read_text() if self.kept.exists() else None) == text:
                return
            time.sleep(0.01)
        self.fail(f"{text!r} is not what is kept")

    def test_what_was_typed_survives_the_servers_crash_and_is_offered(self):
        client = self.client()
        self.assertNotIn("typed", self.open(client))
        for number in range(50):
            self.type(client, f"a = {number} -- ä😀\n")
        self.wait_for("a = 49 -- ä😀\n")
        self.server.end(signal.SIGKILL)
        self.server = Server(self.folder, "a.crt")
        opened = self.open(self.client())
        self.assertEqual((opened["text"], opened["typed"]), (TEXT, "a = 49 -- ä😀\n"))
        self.assertEqual(self.file.read_text(), TEXT)

    def test_it_is_written_when_the_server_ends_or_the_page_goes(self):
        client = self.client()
        self.open(client)
        for number in range(9):
            self.type(client, f"a = {number}\n")
        client.ask("hover")
        self.assertEqual(self.server.end(), 0)
        self.assertEqual(self.kept.read_text(), "a = 8\n")

    def test_it_is_gone_when_saved_or_undone_or_discarded(self):
        client = self.client()
        self.open(client)
        self.type(client, "a = 2\n")
        self.wait_for("a = 2\n")
        client.send(type="save", script="a.crt", text="a = 2\n")
        client.wait("saved")
        self.wait_for(None)
        self.type(client, "a = 3\n")
        self.wait_for("a = 3\n")
        self.type(client, "a = 2\n")
        self.wait_for(None)
        self.type(client, "a = 4\n")
        self.wait_for("a = 4\n")
        client.send(type="forget", script="a.crt")
        self.wait_for(None)

    def test_opening_does_not_take_away_what_is_offered(self):
        self.kept.write_text("a = 5\n")
        client = self.client()
        self.assertEqual(self.open(client)["typed"], "a = 5\n")
        self.type(client, TEXT)
        client.ask("hover")
        self.assertEqual(self.server.end(), 0)
        self.assertEqual(self.kept.read_text(), "a = 5\n")

    def test_what_is_older_than_the_script_or_the_same_is_not_offered(self):
        self.kept.write_text(TEXT)
        self.assertNotIn("typed", self.open(self.client()))
        self.kept.write_text("a = 6\n")
        past = time.time() - 100
        os.utime(self.kept, (past, past))
        self.assertNotIn("typed", self.open(self.client()))

    def test_texts_of_no_script_are_not_kept(self):
        client = self.client()
        self.open(client)
        client.set_text("a = 7\n")
        client.send(type="text", revision=9, text="a = 8\n", script="b.crt")
        self.type(client, "a = 9\n")
        self.wait_for("a = 9\n")
        self.assertEqual(
            sorted(path.name for path in self.folder.iterdir()), [".a.crt.typed", "a.crt"]
        )

    def test_no_link_leads_it_elsewhere(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            secret = pathlib.Path(elsewhere) / "secret"
            secret.write_text("a = 10\n")
            self.kept.symlink_to(secret)
            client = self.client()
            self.assertNotIn("typed", self.open(client))
            self.type(client, "a = 11\n")
            client.ask("hover")
            client.send(type="forget", script="a.crt")
            self.assertEqual(self.server.end(), 0)
            self.assertEqual(secret.read_text(), "a = 10\n")
            self.assertTrue(self.kept.is_symlink())

    def test_only_scripts_of_the_folder_can_be_discarded(self):
        client = self.client()
        for name in ("../a.crt", "note.txt", ""):
            client.send(type="forget", script=name)
            self.assertEqual(client.wait("error")["about"], "forget")


if __name__ == "__main__":
    unittest.main()

"""What is typed and not saved survives a crash, and is gone once it is saved."""

import os
import pathlib
import signal
import stat
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

    def kept(self):
        """Returns the texts that are kept, in some order."""
        return [file.read_text() for file in self.folder.glob(".a.crt.*.typed")]

    def wait_for(self, *texts):
        """Waits until these are kept, and nothing else."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            try:
                if sorted(self.kept()) == sorted(texts):
                    return
            except FileNotFoundError:
                pass  # it went meanwhile
            time.sleep(0.01)
        self.fail(f"{texts} is not what is kept")

    def leave(self, text, page="0"):
        """Leaves a text behind as a page does that has gone."""
        file = self.folder / f".a.crt.{page}.typed"
        file.write_text(text)
        return file

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
        self.assertEqual(self.kept(), ["a = 8\n"])

    def test_it_is_gone_when_saved_or_undone_or_discarded(self):
        client = self.client()
        self.open(client)
        self.type(client, "a = 2\n")
        self.wait_for("a = 2\n")
        client.send(type="save", script="a.crt", text="a = 2\n")
        client.wait("saved")
        self.wait_for()
        self.type(client, "a = 3\n")
        self.wait_for("a = 3\n")
        self.type(client, "a = 2\n")
        self.wait_for()
        self.type(client, "a = 4\n")
        self.wait_for("a = 4\n")
        client.send(type="forget", script="a.crt")
        self.wait_for()

    def test_opening_does_not_take_away_what_is_offered(self):
        self.leave("a = 5\n")
        client = self.client()
        self.assertEqual(self.open(client)["typed"], "a = 5\n")
        self.type(client, TEXT)
        client.ask("hover")
        self.assertEqual(self.server.end(), 0)
        self.assertEqual(self.kept(), ["a = 5\n"])

    def test_what_is_offered_stays_until_it_is_taken_or_discarded(self):
        self.leave("a = 5\n")
        client = self.client()
        self.open(client)
        self.type(client, "a = 6\n")
        self.wait_for("a = 5\n", "a = 6\n")
        self.type(client, "a = 5\n")
        self.wait_for("a = 5\n")
        self.type(client, "a = 7\n")
        self.wait_for("a = 7\n")
        self.leave("a = 8\n")
        other = self.client()
        self.assertEqual(self.open(other)["typed"], "a = 8\n")
        self.type(other, "a = 9\n")
        self.wait_for("a = 7\n", "a = 8\n", "a = 9\n")
        other.send(type="forget", script="a.crt")
        self.wait_for("a = 7\n", "a = 9\n")
        other.send(type="forget", script="a.crt")
        self.wait_for("a = 7\n")

    def test_what_is_older_than_the_script_or_the_same_is_not_offered(self):
        kept = self.leave(TEXT)
        self.assertNotIn("typed", self.open(self.client()))
        kept.write_text("a = 6\n")
        past = time.time() - 100
        os.utime(kept, (past, past))
        self.assertNotIn("typed", self.open(self.client()))

    def test_two_pages_of_a_script_keep_a_text_each(self):
        first, second = self.client(), self.client()
        self.open(first)
        self.type(first, "a = 2\n")
        self.wait_for("a = 2\n")
        self.assertNotIn("typed", self.open(second))
        self.type(second, "a = 3\n")
        self.wait_for("a = 2\n", "a = 3\n")
        self.type(second, TEXT)
        self.wait_for("a = 2\n")
        second.send(type="forget", script="a.crt")
        self.type(second, "a = 2\n")
        self.wait_for("a = 2\n", "a = 2\n")

    def test_what_one_page_saves_takes_nothing_from_another(self):
        first, second = self.client(), self.client()
        for client, text in ((first, "a = 2\n"), (second, "a = 3\n")):
            self.open(client)
            self.type(client, text)
        self.wait_for("a = 2\n", "a = 3\n")
        first.send(type="save", script="a.crt", text="a = 2\n")
        first.wait("saved")
        self.wait_for("a = 3\n")
        second.send(type="save", script="a.crt", text="a = 3\n")
        second.wait("conflict")
        self.server.end(signal.SIGKILL)
        self.server = Server(self.folder, "a.crt")
        opened = self.open(self.client())
        self.assertEqual((opened["text"], opened["typed"]), ("a = 2\n", "a = 3\n"))

    def test_what_another_program_saves_takes_nothing_from_a_page(self):
        client = self.client()
        self.open(client)
        self.type(client, "a = 2\n")
        self.wait_for("a = 2\n")
        time.sleep(0.01)  # the file gets a later time
        self.file.write_text("a = 3\n")
        client.send(type="look")
        client.wait("changed")
        self.assertEqual(self.server.end(), 0)
        self.server = Server(self.folder, "a.crt")
        opened = self.open(self.client())
        self.assertEqual((opened["text"], opened["typed"]), ("a = 3\n", "a = 2\n"))

    def test_both_texts_are_offered_one_after_the_other_after_a_crash(self):
        for text in ("a = 2\n", "a = 3\n"):
            client = self.client()
            self.open(client)
            self.type(client, text)
        self.wait_for("a = 2\n", "a = 3\n")
        self.server.end(signal.SIGKILL)
        self.server = Server(self.folder, "a.crt")
        first, second = self.client(), self.client()
        typed = self.open(first)["typed"]
        self.type(first, typed)
        first.ask("hover")
        self.assertEqual({typed, self.open(second)["typed"]}, {"a = 2\n", "a = 3\n"})

    def test_a_page_that_reconnects_goes_on_with_what_it_has_kept(self):
        for text in ("a = 2\n", "a = 3\n"):
            client = self.client()
            client.send(type="open", script="a.crt", page="7f")
            self.assertNotIn("typed", client.wait("opened"))
            self.type(client, text)
            self.wait_for(text)
        self.assertTrue((self.folder / ".a.crt.7f.typed").exists())
        for wrong in ("../7f", "7F", "", "0" * 33):
            client.send(type="open", script="a.crt", page=wrong)
            if wrong:
                self.assertEqual(client.wait("error")["about"], "open")
            else:
                client.wait("opened")

    def test_texts_of_no_script_are_not_kept(self):
        client = self.client()
        self.open(client)
        client.set_text("a = 7\n")
        client.send(type="text", revision=9, text="a = 8\n", script="b.crt")
        self.type(client, "a = 9\n")
        self.wait_for("a = 9\n")
        self.assertEqual(len(list(self.folder.iterdir())), 2)

    def test_no_link_leads_it_elsewhere(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            secret = pathlib.Path(elsewhere) / "secret"
            secret.write_text("a = 10\n")
            link = self.folder / ".a.crt.7.typed"
            link.symlink_to(secret)
            client = self.client()
            client.send(type="open", script="a.crt", page="7")
            self.assertNotIn("typed", client.wait("opened"))
            other = self.client()
            self.assertNotIn("typed", self.open(other))
            self.type(client, "a = 11\n")
            client.ask("hover")
            client.send(type="forget", script="a.crt")
            self.assertEqual(self.server.end(), 0)
            self.assertEqual(secret.read_text(), "a = 10\n")
            self.assertTrue(link.is_symlink())

    def test_it_is_for_those_who_may_read_the_script(self):
        before = os.umask(0)
        self.addCleanup(os.umask, before)
        for number, mode in enumerate((0o600, 0o640, 0o644, 0o604)):
            self.file.chmod(mode)
            client = self.client()
            client.send(type="open", script="a.crt", page=f"{number}")
            client.wait("opened")
            self.type(client, f"a = {number}7\n")
            self.wait_for(*[f"a = {past}7\n" for past in range(number + 1)])
            kept = self.folder / f".a.crt.{number}.typed"
            self.assertEqual(stat.S_IMODE(kept.stat().st_mode), mode)
        self.file.chmod(0o600)
        self.type(client, "a = 99\n")
        self.wait_for("a = 07\n", "a = 17\n", "a = 27\n", "a = 99\n")
        self.assertEqual(stat.S_IMODE(kept.stat().st_mode), 0o600)

    def test_the_page_is_told_once_why_nothing_is_kept_and_again_if_it_fails_again(self):
        client = self.client()
        client.send(type="open", script="a.crt", page="7")
        client.wait("opened")
        place = self.folder / ".a.crt.7.typed"
        for round_ in range(2):
            place.mkdir()
            for number in range(3):
                self.type(client, f"a = {number}{round_}\n")
            failed = client.wait("error")
            self.assertEqual(failed["about"], "text")
            self.assertRegex(failed["message"], r"'a\.crt' is not kept beside it: .*typed")
            place.rmdir()
            self.type(client, f"a = 8{round_}\n")
            self.wait_for(f"a = 8{round_}\n")
            client.send(type="nothing")
            self.assertEqual(client.wait("error")["about"], "nothing")
            place.unlink()

    def test_what_is_older_than_thirty_days_goes_when_a_script_beside_it_is_opened(self):
        day = 24 * 3600
        now = time.time()
        (self.folder / "b.crt").write_text(TEXT)
        ages = {".a.crt.1.typed": 29, ".a.crt.2.typed": 31, ".b.crt.3.typed": 31,
                ".gone.crt.4.typed": 31, ".gone.crt.5.typed": 29, ".a.crt.X.typed": 31,
                "a.crt.6.typed": 31, ".a.crt.7.typed.crt": 31, ".note.8.typed": 31}  # fmt: skip
        for name, age in ages.items():
            (self.folder / name).write_text(f"a = {age}\n")
            os.utime(self.folder / name, (now - age * day, now - age * day))
        (self.folder / ".a.crt.9.typed").symlink_to("b.crt")
        os.utime(self.file, (now - 40 * day, now - 40 * day))
        self.assertEqual(self.open(self.client())["typed"], "a = 29\n")
        left = {path.name for path in self.folder.iterdir()}
        gone = {".a.crt.2.typed", ".b.crt.3.typed", ".gone.crt.4.typed"}
        self.assertEqual(left, {"a.crt", "b.crt", ".a.crt.9.typed"} | ages.keys() - gone)

    def test_what_an_open_page_has_typed_does_not_go(self):
        client = self.client()
        client.send(type="open", script="a.crt", page="7")
        client.wait("opened")
        self.type(client, "a = 7\n")
        self.wait_for("a = 7\n")
        past = time.time() - 100 * 24 * 3600
        os.utime(self.folder / ".a.crt.7.typed", (past, past))
        self.open(self.client())
        self.assertEqual(self.kept(), ["a = 7\n"])

    def test_only_scripts_of_the_folder_can_be_discarded(self):
        client = self.client()
        for name in ("../a.crt", "note.txt", ""):
            client.send(type="forget", script=name)
            self.assertEqual(client.wait("error")["about"], "forget")


if __name__ == "__main__":
    unittest.main()

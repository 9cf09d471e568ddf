"""The command crt starts the studio, and says what is wrong if it cannot."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

COMMAND = os.environ["CRT_COMMAND"]


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "a.crt").write_text("Scene { }\n")
        (self.folder / "a.txt").write_text("Scene { }\n")

    def run_studio(self, *words, command=COMMAND, env=None):
        return subprocess.run(
            [command, "studio", *words],
            cwd=self.folder,
            env=env,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )

    def test_it_serves_a_script_a_folder_or_the_current_one_until_it_is_interrupted(self):
        for words in (["a.crt"], ["."], [], [str(self.folder / "a.crt"), "--threads", "1"]):
            with self.subTest(words), subprocess.Popen(
                [COMMAND, "studio", *words], cwd=self.folder, stdout=subprocess.PIPE, text=True
            ) as process:
                line = process.stdout.readline()
                self.assertRegex(line, r"http://127\.0\.0\.1:\d+/#token=[0-9a-f]{32}\n")
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(60), 0)

    def test_the_port_can_be_chosen_and_is_refused_if_it_is_taken(self):
        with subprocess.Popen(
            [COMMAND, "studio"], cwd=self.folder, stdout=subprocess.PIPE, text=True
        ) as process:
            port = re.search(r":(\d+)/", process.stdout.readline())[1]
            run = self.run_studio("--port", port)
            self.assertEqual(run.returncode, 3)
            self.assertIn(f"cannot listen on 127.0.0.1:{port}", run.stderr)
            process.send_signal(signal.SIGTERM)
        for wrong in ("0", "65536", "-1", "a"):
            self.assertEqual(self.run_studio("--port", wrong).returncode, 2)

    def test_what_is_no_script_is_refused(self):
        run = self.run_studio("b.crt")
        self.assertEqual(run.returncode, 3)
        self.assertIn("crt new b.crt", run.stderr)
        run = self.run_studio("a.txt")
        self.assertEqual(run.returncode, 2)
        self.assertIn(".crt", run.stderr)

    def test_where_the_studio_is_not_installed_its_package_is_named(self):
        alone = self.folder / "crt"
        shutil.copy(COMMAND, alone)
        run = self.run_studio("a.crt", command=alone, env={"PATH": "/nonexistent"})
        self.assertEqual(run.returncode, 3)
        self.assertIn("crt-studio", run.stderr)


if __name__ == "__main__":
    unittest.main()

"""The tutorials quote files that are tested, word for word."""

import re
import unittest

from support import SOURCE

QUOTE = re.compile(r"^<!-- from (\S+) -->\n```\w+\n(.*?)^```$", re.DOTALL | re.MULTILINE)
LEFT_OUT = re.compile(r"^ *(?://|#) \.\.\.\n", re.MULTILINE)


class Tutorials(unittest.TestCase):
    def test_code_stands_in_the_file_that_is_named_above_it(self):
        pages = {
            "tutorial": 11, "tutorial_cpp": 6, "tutorial_python": 7, "measure": 7, "measured": 6
        }
        for name, least in pages.items():
            page = (SOURCE / f"docs/{name}.md").read_text()
            quotes = QUOTE.findall(page)
            self.assertGreaterEqual(len(quotes), least)
            for file, code in quotes:
                place = 0
                for piece in LEFT_OUT.split(code):
                    place = (SOURCE / file).read_text().find(piece, place)
                    self.assertGreaterEqual(place, 0, f"quoted from {file}:\n{piece}")
            marked = page.count("<!-- shell -->") + page.count("<!-- printed by ")
            self.assertEqual(page.count("\n```") / 2, len(quotes) + marked)

    def test_every_step_is_shown_with_its_picture(self):
        page = (SOURCE / "docs/tutorial.md").read_text()
        steps = sorted((SOURCE / "examples/tutorial").glob("*.crt"))
        self.assertEqual(len(steps), 7)
        for step in steps:
            self.assertIn(f"](../examples/tutorial/{step.name})", page)
            self.assertIn(f"](gallery/{step.stem}.png)", page)

    def test_what_a_program_is_said_to_print_is_what_its_test_expects(self):
        page = (SOURCE / "docs/tutorial_cpp.md").read_text()
        printed = re.search(r"<!-- printed by tutorial_rays -->\n```\n(.*?)```", page, re.DOTALL)
        expected = (SOURCE / "examples/CMakeLists.txt").read_text().replace("\\\\.", ".")
        for line in printed[1].splitlines():
            self.assertIn(f'"{line}\\n"', expected)


if __name__ == "__main__":
    unittest.main()

"""docs/bindings.md quotes files that are tested."""

import re
import unittest

from support import SOURCE


class Bindings(unittest.TestCase):
    def test_code_stands_in_the_file_that_is_named_above_it(self):
        page = (SOURCE / "docs/bindings.md").read_text()
        quotes = re.findall(
            r"^<!-- from (\S+) -->\n```\w+\n(.*?)^```$", page, re.DOTALL | re.MULTILINE
        )
        self.assertGreater(len(quotes), 5)
        for file, code in quotes:
            for piece in re.split(r"^ *(?://|#) \.\.\.\n", code, flags=re.MULTILINE):
                self.assertIn(piece, (SOURCE / file).read_text(), f"quoted from {file}")
        self.assertEqual(page.count("\n```") / 2, len(quotes) + page.count("<!-- shell -->"))

"""The checker of links finds what is wrong, and headings have the anchors that hosts give them."""

import pathlib
import tempfile
import unittest

import support  # noqa: F401

import check
import markdown


class Anchors(unittest.TestCase):
    def test_headings_lose_what_is_neither_letter_nor_digit(self):
        self.assertEqual(markdown.slug("Variables, and macros"), "variables-and-macros")
        self.assertEqual(markdown.slug("What suits: `crt trade`"), "what-suits-crt-trade")

    def test_equal_headings_are_numbered_and_code_has_none(self):
        text = "# A\n## B\n```\n# no heading\n```\n## B\n"
        self.assertEqual(list(markdown.anchors(text)), ["a", "b", "b-1"])


class Links(unittest.TestCase):
    def test_links_over_two_lines_count_and_code_does_not(self):
        text = "[a\nb](x.md#c) `[no](link.md)`\n```\n[no](y.md)\n```\n![p](q.png)\n"
        self.assertEqual(markdown.links(text), [("x.md#c", False), ("q.png", True)])

    def faults(self, body: str) -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / "other.html").write_text('<p id="here">other</p>')
            (site / "index.html").write_text(body)
            return check.site_faults(site)[0]

    def test_a_site_without_faults_has_none(self):
        self.assertEqual(self.faults('<a href="other.html#here">a</a><code>@ref</code>'), [])

    def test_what_is_missing_is_found(self):
        for body in (
            '<a href="missing.html">a</a>',
            '<a href="other.html#missing">a</a>',
            '<img src="missing.png">',
            '<img src="https://example.org/picture.png">',
            "<script src='missing.js'></script>",
            "see @ref other",
            "a `` ``` fence",
        ):
            self.assertEqual(len(self.faults(body)), 1, body)

    def test_a_menu_that_leads_nowhere_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / "navtreedata.js").write_text('[ "A", "missing.html", null ]')
            self.assertEqual(len(check.site_faults(site)[0]), 1)


class Conversion(unittest.TestCase):
    def test_links_headings_and_spans_become_what_doxygen_understands(self):
        page = pathlib.PurePath("docs/a.md")
        converter = markdown.Converter(pathlib.Path("/"), [page, pathlib.PurePath("docs/b.md")])
        text = "# A\n\n## B `c`\n\n[x\ny](b.md#z) `\\'` `[k](l)` ![p](g/q.png)\n"
        text = converter.convert(page, text)
        self.assertIn("# A {#a}", text)
        self.assertIn("## B c {#a--b-c}", text)
        self.assertIn("[x y](@ref b--z) <code>\\\\&apos;</code> `[k](l)`", text)
        self.assertIn('<img src="g/q.png" alt="p">', text)


if __name__ == "__main__":
    unittest.main()

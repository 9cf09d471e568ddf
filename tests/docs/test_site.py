"""The site is made without objections, all links lead somewhere, and nothing is left out."""

import os
import pathlib
import shutil
import unittest

from support import SOURCE

import check
import make
import markdown

SITE = pathlib.Path(os.environ["SITE"]).resolve()


@unittest.skipUnless(shutil.which("doxygen"), "SKIPPED: there is no Doxygen (Debian: doxygen)")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.objections = make.main(SITE)

    def html(self, name: str) -> str:
        return (SITE / "html" / f"{name}.html").read_text()

    def test_it_is_made_without_objections(self):
        self.assertEqual(self.objections, 0)

    def test_all_links_lead_somewhere(self):
        self.assertEqual(check.main(SITE / "html"), 0)

    def test_each_page_is_in_it_and_in_its_navigation(self):
        tree = (SITE / "html/navtreedata.js").read_text()
        for page in make.page_files():
            name = markdown.page_name(page)
            if name == "readme":
                name = "index"
            self.assertTrue((SITE / "html" / f"{name}.html").is_file(), page)
            if page.parts[0] == "docs":
                self.assertIn(f'"{name}.html"', tree)

    def test_it_has_the_references_of_all_three_languages(self):
        self.assertIn("crt::render", self.html("namespacecrt") + self.html("api"))
        self.assertIn("crt_render_start", self.html("crt_8h"))
        python = self.html("python_api")
        for name in ("Sphere", "Scene.from_script", "Prepared.crossings", "Image.save"):
            self.assertIn(name, python)

    def test_names_of_python_do_not_lead_to_those_of_cpp(self):
        bindings = self.html("bindings")
        self.assertIn('href="python_api.html#python_api--Sphere">crt.Sphere<', bindings)
        for file in (SITE / "html").glob("*.html"):
            self.assertNotRegex(file.read_text(), r'href="(class|struct)[^>]*>crt\.')

    def test_it_has_the_gallery_and_its_pictures(self):
        gallery = self.html("gallery")
        self.assertGreater(gallery.count("<img src"), 60)
        self.assertTrue((SITE / "html/gallery/demo.png").is_file())
        self.assertIn("<details>", gallery)

    def test_code_and_tables_are_code_and_tables(self):
        language = self.html("language")
        self.assertGreater(language.count('<div class="fragment">'), 25)
        self.assertGreater(language.count('<table class="markdownTable">'), 25)
        for quoted in ("<code>\\&#39;</code>", "<code>||</code>", "<code>-&gt;</code>"):
            self.assertIn(quoted, language.replace("'", "&#39;"))


if __name__ == "__main__":
    unittest.main()

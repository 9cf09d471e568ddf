"""What an editor shows of a script: diagnostics, completion, hovers, and where names go."""

import unittest

from client import ServerTest, apply_edits, span


class Diagnostics(ServerTest):
    def found(self, text, name="scene.crt"):
        self.open(text, name)
        return self.client.wait_for_diagnostics(self.uri(name))

    def test_a_good_script_has_none(self):
        self.assertEqual(self.found("Scene { }\n"), [])

    def test_errors_and_warnings_have_ranges(self):
        found = self.found("x = )\n")
        self.assertEqual([(d["severity"], d["range"]) for d in found], [(1, span(0, 4, 5))])
        found = self.found("Scene {\n    Sphere { center -> vec3(0, 0, 0) raduis -> 1 }\n}\n")
        self.assertEqual([d["range"] for d in found], [span(1, 37, 43)])
        self.assertIn("did you mean 'radius'", found[0]["message"])
        found = self.found("Scene {\n    3\n}\n")
        self.assertEqual([(d["severity"], d["range"]) for d in found], [(2, span(1, 4, 5))])

    def test_values_are_checked_by_running_the_script(self):
        found = self.found("r = -1\nScene { Sphere { center -> vec3(0, 0, 0) radius -> r } }\n")
        self.assertEqual([d["range"] for d in found], [span(1, 51, 52)])

    def test_columns_are_units_of_utf_16(self):
        found = self.found('Scene { print("é𝄞", unknown) }\n')
        self.assertEqual([d["range"] for d in found], [span(0, 21, 28)])

    def test_changes_are_followed(self):
        self.assertEqual(len(self.found("x = \nScene { print(x) }\n")), 1)
        self.change([{"range": span(0, 4, 4), "text": "1"}])
        self.assertEqual(self.client.wait_for_diagnostics(self.uri()), [])
        self.change([{"text": "Scene {\n"}], 3)
        self.assertEqual(len(self.client.wait_for_diagnostics(self.uri())), 1)

    def test_a_script_to_import_needs_no_scene(self):
        self.assertEqual(self.found("x = 1\n"), [])
        self.assertEqual(len(self.found("Settings { }\n")), 1)

    def test_imported_files_have_theirs_and_open_texts_win(self):
        (self.folder / "part.crt").write_text("y = )\n")
        self.open('import "part.crt"\nScene { print(y) }\n')
        self.assertEqual(len(self.client.wait_for_diagnostics(self.uri("part.crt"))), 1)
        self.open("y = 1\n", "part.crt")
        while self.client.wait_for_diagnostics(self.uri("part.crt")):
            pass

    def test_an_import_that_is_not_there_is_an_error(self):
        found = self.found('import "none.crt"\nScene { }\n')
        self.assertEqual([d["range"] for d in found], [span(0, 7, 17)])

    def test_closing_takes_them_away(self):
        self.assertEqual(len(self.found("x = )\n")), 1)
        self.client.notify("textDocument/didClose", self.document())
        self.assertEqual(self.client.wait_for_diagnostics(self.uri()), [])

    def test_pictures_are_looked_for_and_not_decoded(self):
        text = ('Settings { background -> Background { image -> "sky.png" } }\nScene { }\n')
        self.assertEqual(len(self.found(text)), 1)
        (self.folder / "sky.png").write_bytes(b"no picture")
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        self.assertEqual(self.client.wait_for_diagnostics(self.uri()), [])

    def test_endless_recursion_is_an_error_and_a_long_run_is_none(self):
        found = self.found("f = Macro () { f() }\nf()\nScene { }\n")
        self.assertIn("call one another", found[0]["message"])
        self.assertEqual(self.found("for (i in range(1000000)) { sin(i) }\nScene { }\n"), [])


class Completion(ServerTest):
    capabilities = {"textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}

    def offered(self, text):
        place = self.open(text)
        items = self.client.result("textDocument/completion", place)["items"]
        return {item["label"]: item for item in items}

    def test_attributes_that_are_not_set_yet(self):
        offered = self.offered("Scene { Sphere { radius -> 1 | } }\n")
        self.assertLessEqual({"center", "material"}, offered.keys())
        self.assertNotIn("radius", offered)
        offered = self.offered("Scene { Sphere { | radius -> 1 } }\n")
        self.assertEqual(offered.keys(), {"center", "material", "shadow", "visible"})
        self.assertEqual(offered["center"]["detail"], "Vec3, required")
        self.assertIn("default", offered["material"]["detail"])
        self.assertLess(offered["center"]["sortText"], offered["material"]["sortText"])
        self.assertEqual(offered["center"]["textEdit"]["newText"], "center -> ")

    def test_the_attribute_being_written(self):
        offered = self.offered("Scene { Torus { thi|ck -> 1 } }\n")
        self.assertEqual(offered["thickness"]["textEdit"],
                         {"range": span(0, 16, 21), "newText": "thickness"})

    def test_attributes_of_settings_have_the_references_text(self):
        item = self.offered("Settings { | }\n")["supersampling"]
        self.assertIn("rays for each pixel", item["documentation"]["value"])

    def test_an_open_brace_and_nothing_behind_it(self):
        self.assertEqual(self.offered("Scene {\n    Box { |").keys(),
                         {"cornerA", "cornerB", "material", "shadow", "visible"})

    def test_names_in_scope(self):
        offered = self.offered("a = 1\nm = Macro (p) {\n  b = 2\n  |\n}\n"
                               "later = 3\nif (true) { c = 1 }\n")
        self.assertLessEqual({"a", "b", "p", "m", "later", "Sphere", "sin", "pi", "if"},
                             offered.keys())
        self.assertFalse({"c", "Settings", "else"} & offered.keys())
        offered = self.offered("a = 1\nb = |\nlater = 3\n")
        self.assertIn("a", offered)
        self.assertFalse({"later", "while"} & offered.keys())

    def test_names_of_imports(self):
        (self.folder / "part.crt").write_text("tower = Macro (height, tint) { }\n")
        offered = self.offered('import "part.crt"\nScene { | }\n')
        self.assertEqual(offered["tower"]["detail"], "tower(height, tint)")
        self.assertIn("gold", self.offered('import "crt/metals"\nScene { | }\n'))

    def test_keywords_where_they_fit(self):
        self.assertLessEqual({"Settings", "Scene", "import", "for"}, self.offered("|").keys())
        self.assertIn("else", self.offered("if (true) { }\n|"))
        self.assertLessEqual({"scale", "translate", "rotate"},
                             self.offered("a = 1\nb = a <|").keys())
        self.assertLessEqual({"scale", "translate", "rotate"},
                             self.offered("a = 1\nb = a <scale 2, r|>").keys())

    def test_nothing_within_comments_strings_and_numbers(self):
        for text in ("-- a |\n", 'a = "x |', "a = 12|"):
            self.assertEqual(self.offered(text), {})

    def test_objects_come_with_what_they_need(self):
        item = self.offered("a = Sph|")["Sphere"]
        self.assertEqual(item["textEdit"]["newText"], "Sphere { center -> $1 radius -> $2 }$0")
        self.assertEqual(item["insertTextFormat"], 2)


class Hovers(ServerTest):
    def shown(self, text):
        hover = self.client.result("textDocument/hover", self.open(text))
        return hover and hover["contents"]["value"]

    def test_objects_attributes_and_built_ins_have_the_references_text(self):
        self.assertIn("All that lies behind a plane", self.shown("a = Pl|ane { }"))
        self.assertIn("radius of the tube", self.shown("a = Torus { thick|ness -> 1 }"))
        self.assertIn("value^(1/gamma)", self.shown("Settings { ga|mma -> 1 }"))
        self.assertIn("brighter than 1", self.shown("a = PointLight { colo|r -> 1 }"))
        self.assertIn("natural logarithm", self.shown("a = lo|g(2)"))
        self.assertIn("number of the frame", self.shown("a = t|"))
        self.assertIn("as long as the condition", self.shown("whi|le (true) { }"))
        self.assertIn("a factor for each axis", self.shown("a = 1 <sca|le 2>"))

    def test_names_show_how_they_were_set_and_the_comment_above(self):
        shown = self.shown("-- How many\n-- there are.\nn = 18\nScene { print(n|) }\n")
        self.assertIn("n = 18", shown)
        self.assertIn("How many\nthere are.", shown)
        self.assertIn("f(a, b)", self.shown("f = Macro (a, b) { }\nf|(1, 2)\n"))
        self.assertIn("parameter a", self.shown("f = Macro (a) { print(a|) }\n"))

    def test_what_is_set_in_the_script_hides_the_built_in(self):
        self.assertIn("max = 18", self.shown("max = 18\nprint(ma|x)\n"))

    def test_where_there_is_nothing_to_say(self):
        for text in ("a = |1", "|\n", 'a = "sp|here"', "-- Sph|ere\n", "a = unk|nown"):
            self.assertIsNone(self.shown(text))


class Names(ServerTest):
    def definition(self, text):
        found = self.client.result("textDocument/definition", self.open(text))
        return found and (found["uri"], found["range"])

    def test_definitions(self):
        self.assertEqual(self.definition("x = 1\nScene { print(|x) }\n"),
                         (self.uri(), span(0, 0, 1)))
        self.assertEqual(self.definition("m = Macro (p, q) {\n print(q|)\n}\n"),
                         (self.uri(), span(0, 14, 15)))
        self.assertEqual(self.definition("Scene { m|() }\nm = Macro () { }\n"), None)
        self.assertEqual(self.definition("f = Macro () { m|() }\nm = Macro () { }\n"),
                         (self.uri(), span(1, 0, 1)))

    def test_definitions_in_imports(self):
        (self.folder / "part.crt").write_text("a = 1\nhigh = 2\n")
        text = 'import "part.crt"\nScene { print(high) }\n'
        self.assertEqual(self.definition(text.replace("high", "hi|gh")),
                         (self.uri("part.crt"), span(1, 0, 4)))
        self.assertEqual(self.definition(text.replace("part", "pa|rt"))[0], self.uri("part.crt"))
        self.assertIsNone(self.definition('import "no|ne.crt"\n'))

    def rename(self, text, new_name):
        place = self.open(text)
        answer = self.client.ask("textDocument/rename", {**place, "newName": new_name})
        if "error" in answer:
            return answer["error"]["message"]
        changes = answer["result"]["changes"]
        return apply_edits(text.replace("|", ""), changes[self.uri()])

    def test_rename_keeps_to_the_scope(self):
        self.assertEqual(
            self.rename("x| = 1\nf = Macro () { x = 2\n y = x }\nprint(x)\n", "width"),
            "width = 1\nf = Macro () { x = 2\n y = x }\nprint(width)\n")
        self.assertEqual(self.rename("for (i in [1]) {\n print(i|)\n}\ni = 2\n", "k"),
                         "for (k in [1]) {\n print(k)\n}\ni = 2\n")

    def test_collisions_are_refused(self):
        for text, name in (("x| = 1\ny = 2\n", "y"), ("x| = 1\nprint(sin(x))\n", "sin"),
                           ("x| = 1\nf = Macro (y) { print(x) }\n", "y"),
                           ("y = 1\nif (true) {\n x| = 2\n}\n", "y")):
            self.assertIn("already means", self.rename(text, name))

    def test_names_that_are_none_are_refused(self):
        for name in ("", "while", "Big", "a b", "1a", "é", "a -- b", "a\n", "scale", "a" * 300):
            self.assertIn("no name", self.rename("x| = 1\n", name))
        self.assertIn("no name here", self.rename("x = 1 |\n", "y"))
        self.assertIn("no name here", self.rename("x = si|n(1)\n", "y"))

    def test_a_script_with_syntax_errors_is_not_renamed(self):
        self.assertIn("syntax errors", self.rename("x| = 1\ny = (x\n", "z"))

    def test_rename_reaches_imports_and_other_open_scripts(self):
        self.open("size = 1\n", "part.crt")
        self.open('import "part.crt"\nprint(size)\n', "other.crt")
        place = self.open('import "part.crt"\nScene { print(siz|e) }\n')
        changes = self.client.result("textDocument/rename",
                                     {**place, "newName": "width"})["changes"]
        self.assertEqual({uri: [edit["range"] for edit in edits]
                          for uri, edits in changes.items()},
                         {self.uri(): [span(1, 14, 18)], self.uri("part.crt"): [span(0, 0, 4)],
                          self.uri("other.crt"): [span(1, 6, 10)]})

    def test_prepare_rename(self):
        self.assertEqual(self.client.result("textDocument/prepareRename", self.open("ab|c = 1\n")),
                         span(0, 0, 3))
        self.assertIsNone(self.client.result("textDocument/prepareRename",
                                             self.open("x = si|n(1)")))

    def test_references_and_highlights(self):
        place = self.open("x = 1\nx| = x + 1\n")
        expected = [span(0, 0, 1), span(1, 0, 1), span(1, 4, 5)]
        found = self.client.result("textDocument/references", place)
        self.assertEqual([location["range"] for location in found], expected)
        found = self.client.result("textDocument/documentHighlight", place)
        self.assertEqual([location["range"] for location in found], expected)

    def test_symbols(self):
        self.open("x = 1\nm = Macro () {\n}\nScene {\n}\n")
        found = self.client.result("textDocument/documentSymbol", self.document())
        self.assertEqual([(s["name"], s["kind"], s["range"]["end"]["line"]) for s in found],
                         [("x", 13, 0), ("m", 12, 2), ("Scene", 2, 4)])


class Formatting(ServerTest):
    def formatted(self, text):
        self.open(text)
        edits = self.client.result("textDocument/formatting", {**self.document(), "options": {}})
        return None if edits is None else apply_edits(text, edits)

    def test_the_edits_make_the_formatted_text(self):
        for text, expected in (("Scene {\nx=1\n}", "Scene {\n    x = 1\n}\n"),
                               ("a = 1\nb=2\nc = 3\n", "a = 1\nb = 2\nc = 3\n"),
                               ("a = 1\n\n\n\n", "a = 1\n"), ("a = 1\n", "a = 1\n"),
                               ("\n\nx = 1\n", "x = 1\n"), ("x = 1", "x = 1\n")):
            self.assertEqual(self.formatted(text), expected)

    def test_a_script_with_errors_is_left_alone(self):
        self.assertIsNone(self.formatted("a=(\n"))


class Utf8(ServerTest):
    capabilities = {"general": {"positionEncodings": ["utf-8", "utf-16"]}}

    def test_positions_count_bytes_where_the_client_can(self):
        self.assertEqual(self.server["capabilities"]["positionEncoding"], "utf-8")
        self.open('Scene { print("é𝄞", unknown) }\n')
        found = self.client.wait_for_diagnostics(self.uri())
        self.assertEqual([d["range"] for d in found], [span(0, 24, 31)])


if __name__ == "__main__":
    unittest.main()

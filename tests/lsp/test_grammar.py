"""The TextMate grammar colours scripts as the server does, whose tokens are the front end's."""

import json
import re
import unittest
from pathlib import Path

from client import ServerTest

ROOT = Path(__file__).resolve().parents[2]
VSCODE = ROOT / "editors" / "vscode"
GRAMMAR = json.loads((VSCODE / "syntaxes" / "crt.tmLanguage.json").read_text())

# What each of the server's types is in the grammar's scopes.
SCOPES = {
    "comment": "comment.", "string": "string.", "number": "constant.numeric.",
    "keyword": ("keyword.control.", "keyword.other.", "storage.", "constant.language."),
    "class": "entity.name.type.", "property": "variable.other.property.",
    "variable": ("variable.", "entity.name.function."), "parameter": "variable.",
    "function": ("support.function.", "entity.name.function.", "variable."),
}


def rules(patterns):
    """Lists the rules that patterns lead to, in their order."""
    for pattern in patterns:
        if "include" in pattern:
            yield from rules([GRAMMAR["repository"][pattern["include"][1:]]])
        elif "match" in pattern or "begin" in pattern:
            yield pattern
        else:
            yield from rules(pattern["patterns"])


RULES = [(re.compile(rule.get("match") or rule["begin"]), rule)
         for rule in rules(GRAMMAR["patterns"])]


VALUE, = [rule["begin"] for rule in GRAMMAR["repository"]["string"]["patterns"]
          if "begin" in rule]
PIECE = re.compile(rf'(?:(?!{VALUE})\\.|[^"\\])*("|{VALUE}|$)')
BRACE = re.compile("[{}]")


def scopes_of(line):
    """Returns (begin, end, scope) of all pieces of a line, as an editor finds them."""
    place = 0
    open_braces = []  # within each value in a string
    while place < len(line):
        brace = BRACE.search(line, place) if open_braces else None
        found = [(match.start(), i, match, rule) for i, (regex, rule) in enumerate(RULES)
                 if (match := regex.search(line, place))]
        _, _, match, rule = min(found, key=lambda f: f[:2], default=(0, 0, None, None))
        if brace and not (match and match.start() < brace.start()):
            place = brace.end()
            open_braces[-1] += 1 if brace[0] == "{" else -1
            if open_braces[-1] > 0:
                continue
            open_braces.pop()
            match, rule = brace, GRAMMAR["repository"]["string"]
        if not match:
            return
        place = match.end()
        if "begin" in rule:
            piece = PIECE.match(line, place)
            place = piece.end()
            if piece[1].startswith("\\"):
                open_braces.append(1)
            yield match.start(), place, rule["name"]
        elif "captures" in rule:
            for number, capture in rule["captures"].items():
                yield (*match.span(int(number)), capture["name"])
        else:
            yield *match.span(), rule["name"]


class Grammar(ServerTest):
    capabilities = {"general": {"positionEncodings": ["utf-8"]}}

    def server_tokens(self, text):
        self.open(text.replace("|", " "))
        types = self.server["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
        data = self.client.result("textDocument/semanticTokens/full", self.document())["data"]
        line = column = 0
        for i in range(0, len(data), 5):
            lines, columns, length, kind, _ = data[i:i + 5]
            line, column = line + lines, columns if lines else column + columns
            yield line, column, column + length, types[kind]

    def check(self, text):
        # The client's tests take '|' for the cursor, and the columns count bytes.
        text = text.replace("||", "&&").encode("ascii", "replace").decode()
        lines = text.split("\n")
        scopes = [{(begin, end): scope for begin, end, scope in scopes_of(line)}
                  for line in lines]
        for line, begin, end, kind in self.server_tokens(text):
            scope = scopes[line].get((begin, end))
            self.assertTrue(scope and scope.startswith(SCOPES[kind]),
                            f"{lines[line]!r} [{begin}:{end}]: {kind} is {scope}")

    def test_the_examples(self):
        paths = sorted((ROOT / "examples" / "scenes").glob("*.crt"))
        self.assertGreater(len(paths), 20)
        for path in paths:
            with self.subTest(path.name):
                self.check(path.read_text())

    def test_the_examples_of_the_reference(self):
        page = (ROOT / "docs" / "language.md").read_text()
        for text in re.findall(r"```crt\n(.*?)```", page, re.DOTALL):
            with self.subTest(text):
                self.check(text)

    def test_what_is_easily_mistaken(self):
        for text in ('x = "a -- \\" b" -- "c"\n', "a = 1.5e-3 + .5 + 2.\n",
                     "scale = Macro () { }\n", "a = Noise { scale -> 2 in -> 3 }\n",
                     "b = a <scale 2, rotate a>\n", "x1 = x1-1\n", "pi = t\n",
                     'a = "x \\{str({ b -> "}" }.b)} y \\{"\\{1}"} z" + "w"\n',
                     "a = vec3(1, 2, 3).x + b.in[1:].scale\n", "a = 45deg + 1.5rad\n",
                     'import "a" as b\nas = 1\n', "for (a, b in c) { break continue }\n",
                     'a = { in -> 1, "b c" -> { } }\n'):
            self.check(text)

    def test_the_files_name_one_another(self):
        package = json.loads((VSCODE / "package.json").read_text())
        self.assertTrue((VSCODE / package["main"]).is_file())
        language, = package["contributes"]["languages"]
        json.loads((VSCODE / language["configuration"]).read_text())
        grammar, = package["contributes"]["grammars"]
        self.assertEqual(grammar["scopeName"], GRAMMAR["scopeName"])
        self.assertTrue((VSCODE / grammar["path"]).is_file())


if __name__ == "__main__":
    unittest.main()

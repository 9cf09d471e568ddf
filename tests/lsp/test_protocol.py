"""The server's life, and what clients do wrong: it answers, and lives on."""

import json
import unittest

from client import Client, ServerTest, framed

SCENE = "Scene { }\n"


class Life(unittest.TestCase):
    def setUp(self):
        self.client = Client()
        self.addCleanup(self.client.kill)

    def test_shutdown_then_exit_ends_with_0(self):
        self.client.result("initialize", {"capabilities": {}})
        self.assertIsNone(self.client.result("shutdown"))
        self.client.notify("exit")
        self.assertEqual(self.client.end(), 0)

    def test_exit_without_shutdown_ends_with_1(self):
        self.client.result("initialize", {"capabilities": {}})
        self.client.notify("exit")
        self.assertEqual(self.client.end(), 1)

    def test_end_of_input_ends_the_server(self):
        self.assertEqual(self.client.end(), 1)

    def test_what_came_before_the_end_of_input_is_answered(self):
        self.client.send({"jsonrpc": "2.0", "id": 7, "method": "initialize",
                          "params": {"capabilities": {}}})
        self.client.process.stdin.close()
        self.assertEqual(self.client.answer()["id"], 7)
        self.client.process.stdout.close()
        self.assertEqual(self.client.process.wait(), 1)

    def test_requests_before_initialize_are_refused(self):
        self.assertEqual(self.client.error("textDocument/hover", {})["code"], -32002)
        self.client.result("initialize", {"capabilities": {}})

    def test_initialize_comes_once(self):
        self.client.result("initialize", {"capabilities": {}})
        self.assertEqual(self.client.error("initialize", {"capabilities": {}})["code"], -32600)

    def test_requests_after_shutdown_are_refused(self):
        self.client.result("initialize", {"capabilities": {}})
        self.client.result("shutdown")
        self.assertEqual(self.client.error("textDocument/hover", {})["code"], -32600)

    def test_odd_parameters_of_initialize_do_no_harm(self):
        self.client.result("initialize", {
            "capabilities": {"general": {"positionEncodings": "utf-8"}, "textDocument": []},
            "rootUri": 5, "initializationOptions": {"resources": 3}})

    def test_encoding_is_utf_16_unless_utf_8_is_offered(self):
        offered = {"general": {"positionEncodings": ["utf-32", "utf-16"]}}
        result = self.client.result("initialize", {"capabilities": offered})
        self.assertEqual(result["capabilities"]["positionEncoding"], "utf-16")


class Misuse(ServerTest):
    def still_lives(self):
        self.assertIsNone(self.client.result("shutdown"))
        self.client.notify("exit")
        self.assertEqual(self.client.end(), 0)

    def refused(self, body, code):
        self.client.send_bytes(framed(body))
        answer = self.client.answer()
        self.assertIsNone(answer["id"])
        self.assertEqual(answer["error"]["code"], code)

    def test_what_is_no_json(self):
        for body in (b"", b"{", b"nonsense", b'{"a": "\xff"}', b"\x00\x01"):
            self.refused(body, -32700)
        self.still_lives()

    def test_json_that_is_no_request(self):
        for body in (b"[]", b"3", b"null", b"{}", b'{"id": 1}', b'{"method": 5}',
                     b'{"method": "shutdown", "id": {}}'):
            self.client.send_bytes(framed(body))
            self.assertEqual(self.client.answer()["error"]["code"], -32600, body)
        self.still_lives()

    def test_deep_json(self):
        deep = b"[" * 200000 + b"]" * 200000
        for body in (b'{"id": 1, "method": "x", "params": ' + deep + b"}",
                     b'{"method": "x", "id": ' + deep + b"}", deep):
            self.client.send_bytes(framed(body))
            answer = self.client.answer()
            self.assertEqual((answer["id"], answer["error"]["code"]), (None, -32700))
        self.still_lives()

    def test_ids_are_whole_numbers_or_short_texts(self):
        for name in (b"1.5", b"true", b"[]", b"{}", b'"' + b"a" * 129 + b'"'):
            self.client.send_bytes(framed(b'{"method": "x", "id": ' + name + b"}"))
            answer = self.client.answer()
            self.assertEqual((answer["id"], answer["error"]["code"]), (None, -32600))
        self.still_lives()

    def test_headers_that_are_none(self):
        for header in (b"Hello\r\n\r\n", b"Content-Length: x\r\n\r\n",
                       b"Content-Length: -5\r\n\r\n", b"A" * 20000):
            self.client.send_bytes(header)
            self.assertEqual(self.client.answer()["error"]["code"], -32700, header[:30])
            if not header.endswith(b"\n"):
                self.client.send_bytes(b"\r\n\r\n")
                self.assertEqual(self.client.answer()["error"]["code"], -32700)
        self.still_lives()

    def test_other_headers_and_pieces_of_messages_are_fine(self):
        message = json.dumps({"jsonrpc": "2.0", "id": "é", "method": "none"}).encode()
        data = b"Content-Type: x\r\ncontent-length:  %d \r\n\r\n" % len(message) + message
        for i in range(len(data)):
            self.client.send_bytes(data[i:i + 1])
        answer = self.client.answer()
        self.assertEqual((answer["id"], answer["error"]["code"]), ("é", -32601))

    def test_a_message_that_is_too_long_is_passed_over(self):
        length = (256 << 20) + 1
        self.client.send_bytes(b"Content-Length: %d\r\n\r\n" % length)
        self.assertEqual(self.client.answer()["error"]["code"], -32700)
        block = b" " * (1 << 20)
        for _ in range(256):
            self.client.send_bytes(block)
        self.client.send_bytes(b" ")
        self.still_lives()

    def test_unknown_methods(self):
        self.assertEqual(self.client.error("textDocument/unheardOf", {})["code"], -32601)
        self.client.notify("unheardOf")
        self.client.notify("$/setTrace", {"value": "off"})
        self.still_lives()

    def test_wrong_parameters(self):
        self.open(SCENE)
        here = self.document()
        for params in (None, [], {}, {"textDocument": 3}, {"textDocument": {"uri": 3}}, here,
                       {**here, "position": {"line": "x", "character": 0}},
                       {**here, "position": []}):
            self.assertEqual(self.client.error("textDocument/hover", params)["code"], -32602)
        unopened = {"textDocument": {"uri": "file:///none.crt"},
                    "position": {"line": 0, "character": 0}}
        self.assertEqual(self.client.error("textDocument/hover", unopened)["code"], -32602)
        self.still_lives()

    def test_wrong_notifications_are_logged(self):
        self.client.notify("textDocument/didOpen", {"textDocument": 1})
        self.change([{"text": "x"}])
        self.client.notify("textDocument/didClose", {"textDocument": {"uri": "file:///none"}})
        self.client.error("none")
        self.assertEqual(len(self.client.logged), 2)
        self.still_lives()

    def test_positions_outside_of_the_text(self):
        self.open("x = 1\nScene { }\n")
        most = 2 ** 31 - 1
        for line, character in ((most, most), (0, most), (99, 0), (-1, -5), (2 ** 40, 1.5)):
            place = {**self.document(), "position": {"line": line, "character": character}}
            for method in ("hover", "completion", "definition", "references"):
                self.client.result("textDocument/" + method, place)
        self.still_lives()

    def test_changes_with_ranges_that_are_none(self):
        self.open("abc\n")
        backwards = {"start": {"line": 0, "character": 3}, "end": {"line": 0, "character": 1}}
        beyond = {"start": {"line": 5, "character": 0}, "end": {"line": 9, "character": 9}}
        self.change([{"range": backwards, "text": "X"}, {"range": beyond, "text": "Y"}])
        self.client.wait_for_diagnostics(self.uri())
        self.still_lives()

    def test_a_queued_request_can_be_cancelled(self):
        place = {**self.document(), "position": {"line": 0, "character": 0}}
        messages = [{"jsonrpc": "2.0", "id": 100, "method": "textDocument/hover", "params": place},
                    {"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 100}},
                    {"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 5}},
                    {"jsonrpc": "2.0", "method": "$/cancelRequest", "params": 3}]
        # All of it fits into what the server reads at once.
        self.client.send_bytes(b"".join(framed(json.dumps(m).encode()) for m in messages))
        answer = self.client.answer()
        self.assertEqual((answer["id"], answer["error"]["code"]), (100, -32800))
        self.still_lives()

    def test_a_huge_document(self):
        text = "Scene {\n" + "    Sphere { center -> vec3(0, 0, 0) radius -> 1 }\n" * 100000 + "}\n"
        place = self.open(text)
        found = self.client.wait_for_diagnostics(self.uri())
        self.assertEqual(found[0]["severity"], 2)
        self.assertIn("not checked", found[0]["message"])
        place["position"] = {"line": 50000, "character": 6}
        self.assertIn("Sphere", self.client.result("textDocument/hover",
                                                   place)["contents"]["value"])
        self.still_lives()

    def test_scripts_that_would_run_forever_end(self):
        for text in ("while (true) { }\nScene { }\n", "f = Macro () { f() f() }\nf()\nScene { }\n",
                     "x = [1]\nwhile (true) { x = x + x }\nScene { }\n"):
            self.open(text)
            self.client.wait_for_diagnostics(self.uri())
        self.still_lives()

    def test_texts_that_are_no_scripts(self):
        for text in ("\u0000\u0001", "{" * 5000, "é𝄞\u2028" * 100, "\"", "}" * 5000, "<" * 300,
                     "a = " * 1000):
            self.open(text)
            self.client.wait_for_diagnostics(self.uri())
            for character in (0, 1, 3):
                place = {**self.document(), "position": {"line": 0, "character": character}}
                self.client.result("textDocument/completion", place)
                self.client.result("textDocument/hover", place)
            self.client.result("textDocument/documentSymbol", self.document())
            self.assertIsNone(self.client.result("textDocument/formatting", {
                **self.document(), "options": {}}))
        self.still_lives()


if __name__ == "__main__":
    unittest.main()

"""The studio on a network: by TLS, by the names that lead to it, and among those who disturb."""

import pathlib
import random
import re
import signal
import socket
import ssl
import subprocess
import tempfile
import unittest

from client import COMMAND, SECONDS, Client, Server

SCENE = """Settings { width -> 64 height -> 48 }
Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }
"""
MANY = 200  # more than the connections that the server has at once


EC = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1"]
RSA = ["-newkey", "rsa:2048"]


def make_certificate(folder, name, *more, kind=EC):
    """Makes a certificate that names this machine, and its key. Returns both files."""
    certificate, key = folder / f"{name}.pem", folder / f"{name}.key"
    subprocess.run(
        ["openssl", "req", "-x509", *kind, *(more or ["-nodes"]),
         "-keyout", key, "-out", certificate, "-days", "2", "-subj", "/CN=localhost",
         "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1,IP:::1"],
        check=True, capture_output=True,
    )  # fmt: skip
    return str(certificate), str(key)


class Network(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.keys = pathlib.Path(temporary.name)
        cls.certificate, cls.key = make_certificate(cls.keys, "own")

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "a.crt").write_text(SCENE)

    def serve(self, *words, certificate=None):
        server = Server(self.folder, "a.crt", words, certificate)
        self.addCleanup(server.end)
        return server

    def serve_by_tls(self):
        return self.serve(
            f"tls-cert={self.certificate}", f"tls-key={self.key}", certificate=self.certificate
        )

    def client(self, server):
        client = Client(server)
        self.addCleanup(client.close)
        return client

    def upgrade_status(self, server, **how):
        connection, status, _, _ = server.upgrade(**how)
        connection.close()
        return status

    def refused(self, *words):
        """Runs the command with words that it must refuse. Returns its code and what it says."""
        run = subprocess.run(
            [COMMAND, "studio", *words, self.folder / "a.crt"],
            capture_output=True, text=True, timeout=SECONDS, check=False,
        )  # fmt: skip
        self.assertEqual(run.stdout, "")
        return run.returncode, run.stderr

    # ---- TLS

    def test_by_tls_the_page_comes_and_a_script_is_rendered_and_saved(self):
        server = self.serve_by_tls()
        self.assertEqual(server.scheme, "https")
        connection, status, head, rest = server.request("/studio.js")
        size = int(re.search(r"Content-Length: (\d+)", head)[1])
        while len(rest) < size:
            rest += connection.recv(1 << 20)
        connection.close()
        self.assertEqual((status, len(rest)), (200, size))
        client = self.client(server)
        client.open("a.crt")
        client.set_text(SCENE)
        client.finish()
        self.assertTrue(client.picture().startswith(b"\x89PNG"))
        client.send(type="save", script="a.crt", text="-- saved\n")
        client.wait("saved")
        self.assertEqual((self.folder / "a.crt").read_text(), "-- saved\n")
        self.assertEqual(server.end(), 0)

    def cipher(self, server, version, ciphers):
        """Returns the cipher that a browser gets that knows these alone, or None."""
        browser = ssl.create_default_context(cafile=server.certificate)
        browser.minimum_version = browser.maximum_version = version
        if ciphers:
            # Without the level a browser would not offer what is weak.
            browser.set_ciphers(ciphers + ":@SECLEVEL=0")
        connection = socket.create_connection((server.host, server.port), SECONDS)
        try:
            with browser.wrap_socket(connection, server_hostname="localhost") as wrapped:
                self.assertFalse(wrapped.session and wrapped.session.has_ticket)
                return wrapped.cipher()[0]
        except ssl.SSLError:
            return None
        finally:
            connection.close()

    def test_what_is_recorded_is_read_by_nobody_who_gets_the_key_later_nor_changed(self):
        certificate, key = make_certificate(self.keys, "rsa", kind=RSA)
        server = self.serve(f"tls-cert={certificate}", f"tls-key={key}", certificate=certificate)
        server.certificate = certificate
        old, new = ssl.TLSVersion.TLSv1_2, ssl.TLSVersion.TLSv1_3
        for fine in ("ECDHE-RSA-AES128-GCM-SHA256", "ECDHE-RSA-AES256-GCM-SHA384",
                     "ECDHE-RSA-CHACHA20-POLY1305"):  # fmt: skip
            self.assertEqual(self.cipher(server, old, fine), fine)
        self.assertRegex(self.cipher(server, new, ""), "GCM|POLY1305")
        # The first two lack forward secrecy, and the others are no AEAD.
        for weak in ("AES128-GCM-SHA256", "AES256-GCM-SHA384", "ECDHE-RSA-AES128-SHA256",
                     "ECDHE-RSA-AES256-SHA384", "ECDHE-RSA-AES128-SHA", "AES128-SHA",
                     "ALL:!ECDHE"):  # fmt: skip
            with self.subTest(weak):
                self.assertIsNone(self.cipher(server, old, weak))
        self.assertEqual(server.status("/"), 200)

    def test_the_key_may_be_in_the_certificates_file(self):
        both = self.keys / "both.pem"
        texts = [pathlib.Path(file).read_text() for file in (self.certificate, self.key)]
        both.write_text("".join(texts))
        server = self.serve(f"tls-cert={both}", certificate=self.certificate)
        self.assertEqual(server.status("/"), 200)

    def test_an_origin_by_http_is_not_that_of_a_page_by_https(self):
        server = self.serve_by_tls()
        host = f"{server.host}:{server.port}"
        self.assertEqual(self.upgrade_status(server, origin=f"http://{host}"), 403)
        self.assertEqual(self.upgrade_status(server, origin=f"https://{host}"), 101)
        self.assertEqual(self.upgrade_status(server, origin=f"https://{host}", token="0" * 32), 403)

    def test_a_certificate_or_key_that_is_none_is_refused_by_its_name(self):
        noise = self.keys / "noise.pem"
        noise.write_text("no certificate\n")
        empty = self.keys / "empty.pem"
        empty.touch()
        _, other_key = make_certificate(self.keys, "other")
        _, secret_key = make_certificate(self.keys, "secret", "-passout", "pass:secret")
        missing = str(self.keys / "missing.pem")
        for certificate, key, named, why in (
            (missing, self.key, missing, "cannot be read"),
            (self.certificate, missing, missing, "cannot be read"),
            (str(empty), self.key, str(empty), "is empty"),
            (str(self.keys), self.key, str(self.keys), "cannot be read"),
            (str(noise), self.key, str(noise), "is no certificate in PEM"),
            (self.key, self.key, self.key, "is no certificate in PEM"),
            (self.certificate, str(noise), str(noise), "is no private key in PEM"),
            (self.certificate, self.certificate, self.certificate, "is no private key in PEM"),
            (self.certificate, other_key, other_key, "is not the key of"),
            (self.certificate, secret_key, secret_key, "that needs no password"),
        ):
            with self.subTest(named, why=why):
                code, said = self.refused("--tls-cert", certificate, "--tls-key", key)
                self.assertEqual(code, 3, said)
                self.assertIn(f"'{named}'", said)
                self.assertIn(why, said)

    def test_words_that_say_nothing_are_refused(self):
        for words, why in (
            (["--tls-key", self.key], "--tls-cert"),
            (["--listen", "example.org"], "--listen needs an IP address"),
            (["--listen", "[127.0.0.1]"], "--listen needs an IP address"),
            (["--listen", ""], "--listen needs an IP address"),
            (["--name", "host:80"], "--name needs the name of a machine"),
            (["--name", "a/b"], "--name needs the name of a machine"),
        ):
            with self.subTest(words):
                code, said = self.refused(*words)
                self.assertEqual(code, 2)
                self.assertIn(why, said)
        code, said = self.refused("--listen", "203.0.113.7")
        self.assertEqual(code, 3)
        self.assertIn("cannot listen on 203.0.113.7:0", said)

    # ---- those who disturb

    def send(self, server, data):
        """Sends bytes to the port, and waits until the server has done with them."""
        connection = socket.create_connection((server.host, server.port), SECONDS)
        try:
            connection.sendall(data)
            connection.shutdown(socket.SHUT_WR)
            received = b""
            while piece := connection.recv(65536):
                received += piece
            return received
        except OSError:
            return b""  # the server was done with it before
        finally:
            connection.close()

    def hello(self, server):
        """Returns the first bytes that a browser sends by TLS."""
        incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
        shaking = server.tls.wrap_bio(incoming, outgoing, server_hostname="localhost")
        with self.assertRaises(ssl.SSLWantReadError):
            shaking.do_handshake()
        return outgoing.read()

    def test_noise_where_tls_is_expected_ends_its_connection_alone(self):
        server = self.serve_by_tls()
        client = self.client(server)
        choose = random.Random(7)
        hello = self.hello(server)
        for _ in range(150):
            self.send(server, choose.randbytes(choose.randrange(400)))
            changed = bytearray(hello)
            for _ in range(choose.randrange(1, 6)):
                changed[choose.randrange(len(changed))] = choose.randrange(256)
            self.send(server, bytes(changed[: choose.randrange(len(changed) + 1)]))
            self.send(server, bytes(changed))
            self.send(server, hello + choose.randbytes(200))
        self.assertEqual(client.open("a.crt"), SCENE)
        self.assertEqual(server.status("/"), 200)

    def test_http_where_tls_is_expected_gets_nothing(self):
        server = self.serve_by_tls()
        request = f"GET / HTTP/1.1\r\nHost: {server.host}:{server.port}\r\n\r\n".encode()
        self.assertNotIn(b"HTTP/1.1 200", self.send(server, request))
        self.assertEqual(server.status("/"), 200)

    def test_noise_within_tls_ends_its_connection_alone(self):
        server = self.serve_by_tls()
        server.send_noise()
        self.assertEqual(server.status("/"), 200)

    def connect_many(self, server, data):
        """Opens many connections that say a part of this each, and do not wait for an answer."""
        connections = []
        for count in range(MANY):
            connection = socket.create_connection((server.host, server.port), SECONDS)
            self.addCleanup(connection.close)
            connection.sendall(data[: count % len(data)])
            connection.setblocking(False)
            connections.append(connection)
        return connections

    def test_those_who_never_finish_their_handshake_keep_nobody_out(self):
        server = self.serve_by_tls()
        client = self.client(server)
        hello = self.hello(server)
        slow = self.connect_many(server, hello)
        self.assertEqual(server.status("/"), 200)
        self.assertEqual(slow[0].recv(1), b"")
        self.assertEqual(client.open("a.crt"), SCENE)
        self.assertEqual(self.client(server).open("a.crt"), SCENE)

    def test_a_handshake_that_takes_too_long_is_ended(self):
        server = self.serve_by_tls()
        slow = socket.create_connection((server.host, server.port), SECONDS)
        self.addCleanup(slow.close)
        slow.sendall(self.hello(server)[:50])
        self.assertEqual(slow.recv(1), b"")

    def test_those_who_never_ask_keep_nobody_out(self):
        server = self.serve()
        client = self.client(server)
        slow = self.connect_many(server, b"GET / HTTP/1.1\r\n")
        self.assertEqual(server.status("/"), 200)
        self.assertEqual(slow[0].recv(1), b"")
        self.assertEqual(client.open("a.crt"), SCENE)

    # ---- names

    def test_an_address_of_ipv6_stands_in_brackets(self):
        try:
            socket.create_server(("::1", 0), family=socket.AF_INET6).close()
        except OSError as failure:
            self.skipTest(f"this machine has no ::1: {failure}")
        for words, certificate in (
            ([], None),
            ([f"tls-cert={self.certificate}", f"tls-key={self.key}"], self.certificate),
        ):
            server = self.serve("listen=::1", *words, certificate=certificate)
            self.assertEqual(server.host, "[::1]")
            self.assertEqual(server.status("/"), 200)
            self.assertEqual(server.status("/", host=f"[0:0::1]:{server.port}"), 200)
            self.assertEqual(server.status("/", host=f"::1:{server.port}"), 421)
            self.assertEqual(self.client(server).open("a.crt"), SCENE)

    def test_on_all_addresses_any_address_and_the_machines_names_lead_to_it(self):
        server = self.serve("listen=0.0.0.0")
        port = server.port
        for host in (server.host, "127.0.0.1", "192.0.2.99", "[2001:db8::1]", "localhost",
                     socket.gethostname(), socket.gethostname().upper()):  # fmt: skip
            with self.subTest(host):
                self.assertEqual(server.status("/", host=f"{host}:{port}"), 200)
                own = {"host": f"{host}:{port}", "origin": f"http://{host}:{port}"}
                self.assertEqual(self.upgrade_status(server, **own), 101)
        for host in ("evil.example", "1.2.3.4.evil.example", "0x7f000001", "1.2.3", "[::1", ""):
            with self.subTest(host):
                self.assertEqual(server.status("/", host=f"{host}:{port}"), 421)
                own = {"host": f"{host}:{port}", "origin": f"http://{host}:{port}"}
                self.assertEqual(self.upgrade_status(server, **own), 421)
        self.assertEqual(self.upgrade_status(server, origin="http://evil.example"), 403)

    def test_on_one_address_no_other_leads_to_it(self):
        server = self.serve("listen=127.0.0.1", "name=studio.example")
        self.assertEqual(server.host, "studio.example")
        server.host = "127.0.0.1"
        for host, status in (("studio.example", 200), ("Studio.Example", 200), ("127.0.0.1", 200),
                             ("192.0.2.99", 421), ("evil.example", 421)):  # fmt: skip
            with self.subTest(host):
                self.assertEqual(server.status("/", host=f"{host}:{server.port}"), status)

    def test_without_encryption_other_machines_are_warned_of(self):
        for words, is_warned in (
            (["--listen", "0.0.0.0"], True),
            (["--listen", "127.0.0.1"], False),
            (["--listen", "0.0.0.0", "--tls-cert", self.certificate, "--tls-key", self.key], False),
        ):
            with self.subTest(words), subprocess.Popen(
                [COMMAND, "studio", *words], cwd=self.folder, text=True,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            ) as process:  # fmt: skip
                process.stdout.readline()
                process.send_signal(signal.SIGINT)
                _, said = process.communicate(timeout=SECONDS)
                self.assertEqual(process.returncode, 0)
                self.assertEqual("anybody on the way can read" in said, is_warned, said)


if __name__ == "__main__":
    unittest.main()

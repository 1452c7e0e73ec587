"""The command line against a server that is busy, forgets scenes or asks for more: through a proxy that says so."""

import http.client
import http.server
import threading
import unittest

from command_line_test import BOX, OK, PROBLEM, USAGE, CommandLine, gnomon
from shipped_server import TIMEOUT, Server


class Proxy(http.server.ThreadingHTTPServer):
    """Stands before a server. `interfere` may answer a request itself: (status, headers)."""

    def __init__(self, target):
        super().__init__(("127.0.0.1", 0), Passing)
        self.target = target
        self.interfere = lambda request: None
        self.seen = []  # (method, path, headers)
        threading.Thread(target=self.serve_forever, daemon=True).start()


class Passing(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def pass_on(self):
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.server.seen.append((self.command, self.path, self.headers))
        if (refusal := self.server.interfere(self)) is not None:
            self.reply(*refusal, b"")
            return
        there = http.client.HTTPConnection(*self.server.target, timeout=TIMEOUT)
        kept = {name: self.headers[name] for name in ("Content-Type", "Accept") if name in self.headers}
        there.request(self.command, self.path, body, kept)
        reply = there.getresponse()
        self.reply(reply.status, {"Content-Type": reply.headers.get("Content-Type", "")}, reply.read())
        there.close()

    def reply(self, status, headers, body):
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        if status != 204:
            self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_GET = do_HEAD = do_POST = do_DELETE = pass_on


class WithProxy(CommandLine):
    @classmethod
    def setUpClass(cls):
        cls.server = Server("--device", "cpu", "--workers", "1")
        cls.addClassCleanup(cls.server.__exit__)

    def setUp(self):
        super().setUp()
        self.proxy = Proxy(self.server.address)
        self.addCleanup(self.proxy.server_close)
        self.addCleanup(self.proxy.shutdown)
        self.there = ["--server", "http://127.0.0.1:{}".format(self.proxy.server_address[1])]

    def once(self, method, ending, act):
        """Interferes with the first request of this kind."""
        left = [1]

        def interfere(request):
            if request.command != method or not request.path.endswith(ending) or not left:
                return None
            left.pop()
            return act(request)

        self.proxy.interfere = interfere

    def count(self, method, ending):
        return sum(1 for seen in self.proxy.seen if seen[0] == method and seen[1].endswith(ending))

    def test_a_busy_server_is_waited_for(self):
        for status in (429, 503):
            self.once("POST", "/frames", lambda _: (status, {"Retry-After": "1"}))
            self.render(*self.there)
        self.assertEqual(self.count("POST", "/frames"), 4)

    def test_patience_ends(self):
        self.proxy.interfere = lambda request: (503, {"Retry-After": "30"}) if request.path.endswith("/frames") else None
        run = gnomon("render", BOX, "-o", str(self.output), *self.there, "--patience", "5")
        self.assert_ends(run, PROBLEM, "503")
        self.assertEqual(self.count("POST", "/frames"), 1)

    def test_a_scene_that_was_dropped_is_uploaded_again(self):
        def drop(request):
            self.server.ask("DELETE", request.path.removesuffix("/frames"))

        self.once("POST", "/frames", drop)
        self.render(*self.there)
        self.assertEqual(self.count("POST", "/frames"), 2)
        self.assertGreaterEqual(self.count("POST", "/v1/scenes"), 1)

    def test_headers_are_sent_with_every_call(self):
        self.render(*self.there, "--header", "X-Team: lights", "--header", "X-Two:2")
        self.assertTrue(self.proxy.seen)
        for _, _, headers in self.proxy.seen:
            self.assertEqual((headers["X-Team"], headers["X-Two"]), ("lights", "2"))
        for wrong in ("no colon", ": x", "A: b\r\nC: d"):
            self.assert_ends(gnomon("ls", *self.there, "--header", wrong), USAGE, "--header")

    def test_scenes_come_and_go(self):
        run = gnomon("upload", BOX, str(self.folder / "none.glb"), *self.there)
        self.assert_ends(run, PROBLEM, "no such file")
        scene = run.stdout.decode().split()[0]
        self.assertEqual(len(scene), 64)
        self.assertIn(scene, gnomon("ls", *self.there).stdout.decode())
        self.assert_ends(gnomon("rm", scene, *self.there), OK)
        self.assertNotIn(scene, gnomon("ls", *self.there).stdout.decode())
        self.assert_ends(gnomon("rm", scene, *self.there), PROBLEM)
        self.assert_ends(gnomon("rm", "../..", *self.there), PROBLEM, "no scene's id")
        self.assertIn(b'"limits"', gnomon("capabilities", *self.there).stdout)


if __name__ == "__main__":
    unittest.main()

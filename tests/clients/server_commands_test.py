"""The command line against a server that is busy, forgets scenes or asks for more: through a proxy that says so."""

import http.client
import http.server
import io
import json
import os
import pty
import ssl
import subprocess
import tempfile
import threading
import time
import unittest
import zipfile
from pathlib import Path

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, CommandLine, gnomon
from shipped_server import BINARY, TIMEOUT, ServerTest, environment, png_size


class Proxy(http.server.ThreadingHTTPServer):
    """Stands before a server, over TLS where there is a `certificate` with its key. `interfere` may answer a request
    itself: (status, headers)."""

    def __init__(self, target, certificate=None):
        super().__init__(("127.0.0.1", 0), Passing)
        self.target = target
        if certificate:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate)
            # The handshake is the thread's that serves the connection, so that a client that gives up ends no other.
            self.socket = context.wrap_socket(self.socket, server_side=True, do_handshake_on_connect=False)
        self.interfere = lambda request: None
        self.cuts = []  # paths whose next reply ends in its middle
        self.seen = []  # (method, path, headers)
        self.times = []  # of the same, in seconds
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def handle_error(self, request, client_address):
        pass  # a client that trusts no certificate, or has been killed


class Passing(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def pass_on(self):
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.server.seen.append((self.command, self.path, self.headers))
        self.server.times.append(time.monotonic())
        if (refusal := self.server.interfere(self)) is not None:
            self.reply(*refusal, b"")
            return
        there = http.client.HTTPConnection(*self.server.target, timeout=TIMEOUT)
        kept = {name: self.headers[name] for name in ("Content-Type", "Accept", "Prefer") if name in self.headers}
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
        if self.path in self.server.cuts:
            self.server.cuts.remove(self.path)
            body = body[: len(body) // 2]
            self.close_connection = True
        self.wfile.write(body)

    do_GET = do_HEAD = do_POST = do_DELETE = pass_on


class WithProxy(ServerTest, CommandLine):
    flags = ("--device", "cpu", "--workers", "1")

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

    def test_a_busy_server_is_waited_for_as_long_as_it_asks(self):
        for status in (429, 503):
            self.once("POST", "/frames", lambda _: (status, {"Retry-After": "2"}))
            self.render(*self.there)
        at = [when for when, seen in zip(self.proxy.times, self.proxy.seen) if seen[1].endswith("/frames")]
        self.assertEqual(len(at), 4)
        for first, second in (at[:2], at[2:]):
            self.assertGreaterEqual(second - first, 2)

    def test_what_names_no_time_is_final(self):
        for status in (500, 503):
            self.once("POST", "/frames", lambda _: (status, {}))
            self.assert_ends(gnomon("render", BOX, "-o", str(self.output), *self.there), PROBLEM, str(status))
        self.assertEqual(self.count("POST", "/frames"), 2)

    def test_a_reply_that_was_cut_off_is_asked_for_again(self):
        def hang_up(request):
            request.connection.close()
            raise ConnectionError

        self.once("POST", "/frames", hang_up)
        self.render(*self.there)
        self.assertEqual(self.count("POST", "/frames"), 2)

    def test_a_file_or_events_that_were_cut_off_begin_anew(self):
        request = json.dumps({"spec": {"width": 64, "height": 48}, "frames": [{}, {}]}).encode()
        order = ("sequence", BOX, "--spec", "-", *self.there)
        job = gnomon(*order, "--async", stdin=request).stdout.decode().strip()
        self.assert_ends(gnomon("jobs", "wait", job, *self.there), OK)
        file = self.folder / "frames.zip"
        self.proxy.cuts = [f"/v1/jobs/{job}/result"]
        self.assert_ends(gnomon("jobs", "fetch", job, "-o", str(file), *self.there), OK)
        self.assertEqual(self.count("GET", "/result"), 2)
        whole = self.server.get(f"/v1/jobs/{job}/result", Accept="application/zip").body
        self.assertEqual(pictures_of(file.read_bytes()), pictures_of(whole))
        scene = gnomon("upload", BOX, *self.there).stdout.decode().split()[0]
        self.proxy.cuts = [f"/v1/scenes/{scene}/sequences"]
        self.assert_ends(gnomon(*order, "-o", str(self.folder / "{frame}.png"), stdin=request), OK)
        self.assertEqual(self.count("POST", "/sequences"), 3)
        self.assertEqual(len(list(self.folder.glob("*.png"))), 2)

    def test_a_video_that_was_cut_off_is_not_appended_to_itself(self):
        scene = gnomon("upload", BOX, *self.there).stdout.decode().split()[0]
        self.proxy.cuts = [f"/v1/scenes/{scene}/sequences"]
        request = json.dumps({"spec": {"width": 64, "height": 48}, "frames": [{}, {}]}).encode()
        file = self.folder / "video.webm"
        cut = gnomon("sequence", BOX, "--spec", "-", "-o", str(file), *self.there, stdin=request)
        self.assert_ends(cut, PROBLEM, "the connection ended before the reply did")
        self.assertEqual(self.count("POST", "/sequences"), 1)
        self.assertFalse(file.exists())

    def test_what_the_server_refuses_is_json_on_standard_error(self):
        run = gnomon("render", BOX, "-o", str(self.output), *SMALL, *self.there, "--camera", "nobody", "--problems", "json")
        self.assert_ends(run, PROBLEM)
        [problem] = json.loads(run.stderr)["problems"]
        self.assertEqual((problem["pointer"], problem["flag"]), ("/camera/node", "--camera"))
        self.proxy.interfere = lambda request: (429, {"Retry-After": "30"})
        run = gnomon("ls", *self.there, "--patience", "1", "--problems", "json")
        self.assert_ends(run, PROBLEM)
        self.assertEqual(json.loads(run.stderr)["problems"][0]["actual"], "status 429")
        self.assertEqual(run.stdout, b"")

    def test_quiet_shows_no_progress_on_a_terminal(self):
        told = {}
        for quiet in ([], ["--quiet"]):
            # Long enough that whatever shows progress has shown some.
            self.once("POST", "/frames", lambda _: (429, {"Retry-After": "1"}))
            terminal, end = pty.openpty()
            command = [BINARY, "render", BOX, "-o", str(self.output), *SMALL, *self.there, *quiet]
            run = subprocess.Popen(command, stderr=end, env=environment())
            os.close(end)
            text = b""
            try:
                while piece := os.read(terminal, 65536):
                    text += piece
            except OSError:  # how the end of a terminal is told
                pass
            os.close(terminal)
            self.assertEqual(run.wait(TIMEOUT), OK)
            told[bool(quiet)] = text
        self.assertIn(b"waiting: the server is busy", told[False])
        self.assertEqual(told[True], b"")

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

    def test_an_upload_that_is_cut_is_named(self):
        cut = self.folder / "cut.glb"
        cut.write_bytes(Path(BOX).read_bytes()[:600])
        run = gnomon("upload", BOX, str(cut), *self.there)
        self.assert_ends(run, PROBLEM, f"({cut})", "600", str(Path(BOX).stat().st_size))
        self.assert_ends(gnomon("render", str(cut), "-o", str(self.output), *self.there), PROBLEM, f"gnomon: {cut}: ", "600")

    def test_a_scene_that_the_server_has_is_drawn_by_its_id(self):
        self.render(*self.there)
        drawn = self.output.read_bytes()
        scene = gnomon("upload", BOX, *self.there).stdout.decode().split()[0]
        self.proxy.seen.clear()
        self.output = self.folder / "{scene}.png"
        self.render(*self.there, scene=scene)
        self.assertEqual((self.folder / f"{scene}.png").read_bytes(), drawn)
        self.assertEqual([seen[:2] for seen in self.proxy.seen], [("POST", f"/v1/scenes/{scene}/frames")])
        self.render(*self.there, "--reference", scene=scene)
        self.assertTrue((self.folder / f"{scene}.reference.png").exists())
        self.assertEqual(self.count("POST", "/evaluations"), 1)
        self.assert_ends(gnomon("rm", scene, *self.there), OK)
        lost = gnomon("render", scene, "-o", str(self.output), *SMALL, *self.there)
        self.assert_ends(lost, PROBLEM, "No scene with this id is stored.")
        self.assertEqual(self.count("POST", "/v1/scenes"), 0)
        self.assert_ends(gnomon("render", scene, "-o", str(self.output), *SMALL), PROBLEM, "no such file")

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


def pictures_of(archive):
    """With where each begins, so that bytes in front of the archive are noticed."""
    with zipfile.ZipFile(io.BytesIO(archive)) as files:
        return [(file.header_offset, files.read(file)) for file in files.infolist() if file.filename.endswith(".png")]


def make_certificate(folder, name, host):
    """A certificate for a host, signed by itself: its own file, and one with the key."""
    key, certificate, both = (folder / f"{name}.{kind}" for kind in ("key", "crt", "pem"))
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", f"/CN={host}",
                    "-addext", f"subjectAltName=DNS:{host}", "-keyout", key, "-out", certificate],
                   check=True, capture_output=True)  # fmt: skip
    both.write_bytes(key.read_bytes() + certificate.read_bytes())
    return str(certificate), both


class OverTls(ServerTest, CommandLine):
    flags = ("--device", "cpu", "--workers", "1")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.trusted, own = make_certificate(Path(folder.name), "own", "localhost")
        cls.other, _ = make_certificate(Path(folder.name), "other", "localhost")
        proxy = Proxy(cls.server.address, own)
        cls.addClassCleanup(proxy.server_close)
        cls.addClassCleanup(proxy.shutdown)
        cls.port = proxy.server_address[1]
        cls.there = ["--server", f"https://localhost:{cls.port}"]

    def test_a_private_certificate_is_trusted_where_it_is_named(self):
        self.render(*self.there, "--ca-file", self.trusted)
        self.assertEqual(png_size(self.output.read_bytes()), (64, 48))
        config = self.folder / "config"
        config.write_text(f'server = "{self.there[1]}"\nca-file = "{self.trusted}"\n')
        self.assert_ends(gnomon("ls", "--config", str(config)), OK)

    def test_any_other_certificate_is_refused(self):
        ls = ["ls", *self.there]
        self.assert_ends(gnomon(*ls), PROBLEM, "certificate is not trusted")
        self.assert_ends(gnomon(*ls, "--ca-file", self.other), PROBLEM, "certificate is not trusted")
        address = ["--server", f"https://127.0.0.1:{self.port}"]  # no name of the certificate
        self.assert_ends(gnomon("ls", *address, "--ca-file", self.trusted), PROBLEM, "another host's")

    def test_what_holds_no_certificate_is_told(self):
        empty = self.folder / "empty"
        empty.write_text("")
        self.assert_ends(gnomon("ls", *self.there, "--ca-file", str(empty)), PROBLEM, "file of trusted certificates")
        self.assert_ends(gnomon("ls", *self.there, "--ca-file", str(self.folder / "none")), USAGE, "none")


if __name__ == "__main__":
    unittest.main()

"""A server with keys: who may do what, for how long, and how often."""

import hashlib
import http.client
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from shipped_server import BINARY, SCENES, SMALL, TIMEOUT, Server, form

MISSING = "0" * 64
# A method and path, and the scopes that it needs.
ROUTES = [
    ("GET", "/v1/scenes", {"read"}),
    ("GET", f"/v1/scenes/{MISSING}", {"read"}),
    ("HEAD", f"/v1/scenes/{MISSING}", {"read"}),
    ("GET", "/v1/capabilities", {"read"}),
    ("POST", f"/v1/scenes/{MISSING}/frames", {"render"}),
    ("GET", f"/v1/scenes/{MISSING}/frame", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/plan", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/evaluations", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/bakes", {"render"}),
    ("GET", f"/v1/scenes/{MISSING}/bakes/x", {"render"}),
    ("DELETE", f"/v1/scenes/{MISSING}/bakes/x", {"render"}),
    ("POST", "/v1/scenes", {"upload"}),
    ("PUT", f"/v1/scenes/{MISSING}", {"upload"}),
    ("DELETE", f"/v1/scenes/{MISSING}", {"upload"}),
    ("POST", "/v1/render", {"upload", "render"}),
]


def line(name, scopes, *more):
    """A key's line; its secret is its name after "secret of "."""
    digest = hashlib.sha256(f"secret of {name}".encode()).hexdigest()
    return " ".join([f"name={name}", f"sha256={digest}", f"scopes={scopes}", *more]) + "\n"


def bearer(name):
    return {"Authorization": f"Bearer secret of {name}"}


class Access(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.keys = Path(folder.name) / "keys"

    def start(self, *lines):
        self.keys.write_text("".join(lines))
        self.keys.chmod(0o600)
        server = Server("--device", "cpu", "--keys", str(self.keys))
        self.addCleanup(server.__exit__)
        return server

    def reload(self, server, text, words):
        self.keys.write_text(text)
        server.process.send_signal(signal.SIGHUP)
        server.log_has(words)

    def test_each_scope_opens_its_routes_and_no_others(self):
        every = ("read", "render", "upload", "admin")
        server = self.start(*(line(name, name) for name in every), line("both", "render,upload"))
        held = {name: {name} for name in every} | {"both": {"render", "upload"}, "admin": {"read", "render", "upload"}}
        types = {"/v1/render": "multipart/form-data", "/v1/scenes": "model/gltf-binary"}
        for method, path, needed in ROUTES:
            is_upload = path in types or method == "PUT"
            kind = {"Content-Type": types.get(path, "model/gltf-binary" if is_upload else "application/json")}
            body = b"x" if method in ("POST", "PUT") else None
            with self.subTest(method=method, path=path):
                refused = server.ask(method, path, body, kind)
                self.assertEqual(refused.status, 401)
                self.assertEqual(refused.headers["WWW-Authenticate"], 'Bearer realm="gnomon"')
                for name, scopes in held.items():
                    status = server.ask(method, path, body, kind | bearer(name)).status
                    self.assertNotEqual(status, 401)
                    self.assertEqual(status == 403, not needed <= scopes, (name, status))

    def test_probes_and_pages_need_no_key(self):
        server = self.start(line("a", "read"))
        for path in ("/livez", "/readyz", "/", "/openapi.json"):
            self.assertEqual(server.get(path).status, 200, path)
        self.assertEqual(server.get("/v1/nothing").status, 404)
        self.assertEqual(server.ask("OPTIONS", "/v1/scenes").status, 204)

    def test_a_frame_by_key_is_logged_under_its_name_and_kept_from_shared_caches(self):
        server = self.start(line("studio", "render,upload"))
        model = {"Content-Type": "model/gltf-binary"} | bearer("studio")
        scene = server.ask("POST", "/v1/scenes", (SCENES / "box_on_plane.glb").read_bytes(), model).json()["id"]
        frame = server.ask("GET", f"/v1/scenes/{scene}/frame?width=64&height=48", headers=bearer("studio"))
        self.assertEqual(frame.status, 200)
        self.assertTrue(frame.headers["Cache-Control"].startswith("private"))
        logged = server.request_line(frame.headers["X-Request-ID"])
        self.assertEqual(logged["key"], "studio")
        self.assertEqual(logged["client"], "127.0.0.1")
        self.assertNotIn("secret of", server.log_text())

    def test_a_key_beyond_its_rate_is_told_when_to_come_again(self):
        server = self.start(line("slow", "read", "requestsPerSecond=0.5", "burst=3"), line("other", "read"))
        for _ in range(3):
            self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("slow")).status, 200)
        refused = server.ask("GET", "/v1/scenes", headers=bearer("slow"))
        self.assertEqual(refused.status, 429)
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("other")).status, 200)
        server.process.send_signal(signal.SIGHUP)
        server.log_has("keys in it: 2")
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("slow")).status, 429, "not a new burst")
        time.sleep(int(refused.headers["Retry-After"]))
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("slow")).status, 200)

    def test_a_signal_reads_the_keys_again(self):
        server = self.start(line("old", "read"))
        self.reload(server, line("old", "read") + line("new", "read"), "keys in it: 2")
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("new")).status, 200)
        self.reload(server, line("new", "read"), "keys in it: 1")
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("old")).status, 401)
        self.reload(server, line("old", "read") + "nonsense\n", "line 2")
        self.assertEqual(server.ask("GET", "/v1/scenes", headers=bearer("new")).status, 200, "the keys stay")
        self.assertEqual(server.end(), 0)

    def test_a_broken_file_ends_the_start(self):
        for text, words in ((line("a", "read") + line("b", "everything"), "line 2"), ("", "no key")):
            self.keys.write_text(text)
            ended = subprocess.run([BINARY, "serve", "--port", "0", "--keys", str(self.keys)],
                                   capture_output=True, text=True, timeout=TIMEOUT)  # fmt: skip
            self.assertEqual(ended.returncode, 1)
            self.assertIn(words, ended.stderr)

    def test_a_file_that_everyone_may_read_is_told_of(self):
        self.keys.write_text(line("a", "read"))
        self.keys.chmod(0o644)
        with Server("--device", "cpu", "--keys", str(self.keys)) as server:
            server.log_has("may read the key file")


if __name__ == "__main__":
    unittest.main()

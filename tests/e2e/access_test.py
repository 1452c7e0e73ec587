"""A server with keys: who may do what, for how long, and how often."""

import hashlib
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from shipped_server import BINARY, SCENES, TIMEOUT, Server, environment

MISSING = "0" * 64
# A method and path, and the scopes that it needs.
ROUTES = [
    ("GET", "/v1/scenes", {"read"}),
    ("GET", f"/v1/scenes/{MISSING}", {"read"}),
    ("HEAD", f"/v1/scenes/{MISSING}", {"read"}),
    ("GET", f"/v1/scenes/{MISSING}/nodes", {"read"}),
    ("GET", "/v1/capabilities", {"read"}),
    ("POST", f"/v1/scenes/{MISSING}/frames", {"render"}),
    ("GET", f"/v1/scenes/{MISSING}/frame", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/plan", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/evaluations", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/sequences", {"render"}),
    ("GET", "/v1/jobs", {"render"}),
    ("GET", f"/v1/jobs/{MISSING}", {"render"}),
    ("DELETE", f"/v1/jobs/{MISSING}", {"render"}),
    ("GET", f"/v1/jobs/{MISSING}/result", {"render"}),
    ("GET", f"/v1/jobs/{MISSING}/frames/x", {"render"}),
    ("POST", f"/v1/scenes/{MISSING}/bakes", {"render"}),
    ("GET", f"/v1/scenes/{MISSING}/bakes/x", {"render"}),
    ("DELETE", f"/v1/scenes/{MISSING}/bakes/x", {"render"}),
    ("POST", "/v1/scenes", {"upload"}),
    ("PUT", f"/v1/scenes/{MISSING}", {"upload"}),
    ("DELETE", f"/v1/scenes/{MISSING}", {"upload"}),
    ("POST", "/v1/render", {"upload", "render"}),
    ("POST", "/render", {"upload", "render"}),
    ("GET", "/metrics", {"admin"}),
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
        held = {name: {name} for name in every} | {"both": {"render", "upload"}, "admin": {"admin", "read", "render", "upload"}}
        types = {"/render": "multipart/form-data", "/v1/render": "multipart/form-data", "/v1/scenes": "model/gltf-binary"}
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

    def test_each_route_publishes_what_it_needs(self):
        server = self.start(line("a", "read"))
        published = {}
        for path, operations in server.get("/openapi.json").json()["paths"].items():
            for method, operation in operations.items():
                keys = [set(each["key"]) for each in operation.get("security", []) if "key" in each]
                published[method.upper(), path.replace("{id}", MISSING).replace("{key}", "x").replace("{index}", "x")] = keys
        for method, path, needed in ROUTES:
            self.assertEqual(published.pop((method, path)), [needed], path)
        for (method, path), keys in published.items():
            self.assertEqual(keys, [], path)
            self.assertNotIn(server.ask(method, path).status, (401, 403), path)

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
        self.assertNotIn("secret of", server.settled_log())

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

    def sign(self, url, key, expires):
        """What `gnomon sign` prints."""
        return subprocess.run([BINARY, "sign", url, "--key-file", str(self.keys), "--key", key, "--expires", expires],
                              capture_output=True, text=True, timeout=TIMEOUT, check=True).stdout.strip()  # fmt: skip

    def test_a_signed_address_is_a_picture_for_a_while(self):
        old, new = "signingSecret=the-old-signing-secret", "signingSecret=the-new-signing-secret"
        server = self.start(line("shop", "render,upload", old))
        model = {"Content-Type": "model/gltf-binary"} | bearer("shop")
        scene = server.ask("POST", "/v1/scenes", (SCENES / "box_on_plane.glb").read_bytes(), model).json()["id"]
        host = "http://127.0.0.1:{}".format(server.address[1])
        path = f"/v1/scenes/{scene}/frame?width=64&height=48&sun=135%2C40"
        self.assertEqual(server.get(path).status, 401)

        address = self.sign(host + path, "shop", "1h")
        self.assertTrue(address.startswith(host + path + "&expires="))
        signed = address.removeprefix(host)
        picture = server.get(signed)
        self.assertEqual(picture.status, 200)
        self.assertEqual(picture.body, server.ask("GET", path, headers=bearer("shop")).body)
        self.assertEqual(server.ask("HEAD", signed).status, 200)
        self.assertNotIn("signature=", server.settled_log())
        self.assertEqual(server.get(signed.replace("width=64", "width=65")).status, 403)
        self.assertEqual(server.get(signed[:-1] + ("1" if signed[-1] == "0" else "0")).status, 403)

        short = self.sign(path, "shop", "2s")
        self.assertEqual(server.get(short).status, 200)
        time.sleep(2)
        over = server.get(short)
        self.assertEqual((over.status, over.pointers()), (403, ["expires"]))

        self.reload(server, line("shop", "render,upload", new, old), "keys in it: 1")
        self.assertEqual(server.get(signed).status, 200, "while the old secret is listed")
        renewed = self.sign(path, "shop", "1h")
        self.keys.write_text(line("shop", "render,upload", new) + line("other", "read"))
        server.process.send_signal(signal.SIGHUP)
        server.log_has("keys in it: 2")
        self.assertEqual(server.get(signed).status, 403)
        self.assertEqual(server.get(renewed).status, 200)

    def test_what_can_not_be_signed_is_told(self):
        self.keys.write_text(line("reader", "read", "signingSecret=0123456789abcdef") + line("bare", "render"))
        frame = f"/v1/scenes/{MISSING}/frame"
        for url, key in ((frame, "reader"), (frame, "bare"), (frame, "nobody"), ("/v1/scenes", "reader"), ("", "bare")):
            told = subprocess.run([BINARY, "sign", url, "--key-file", str(self.keys), "--key", key, "--expires", "1h"],
                                  capture_output=True, text=True, timeout=TIMEOUT)  # fmt: skip
            self.assertEqual((told.returncode, told.stdout), (1, ""), (url, key))

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
                                   capture_output=True, text=True, timeout=TIMEOUT, env=environment())  # fmt: skip
            self.assertEqual(ended.returncode, 2)
            self.assertIn(words, ended.stderr)

    def test_a_file_that_everyone_may_read_is_told_of(self):
        self.keys.write_text(line("a", "read"))
        self.keys.chmod(0o644)
        with Server("--device", "cpu", "--keys", str(self.keys)) as server:
            server.log_has("may read the key file")
            self.keys.chmod(0o440)
            self.reload(server, line("a", "read"), "was read again")
            self.keys.chmod(0o644)
            self.reload(server, line("b", "read") + line("c", "read"), "keys in it: 2")
            self.assertEqual(server.settled_log().count("may read the key file"), 2)

    def test_hangup_without_keys_changes_nothing(self):
        with Server("--device", "cpu") as server:
            for _ in range(3):
                server.process.send_signal(signal.SIGHUP)
            server.log_has("there are no keys")
            self.assertEqual(server.get("/readyz").status, 200)
            self.assertEqual(server.end(), 0)


if __name__ == "__main__":
    unittest.main()

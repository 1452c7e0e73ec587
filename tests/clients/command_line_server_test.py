"""The command line and a server: the same picture here and there, and the keys that it is shown."""

import hashlib
import json
import tempfile
import unittest
from pathlib import Path

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, AgainstServer, CommandLine, gnomon, split_glb
from environments import RED
from shipped_server import Server


class WithKeys(CommandLine):
    """A server that asks for a key; it is taken from a file or from the environment."""

    @classmethod
    def setUpClass(cls):
        cls.secret = "a-secret-of-these-tests"
        digest = hashlib.sha256(cls.secret.encode()).hexdigest()
        keys = tempfile.NamedTemporaryFile("w")
        cls.addClassCleanup(keys.close)
        keys.write(f"name=tests sha256={digest} scopes=read,render,upload\n")
        keys.flush()
        cls.server = Server("--device", "cpu", "--workers", "1", "--keys", keys.name)
        cls.addClassCleanup(cls.server.__exit__)
        cls.there = ["--server", "http://{}:{}".format(*cls.server.address)]

    def test_it_is_shown(self):
        key = self.folder / "key"
        key.write_text(self.secret + "\nwhat follows is no part of it\n")
        self.render(*self.there, "--key-file", str(key), GNOMON_KEY="the file goes first")
        self.render(*self.there, GNOMON_KEY=self.secret)
        self.render(*self.there, "--key-file", "-", stdin=self.secret.encode())
        lit = ["--set", "shadow.technique=lightMap"]
        for command in (["plan", BOX], ["bake", BOX, *lit, "-o", str(self.folder / "map.png")],
                        ["evaluate", BOX, *SMALL, "--variant", '{"shadow": {"filter": {"type": "hard"}}}']):  # fmt: skip
            self.assert_ends(gnomon(*command, *self.there, GNOMON_KEY=self.secret), OK)
        self.assertNotIn(self.secret, self.server.settled_log())

    def test_without_the_right_one_the_server_refuses(self):
        arguments = ["render", BOX, "-o", str(self.output), *SMALL, *self.there]
        self.assert_ends(gnomon(*arguments), PROBLEM, "This server asks for a key.")
        self.assert_ends(gnomon(*arguments, GNOMON_KEY="wrong"), PROBLEM, "No key has this secret.")

    def test_what_is_no_key_is_not_sent(self):
        arguments = ["render", BOX, "-o", str(self.output), *SMALL, *self.there]
        empty = self.folder / "empty"
        empty.write_text("\n" + self.secret)
        self.assert_ends(gnomon(*arguments, "--key-file", str(empty)), PROBLEM, "no key")
        self.assert_ends(gnomon(*arguments, "--key-file", str(self.folder / "missing")), PROBLEM, "missing")
        self.assert_ends(gnomon(*arguments, GNOMON_KEY="two words\r\nX: y"), PROBLEM, "GNOMON_KEY")
        self.assert_ends(gnomon(*arguments[:-2], "--key-file", str(empty)), USAGE, "--server")


class WithServer(AgainstServer):
    def both(self, *arguments, scene=BOX):
        """The files that a render gives here, and there."""
        files = []
        for where in ([], ["--server", self.url]):
            self.render(*arguments, *where, scene=scene)
            written = sorted(self.folder.glob("frame*"))
            files.append([(path.name, path.read_bytes()) for path in written])
            for path in written:
                path.unlink()
        return files

    def test_an_environment_is_uploaded_with_the_scene(self):
        picture = self.folder / "red.hdr"
        picture.write_bytes(RED)
        here, there = self.both("--environment", str(picture))
        self.assertEqual(here, there)
        run = gnomon("upload", BOX, "--environment", str(picture), "--server", self.url)
        self.assert_ends(run, OK)
        self.render("--environment", "red.hdr", "--server", self.url, scene=run.stdout.decode().split()[0])
        self.assertEqual([(self.output.name, self.output.read_bytes())], here)

    def test_the_same_bytes_here_and_there(self):
        for arguments in (
            ["--sun", "135,40"],
            ["--orbit", "30,50,8", "--view", "color", "--view", "cascades", "--view", "depth"],
            ["--set", "lights.0.sun.azimuthDegrees=0.1", "--set", "shadow.filter.type=hard"],
        ):
            here, there = self.both(*arguments)
            self.assertEqual(here, there)

    def test_the_same_reference_here_and_there(self):
        said = []
        for where in ([], ["--server", self.url]):
            run = self.render("--sun", "135,40", "--reference", *where)
            said.append((run.stdout, self.output.read_bytes(), (self.folder / "frame.reference.png").read_bytes()))
        self.assertEqual(*said)

    def test_the_same_exr_here_and_there(self):
        self.output = self.folder / "frame.exr"
        here, there = self.both("--view", "color", "--view", "depth")
        self.assertEqual(here, there)

    def test_the_same_file_of_every_other_format_here_and_there(self):
        for suffix in ("npy", "tiff", "jpg", "webp"):
            self.output = self.folder / f"frame.{suffix}"
            here, there = self.both("--view", "normal")
            self.assertEqual(here, there)

    def test_files_are_uploaded_with_their_model(self):
        here, there = self.both(scene=split_glb(Path(BOX).read_bytes(), self.folder))
        self.assertEqual(here, there)

    def test_a_known_scene_is_not_uploaded_again(self):
        self.render("--server", self.url)
        self.render("--server", self.url)
        self.server.settled_log()
        uploads = [line for line in self.server.log_lines() if line.get("method") == "POST" and line.get("target") == "/v1/scenes"]
        heads = [line for line in self.server.log_lines() if line.get("method") == "HEAD" and line.get("status") == 200]
        self.assertTrue(heads)
        self.assertLessEqual(len([line for line in uploads if line["status"] == 201]), 2)  # the GLB; the .gltf

    def test_what_the_server_refuses_names_the_flag(self):
        run = gnomon("render", BOX, "-o", str(self.output), "--camera", "nobody", "--server", self.url)
        self.assert_ends(run, PROBLEM, "--camera (/camera/node)")

    def test_inspect_says_what_the_server_says(self):
        run = gnomon("inspect", BOX, "--json")
        self.assert_ends(run, OK)
        here = json.loads(run.stdout)
        there = self.server.ask("GET", f"/v1/scenes/{self.server.upload('box_on_plane')}").json()
        self.assertEqual({key: here[key] for key in here if key not in ("id", "bytes")},
                         {key: there[key] for key in there if key not in ("id", "bytes")})
        self.assertIn("triangles", gnomon("inspect", BOX).stdout.decode())

    def test_a_plan_is_the_same_here_and_there(self):
        spec = self.folder / "spec.json"
        spec.write_text('{"shadow": {"cascadeCount": 2}}')
        plan = ["plan", BOX, "--spec", str(spec), "--sun", "135,40"]
        here, there = (gnomon(*plan, *where) for where in ([], ["--server", self.url]))
        for run in (here, there):
            self.assert_ends(run, OK)
        self.assertEqual(json.loads(here.stdout), json.loads(there.stdout))
        self.assertEqual(len(json.loads(here.stdout)["lights"][0]["tiles"]), 2)
        self.assertEqual(gnomon("plan", BOX, str(spec), "--sun", "135,40").stdout, here.stdout)
        self.assert_ends(gnomon("plan", BOX, str(spec), "--spec", str(spec)), USAGE, "--spec excludes request")
        run = gnomon("plan", BOX, "--set", "shadow.cascadeCount=9")
        self.assert_ends(run, PROBLEM, "--set shadow.cascadeCount")

    def test_health(self):
        self.assert_ends(gnomon("health", "--url", self.url), OK)
        self.assert_ends(gnomon("health", GNOMON_URL=self.url), OK)
        self.assert_ends(gnomon("health", "--url", self.url + "/nowhere"), PROBLEM, "is not ready")
        self.assert_ends(gnomon("health", "--url", "http://127.0.0.1:1"), PROBLEM, "no reply")

    def test_health_loads_neither_the_image_library_nor_gl(self):
        loaded = gnomon("health", LD_TRACE_LOADED_OBJECTS="1").stdout.decode().lower()
        self.assertIn("libc.so", loaded)
        for name in ("openimageio", "libegl", "libgl.", "osmesa"):
            self.assertNotIn(name, loaded)


if __name__ == "__main__":
    unittest.main()

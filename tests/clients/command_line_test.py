"""The command line through the shipped binary: exit codes, problems, files, and the same picture here and there."""

import hashlib
import json
import os
import subprocess
import tempfile
import unittest
import zipfile
from pathlib import Path

from shipped_server import BINARY, EXR_MAGIC, SCENES, TIMEOUT, Server, ServerTest, environment, png_size

BOX = str(SCENES / "box_on_plane.glb")
SMALL = ["--size", "64x48"]
OK, PROBLEM, USAGE = 0, 1, 2


def gnomon(*arguments, stdin=b"", cwd=None, **variables):
    """A run of the binary; further keywords are environment variables."""
    return subprocess.run(
        [BINARY, *arguments], input=stdin, capture_output=True, timeout=TIMEOUT, cwd=cwd, env=environment(**variables)
    )


def split_glb(glb, folder):
    """The GLB as scene.gltf and "parts/buffer 0.bin", written to a folder; gives the .gltf's path."""
    length = int.from_bytes(glb[12:16], "little")
    document = json.loads(glb[20 : 20 + length])
    (folder / "parts").mkdir()
    (folder / "parts" / "buffer 0.bin").write_bytes(glb[28 + length :])
    document["buffers"][0]["uri"] = "parts/buffer%200.bin"
    (folder / "scene.gltf").write_text(json.dumps(document))
    return str(folder / "scene.gltf")


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.output = self.folder / "frame.png"

    def assert_ends(self, run, status, *said):
        self.assertEqual(run.returncode, status, run.stderr.decode())
        for text in said:
            self.assertIn(text, run.stderr.decode())

    def render(self, *arguments, scene=BOX, **options):
        run = gnomon("render", scene, "-o", str(self.output), *SMALL, *arguments, **options)
        self.assert_ends(run, OK)
        return run


class Usage(CommandLine):
    def test_help_and_version_are_no_failure(self):
        for arguments in (["--help"], ["render", "--help"], ["serve", "--help"], ["--version"]):
            run = gnomon(*arguments)
            self.assert_ends(run, OK)
            self.assertTrue(run.stdout)

    def test_fields_are_listed_with_their_range_and_default(self):
        for command in ("render", "plan", "evaluate"):
            run = gnomon(command, "--fields")
            self.assert_ends(run, OK)
            [line] = [line for line in run.stdout.decode().splitlines() if line.startswith("  shadow.cascadeCount ")]
            self.assertIn("whole number, 1..8", line)
            self.assertIn("default 4", line)

    def test_a_wrong_command_line_is_two(self):
        for arguments in (
            [],
            ["paint"],
            ["render"],
            ["render", BOX],
            ["render", BOX, "-o", "a.gif"],
            ["render", BOX, "-o", "a.png", "--sun", "135"],
            ["render", BOX, "-o", "a.png", "--size", "64"],
            ["render", BOX, "-o", "a.png", "--size", "64x48", "--width", "3"],
            ["render", BOX, "-o", "a.png", "--set", "width"],
            ["render", BOX, "-o", "a.png", "--backend", "vulkan"],
            ["render", BOX, "-o", "a.png", "--server", "http://127.0.0.1:1", "--require-gpu"],
            ["render", BOX, "-o", "a.png", "--device", "cpu", "--require-gpu"],
            ["render", BOX, "-o", "a.png", "--device", "cpu", "--backend", "osmesa"],
            ["render", BOX, "-o", "a.png", "--set", "output.format=exr"],
            ["serve", "--port", "65536"],
            ["serve", "--port", "0", "--device", "cpu", "--require-gpu"],
            ["serve", "--port", "0", "--device", "cpu", "--backend", "egl"],
            ["serve", "--nonsense"],
        ):
            self.assert_ends(gnomon(*arguments, cwd=str(self.folder)), USAGE)

    def test_a_word_that_is_no_command_is_told(self):
        self.assert_ends(gnomon("rendr", BOX, "-o", "a.png"), USAGE, "There is no command rendr; did you mean render?")
        run = gnomon("paint")
        self.assert_ends(run, USAGE, "There is no command paint.\n")
        self.assertNotIn(b"worker", gnomon("workr").stderr)  # is for no person

    def test_the_processor_has_no_gpu_and_no_context(self):
        cpu = ["render", BOX, "-o", str(self.output), *SMALL, "--device", "cpu"]
        for order in ([*cpu, "--require-gpu"], ["render", "--require-gpu", *cpu[1:]]):
            self.assert_ends(gnomon(*order), USAGE, "--require-gpu: asks for a GPU, and --device cpu uses none")
        config = self.folder / "config"
        config.write_text("backend = egl\n")
        self.assert_ends(gnomon(*cpu, "--config", str(config)), USAGE, "--backend: chooses OpenGL's context")
        self.assert_ends(gnomon(*cpu, "--backend", "auto", "--require-gpu=false"), OK)

    def test_a_format_beside_the_name_of_another_is_refused(self):
        for set_ in ("output.format=exr", 'output={"format": "exr"}'):
            run = gnomon("render", BOX, "-o", str(self.output), "--set", set_)
            self.assert_ends(run, USAGE, "--set: output.format is exr, but the output's name says png")
        run = gnomon("render", BOX, "--set", "output.format=exr", "-o", "-", "--format", "png")
        self.assert_ends(run, USAGE, "exr", "png")
        self.assertFalse(self.output.exists())
        self.render("--set", "output.format=png")

    def test_every_flag_of_serve_has_its_variable(self):
        flags = [line for line in gnomon("serve", "--help").stdout.decode().splitlines() if line.startswith("  --")]
        self.assertGreater(len(flags), 10)
        for line in flags:
            if "--print-config" not in line:  # what a command does is no option of it
                self.assertIn("(Env:GNOMON_", line)
        self.assert_ends(gnomon("serve", GNOMON_LISTEN_PORT="tcp://10.0.0.1:80"), USAGE)
        self.assert_ends(gnomon("serve", GNOMON_QUEUE_LIMIT="0"), USAGE)


class Problems(CommandLine):
    def refused(self, *arguments, said, **options):
        self.assert_ends(gnomon("render", *arguments, "-o", str(self.output), **options), PROBLEM, *said)
        self.assertEqual(list(self.folder.glob("frame*")), [])

    def test_a_problem_names_the_flag_the_place_the_limit_and_the_value(self):
        self.refused(BOX, "--sun", "10,100", said=["--sun (/lights/0/sun/elevationDegrees)", "90", "100"])
        self.refused(BOX, "--size", "0x48", said=["--width (/width)"])
        self.refused(BOX, "--set", "shadow.filter.sise=7", said=["--set shadow.filter.sise (/shadow/filter/sise)"])

    def test_every_problem_has_its_line(self):
        run = gnomon("render", BOX, "-o", str(self.output), "--width", "0", "--height", "-1", "--view", "smell")
        self.assert_ends(run, PROBLEM)
        self.assertEqual(len(run.stderr.splitlines()), 3, run.stderr.decode())

    def test_scenes_that_are_not(self):
        self.refused(str(self.folder / "none.glb"), said=["no such file"])
        self.refused(str(self.folder), said=["is not a file"])
        (self.folder / "bad.glb").write_bytes(Path(BOX).read_bytes()[:100])
        self.refused(str(self.folder / "bad.glb"), said=["gnomon: "])
        (self.folder / "model").mkdir()
        (self.folder / "x").write_bytes(b"x")
        up = self.folder / "model" / "up.gltf"
        up.write_text('{"asset": {"version": "2.0"}, "buffers": [{"uri": "../x", "byteLength": 1}]}')
        self.refused(str(up), said=["outside of its folder", "../x", "--allow-outside-files"])
        self.render("--allow-outside-files", scene=str(up))

    def test_specs_that_are_not(self):
        for text in (b"{", b'{"width": 64, "width": 64}', b"[" * 20000, b'{"wide": 1}'):
            self.refused(BOX, "--spec", "-", stdin=text, said=["gnomon: "])

    def test_a_server_that_is_not(self):
        self.refused(BOX, "--server", "http://127.0.0.1:1", said=["http://127.0.0.1:1: There was no reply"])
        self.refused(BOX, "--server", "127.0.0.1:8080", said=["is not a server's address"])

    def test_what_was_there_stays_when_the_frame_fails(self):
        self.output.write_bytes(b"old")
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--width", "0"), PROBLEM)
        self.assertEqual(self.output.read_bytes(), b"old")


class Render(CommandLine):
    def test_a_frame_is_a_file_and_nothing_is_said(self):
        run = self.render("--sun", "135,40")
        self.assertEqual(png_size(self.output.read_bytes()), (64, 48))
        self.assertEqual((run.stdout, run.stderr), (b"", b""))
        self.assertEqual(os.listdir(self.folder), ["frame.png"])

    def test_what_is_repaired_is_told_and_can_be_refused(self):
        longer = self.folder / "longer.glb"
        longer.write_bytes(Path(BOX).read_bytes() + b"past the end")
        expected = self.render("--sun", "135,40") and self.output.read_bytes()
        said = self.render("--sun", "135,40", scene=str(longer)).stderr.decode()
        self.assertRegex(said, "^gnomon: warning: The GLB has bytes after its end; [^\n]*\n$")
        self.assertEqual(self.output.read_bytes(), expected)
        both = gnomon("render", str(longer), BOX, "-o", str(self.folder / "{scene}.png"), *SMALL)
        self.assert_ends(both, OK, f"gnomon: warning: {longer}: The GLB has bytes after its end; ")
        for command in (["render", str(longer), "-o", str(self.output)], ["inspect", str(longer)], ["plan", str(longer)]):
            self.assert_ends(gnomon(*command, "--strict"), PROBLEM, "after its end")
        self.assert_ends(gnomon("inspect", BOX, "--strict"), OK)

    def test_an_image_that_is_missing_is_left_out(self):
        scene = Path(split_glb(Path(BOX).read_bytes(), self.folder))
        document = json.loads(scene.read_text())
        document["images"] = [{"uri": "textures\\gone.png"}]
        document["textures"] = [{"source": 0}]
        for material in document["materials"]:
            material.setdefault("pbrMetallicRoughness", {})["baseColorTexture"] = {"index": 0}
        scene.write_text(json.dumps(document))
        self.assert_ends(self.render(scene=str(scene)), OK, "gnomon: warning: ", "textures/gone.png")

    def test_the_suffix_is_the_format(self):
        self.output = self.folder / "frame.exr"
        self.render("--view", "color", "--view", "depth")
        self.assertEqual(self.output.read_bytes()[:4], EXR_MAGIC)
        for suffix, magic in (("npy", b"\x93NUMPY"), ("npz", b"PK\3\4"), ("tiff", b"II*\0"), ("tif", b"II*\0"),
                              ("jpg", b"\xff\xd8\xff"), ("jpeg", b"\xff\xd8\xff"), ("webp", b"RIFF")):
            self.output = self.folder / f"frame.{suffix}"
            self.render()
            self.assertTrue(self.output.read_bytes().startswith(magic), suffix)

    def test_one_npz_holds_every_view(self):
        self.output = self.folder / "frame.npz"
        self.render("--view", "color", "--view", "depth")
        with zipfile.ZipFile(self.output) as archive:
            self.assertEqual(archive.namelist(), ["color.npy", "depth.npy", "report.json"])
        self.assertEqual(os.listdir(self.folder), ["frame.npz"])

    def test_folders_are_made(self):
        self.output = self.folder / "some" / "where" / "frame.png"
        report = self.folder / "reports" / "report.json"
        self.render("--report", str(report))
        self.assertTrue(self.output.exists() and report.exists())
        run = gnomon("render", BOX, *SMALL, "-o", str(self.output / "frame.png"))
        self.assert_ends(run, PROBLEM, f"The folder {self.output} can't be made")

    def test_several_views_are_several_files(self):
        run = self.render("--view", "color", "--view", "shadow")
        self.assertEqual(sorted(os.listdir(self.folder)), ["frame.color.png", "frame.shadow.png"])
        self.assertEqual(run.stdout.decode().splitlines(), [str(self.folder / "frame.color.png"), str(self.folder / "frame.shadow.png")])

    def test_standard_input_and_output(self):
        spec = json.dumps({"width": 64, "height": 48, "views": ["normal"]}).encode()
        run = gnomon("render", BOX, "--spec", "-", "-o", "-", stdin=spec)
        self.assert_ends(run, OK)
        self.render("--view", "normal")
        self.assertEqual(run.stdout, self.output.read_bytes())

    def test_the_report_can_be_asked_for_again(self):
        report = self.folder / "report.json"
        self.render("--orbit", "200,30", "--set", "shadow.cascadeCount=2", "--report", str(report))
        first = self.output.read_bytes()
        told = json.loads(report.read_text())
        self.assertEqual(told["spec"]["shadow"]["cascadeCount"], 2)
        self.assertIn("load", told["stages"])
        self.assertIn("encode", told["stages"])
        spec = self.folder / "spec.json"
        spec.write_text(json.dumps(told["spec"]))
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--spec", str(spec)), OK)
        self.assertEqual(self.output.read_bytes(), first)

    def test_a_reference_stands_beside_the_frame(self):
        report = self.folder / "report.json"
        flags = ["--sun", "135,40", "--view", "shadow", "--set", "shadow.filter.type=hard", "--set", "shadow.size=XSmall"]
        run = self.render(*flags, "--reference", "--report", str(report))
        *names, error = run.stdout.decode().splitlines()
        reference = self.folder / "frame.reference.png"
        self.assertEqual(names, [str(self.output), str(reference)])
        told = json.loads(report.read_text())
        metrics = told["reference"]["metrics"]
        self.assertGreater(metrics["misclassified"], 0)
        self.assertTrue(error.startswith("wrong {:.4f} % ".format(100 * metrics["misclassified"])), error)
        self.assertEqual(told["spec"]["lights"][0]["shadow"]["technique"], "shadowMap")
        frame, truth = self.output.read_bytes(), reference.read_bytes()
        self.assertNotEqual(frame, truth)
        self.render(*flags)
        self.assertEqual(self.output.read_bytes(), frame)
        self.render(*flags, "--set", "shadow.technique=rayTraced")
        self.assertEqual(self.output.read_bytes(), truth)
        self.render("--set", "shadow.technique=rayTraced", "--reference", "--report", "-")
        self.assertEqual(self.output.read_bytes(), reference.read_bytes())

    def test_a_reference_that_can_not_be_is_told(self):
        run = gnomon("render", BOX, "-o", str(self.output), *SMALL, "--reference", "--set", "shadow.enabled=false")
        self.assert_ends(run, PROBLEM, "(error)", "shadow")
        self.assert_ends(gnomon("render", BOX, "-o", "-", "--format", "png", "--reference"), USAGE, "--reference")

    def test_a_gltf_finds_the_files_beside_it(self):
        gltf = split_glb(Path(BOX).read_bytes(), self.folder)
        self.render()
        expected = self.output.read_bytes()
        self.render(scene=gltf)
        self.assertEqual(self.output.read_bytes(), expected)


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


class AgainstServer(ServerTest, CommandLine):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.url = "http://{}:{}".format(*cls.server.address)
        cls.where = ["--server", cls.url]


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

"""The command line through the shipped binary: exit codes, and problems with their flags."""

import unittest
from pathlib import Path

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, CommandLine, gnomon


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
            ["render", BOX, "-o", "a.png", "--sun-hours", "48.1,11.6"],
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

    def test_a_camera_that_the_scene_lacks(self):
        self.refused(BOX, "--camera", "nobody", said=["--camera (/camera/node)"])

    def test_a_server_that_is_not(self):
        self.refused(BOX, "--server", "http://127.0.0.1:1", said=["http://127.0.0.1:1: There was no reply"])
        self.refused(BOX, "--server", "127.0.0.1:8080", said=["is not a server's address"])

    def test_what_was_there_stays_when_the_frame_fails(self):
        self.output.write_bytes(b"old")
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--width", "0"), PROBLEM)
        self.assertEqual(self.output.read_bytes(), b"old")


if __name__ == "__main__":
    unittest.main()

"""The client's configuration through the shipped binary: defaults, presets, what is in force, what is wrong."""

import json
import unittest

from command_line import BOX, OK, PROBLEM, USAGE, CommandLine, gnomon
from shipped_server import png_size

CONFIGURATION = """
size = "64x48"     # small pictures
sun = "135,40"
server = ""

[preset.tiny]
size = "16x12"
set = ["shadow.cascadeCount=2"]
"""


class ClientConfiguration(CommandLine):
    def setUp(self):
        super().setUp()
        (self.folder / "gnomon").mkdir()
        self.config = self.folder / "gnomon/config"
        self.config.write_text(CONFIGURATION)
        self.there = {"XDG_CONFIG_HOME": str(self.folder)}

    def frame(self, *arguments, **variables):
        """The size of the frame, and its spec as it was drawn."""
        report = self.folder / "report.json"
        run = gnomon("render", BOX, "-o", str(self.output), "--report", str(report), *arguments, **variables)
        self.assert_ends(run, OK)
        return png_size(self.output.read_bytes()), json.loads(report.read_text())["spec"]

    def test_defaults_and_presets_are_flags(self):
        size, spec = self.frame(**self.there)
        self.assertEqual((size, spec["lights"][0]["sun"]["azimuthDegrees"]), ((64, 48), 135))
        size, spec = self.frame("--preset", "tiny", "--set", "shadow.filter.size=3", **self.there)
        self.assertEqual((size, spec["shadow"]["cascadeCount"], spec["shadow"]["filter"]["size"]), ((16, 12), 2, 3))
        self.assertEqual(self.frame("--preset", "tiny", "--size", "20x10", **self.there)[0], (20, 10))

    def test_a_switch_with_a_word_and_a_file_or_a_word_are_flags_too(self):
        self.config.write_text('size = "16x12"\nground = true\nenvironment = "sky"\n'
                               '[preset.seen]\nground = "surface"\nenvironment = "studio"\n')  # fmt: skip
        spec = self.frame(**self.there)[1]
        self.assertEqual((spec["ground"]["mode"], "sky" in spec["environment"]), ("catcher", True))
        spec = self.frame("--preset", "seen", **self.there)[1]
        self.assertEqual((spec["ground"]["mode"], "sky" in spec["environment"]), ("surface", False))
        self.config.write_text('environment = "sky.hdr"\ntransparent = true\nquiet = "maybe"')
        self.assert_ends(gnomon("render", "--show-config", **self.there), USAGE, "it is true or false")
        self.config.write_text('environment = "sky.hdr"\ntransparent = true')
        lines = gnomon("render", "--show-config", **self.there).stdout.decode().splitlines()
        self.assertIn(f'environment = "{self.folder}/gnomon/sky.hdr"  # {self.config}:1', lines)
        self.assertIn(f"transparent = 0  # {self.config}:2", lines)

    def test_the_file_can_be_another_one_or_none(self):
        other = self.folder / "other"
        other.write_text("size = '8x6'")
        self.assertEqual(self.frame("--config", str(other), **self.there)[0], (8, 6))
        self.assertEqual(self.frame(GNOMON_CLIENT_CONFIG=str(other), **self.there)[0], (8, 6))
        self.assertEqual(self.frame("--no-config", GNOMON_CLIENT_CONFIG=str(other), **self.there)[0], (1280, 720))
        home = {"XDG_CONFIG_HOME": "", "HOME": str(self.folder)}
        (self.folder / ".config").mkdir()
        (self.folder / "gnomon").rename(self.folder / ".config/gnomon")
        self.assertEqual(self.frame(**home)[0], (64, 48))

    def test_a_request_means_the_same_with_and_without_it(self):
        spec = self.folder / "spec.json"
        spec.write_text('{"width": 32}')
        size, drawn = self.frame("--spec", str(spec), **self.there)
        self.assertEqual(size, (32, 720))
        plans = [gnomon("plan", BOX, *request, **where).stdout
                 for request in (["--spec", str(spec)], [str(spec)]) for where in (self.there, {})]  # fmt: skip
        self.assertTrue(plans[0])
        self.assertEqual(set(plans), {plans[0]})

    def test_what_is_in_force_is_printed_and_is_a_configuration(self):
        run = gnomon("render", "--show-config", "--preset", "tiny", "--exposure", "1", **self.there)
        self.assert_ends(run, OK)
        lines = run.stdout.decode().splitlines()
        self.assertEqual(lines[:2], [f"# Configuration: {self.config}", "# Preset: tiny"])
        self.assertIn(f'size = "16x12"  # preset tiny, {self.config}:7', lines)
        self.assertIn(f'sun = "135,40"  # {self.config}:3', lines)
        self.assertIn("exposure = 1  # command line", lines)
        self.assertIn("patience = 600  # default", lines)
        again = self.folder / "again"
        again.write_bytes(run.stdout)
        self.assertEqual(self.frame("--config", str(again))[0], (16, 12))
        run = gnomon("sequence", "--show-config", **self.there)
        self.assertIn(f'size = "64x48"  # {self.config}:2', run.stdout.decode().splitlines())
        run = gnomon("ls", "--show-config", GNOMON_URL="http://there", **self.there)
        self.assertIn(b'server = "http://there"  # environment, GNOMON_URL', run.stdout)

    def test_what_is_wrong_has_its_place(self):
        for text, said in (("sise = 1", ["config:1: There is no key sise; did you mean size?"]),
                           ("\nsize = 'x'", ["config:2: size: needs WIDTHxHEIGHT"]),
                           ("output = 'a.png'", ["config:1", "output"]),
                           ("[presets]", ["config:1", "[preset.NAME]"])):  # fmt: skip
            self.config.write_text(text)
            self.assert_ends(gnomon("render", BOX, "-o", str(self.output), **self.there), USAGE, *said)
        self.config.write_text("\nsize = '0x1'")
        run = gnomon("render", BOX, "-o", str(self.output), "--problems", "json", **self.there)
        self.assert_ends(run, PROBLEM)
        [problem] = json.loads(run.stderr)["problems"]
        self.assertEqual((problem["flag"], problem["place"]), ("--width", f"{self.config}:2"))
        for arguments in (["--preset", "none"], ["--config", str(self.folder / "none")], ["--config", "a", "--no-config"]):
            self.assert_ends(gnomon("render", BOX, "-o", str(self.output), *arguments, **self.there), USAGE, arguments[0]
                             if arguments[0] == "--preset" else "none" if len(arguments) == 2 else "--no-config")  # fmt: skip

    def test_help_and_other_programs_do_without(self):
        self.config.write_text("broken")
        for arguments in (["render", "--help"], ["man"], ["openapi"], ["inspect", BOX], ["--version"]):
            self.assert_ends(gnomon(*arguments, **self.there), OK)
        self.assert_ends(gnomon("upload", BOX, **self.there), USAGE, "config:1")


if __name__ == "__main__":
    unittest.main()

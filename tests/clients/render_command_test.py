"""gnomon render in its own process: the files that it writes, and what it says."""

import json
import os
import unittest
import zipfile
from pathlib import Path

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, CommandLine, gnomon, split_glb
from environments import RED
from extreme_scene import demo_with
from shipped_server import EXR_MAGIC, png_size


class Render(CommandLine):
    def test_a_frame_is_a_file_and_nothing_is_said(self):
        run = self.render("--sun", "135,40")
        self.assertEqual(png_size(self.output.read_bytes()), (64, 48))
        self.assertEqual((run.stdout, run.stderr), (b"", b""))
        self.assertEqual(os.listdir(self.folder), ["frame.png"])

    def test_the_sun_stands_by_place_and_time(self):
        self.render("--sun", "48.1,11.6 2026-06-21T17:00+02:00")
        there = self.output.read_bytes()
        sun = {"latitudeDegrees": 48.1, "longitudeDegrees": 11.6, "time": "2026-06-21T15:00:00Z"}
        self.render("--set", "lights=" + json.dumps([{"sun": sun}]))
        self.assertEqual(self.output.read_bytes(), there)
        self.render("--sun", "48.1,11.6 2026-06-21T08:00+02:00")
        self.assertNotEqual(self.output.read_bytes(), there)
        night = self.render("--sun", "48.1,11.6 2026-06-21T23:30+02:00").stderr.decode()
        self.assertRegex(night, "^gnomon: warning: Light 0 gives no light: [^\n]* 1[0-9] degrees below the horizon.\n$")
        for text, said in (("48.1,11.6 noon", "--sun (/lights/0/sun/time)"),
                           ("95,11.6 2026-06-21T17:00Z", "--sun (/lights/0/sun/latitudeDegrees)")):
            run = gnomon("render", BOX, "-o", str(self.output), "--sun", text)
            self.assert_ends(run, PROBLEM, said)

    def test_hours_of_sun_are_of_a_place_and_a_day(self):
        report = self.folder / "report.json"
        self.render("--sun-hours", "48.1,11.6 2026-06-21", "--report", str(report))
        shown = self.output.read_bytes()
        found = json.loads(report.read_text())["sunHours"]
        self.assertAlmostEqual(found["daylightHours"], 16, delta=0.3)
        self.assertLess(found["minHours"], found["meanHours"])
        zone = "+00:46"  # 11.6 degrees are 46.4 minutes
        day = {"latitudeDegrees": 48.1, "longitudeDegrees": 11.6,
               "begin": f"2026-06-21T00:00{zone}", "end": f"2026-06-22T00:00{zone}"}
        self.render("--view", "sunHours", "--set", "sunHours=" + json.dumps(day))
        self.assertEqual(self.output.read_bytes(), shown)
        run = gnomon("render", BOX, "-o", str(self.output), "--sun-hours", "95,11.6 2026-06-21")
        self.assert_ends(run, PROBLEM, "--sun-hours (/sunHours/latitudeDegrees)")
        run = gnomon("render", BOX, "-o", str(self.output), "--sun-hours", "48.1,11.6 2026-06-21T08:00/2026-06-22")
        self.assert_ends(run, PROBLEM, "--sun-hours (/sunHours/begin)", "zone")

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

    def test_places_out_of_reach_are_a_problem_and_no_crash(self):
        scene = self.folder / "far.glb"
        scene.write_bytes(demo_with("gold", 1e11))
        for technique in ("rayTraced", "shadowMap"):
            run = gnomon("render", str(scene), "-o", str(self.output), *SMALL, "--set", f"shadow.technique={technique}")
            self.assert_ends(run, PROBLEM, "too far", '"gold"')
        scene.write_bytes(demo_with("gold", 1.9e9))
        self.render("--set", "shadow.technique=rayTraced", scene=str(scene))

    def test_a_scene_without_a_name_is_a_problem_and_no_crash(self):
        self.assert_ends(gnomon("render", "", "-o", str(self.output), *SMALL), PROBLEM, "gnomon: ")

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

    def test_an_environment_goes_with_the_scene(self):
        scene = self.folder / "scene.glb"
        scene.write_bytes(Path(BOX).read_bytes())
        elsewhere = self.folder / "lights" / "red.hdr"
        elsewhere.parent.mkdir()
        elsewhere.write_bytes(RED)
        report = self.folder / "report.json"
        usual = self.render(scene=str(scene)) and self.output.read_bytes()
        self.render("--environment", str(elsewhere), "--rotate-environment", "90", "--report", str(report), scene=str(scene))
        lit = self.output.read_bytes()
        self.assertNotEqual(lit, usual)
        told = json.loads(report.read_text())["spec"]["environment"]
        self.assertEqual((told["file"], told["rotationDegrees"]), ("red.hdr", 90))
        spec = self.folder / "spec.json"
        spec.write_text(json.dumps({"environment": {"file": "red.hdr"}}))
        run = gnomon("render", str(scene), "-o", str(self.output), *SMALL, "--spec", str(spec))
        self.assert_ends(run, PROBLEM, "red.hdr", "The environment names it")
        (self.folder / "red.hdr").write_bytes(RED)
        self.render("--spec", str(spec), "--rotate-environment", "90", scene=str(scene))
        self.assertEqual(self.output.read_bytes(), lit)
        self.render("--spec", str(spec), "--environment", "studio", scene=str(scene))
        self.assertEqual(self.output.read_bytes(), usual)
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--environment", "red.png"), USAGE, ".hdr or .exr")
        elsewhere.write_bytes(RED[:100])
        run = gnomon("render", str(scene), "-o", str(self.output), *SMALL, "--environment", str(elsewhere))
        self.assert_ends(run, PROBLEM, "--environment")

    def test_a_switch_with_a_word_does_not_take_the_scene(self):
        run = gnomon("render", *SMALL, "--transparent", "--ground", BOX, "-o", str(self.output), "--report", "-")
        self.assert_ends(run, OK)
        told = json.loads(run.stdout)["spec"]
        self.assertEqual((told["ground"]["mode"], told["background"]["alpha"]), ("catcher", 0))
        run = gnomon("render", BOX, "-o", str(self.output), "--ground=table")
        self.assert_ends(run, PROBLEM, "--ground", "catcher or surface")

    def test_a_gltf_finds_the_files_beside_it(self):
        gltf = split_glb(Path(BOX).read_bytes(), self.folder)
        self.render()
        expected = self.output.read_bytes()
        self.render(scene=gltf)
        self.assertEqual(self.output.read_bytes(), expected)


if __name__ == "__main__":
    unittest.main()

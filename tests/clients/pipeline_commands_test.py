"""The command line in pipelines: pipes, many pictures in one run, fields as flags, comparison, watching, shells."""

import json
import re
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, CommandLine, gnomon, split_glb
from shipped_server import BINARY, SCENES, TIMEOUT, environment, png_size

CAMERAS = str(SCENES / "cameras.glb")


class Pipes(CommandLine):
    def test_a_scene_from_standard_input_to_standard_output(self):
        self.render()
        run = gnomon("render", "-", "-o", "-", "--format", "png", *SMALL, stdin=Path(BOX).read_bytes())
        self.assert_ends(run, OK)
        self.assertEqual(run.stdout, self.output.read_bytes())

    def test_only_one_thing_is_read_from_standard_input(self):
        for order in (["render", "-", "-o", "-", "--spec", "-"], ["plan", "-", "--spec", "-"], ["plan", "-", "-"]):
            self.assert_ends(gnomon(*order), USAGE, "only once")
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--format", "exr"), USAGE, "png")

    def test_what_is_no_scene_is_refused(self):
        self.assert_ends(gnomon("render", "-", "-o", "-", stdin=b"no scene"), PROBLEM, "gnomon: ")


class Fields(CommandLine):
    def test_a_flag_is_its_field(self):
        self.render("--eye", "3,3,5", "--target", "0,0.5,0", "--fov", "40", "--background", "0.1,0.2,0.4", "--exposure", "0.5")
        flags = self.output.read_bytes()
        fields = ["camera.eye=[3,3,5]", "camera.target=[0,0.5,0]", "camera.perspective.fovYDegrees=40",
                  "background.color=[0.1,0.2,0.4]", "exposure=0.5"]  # fmt: skip
        self.render(*(part for field in fields for part in ("--set", field)))
        self.assertEqual(flags, self.output.read_bytes())
        self.render()
        self.assertNotEqual(flags, self.output.read_bytes())

    def test_an_alpha_makes_the_background_transparent(self):
        self.render("--background", "0,0,0,0")
        flag = self.output.read_bytes()
        self.render("--set", "background.color=[0,0,0]", "--set", "background.alpha=0")
        self.assertEqual(flag, self.output.read_bytes())
        self.assertEqual(flag[25], 6)  # the IHDR's color type: with alpha
        self.assert_ends(gnomon("render", BOX, "-o", "a.png", "--background", "0,0"), USAGE, "or four with alpha")

    def test_an_element_of_a_list_is_spelled_as_fields_are(self):
        self.render("--set", "lights[0].sun.azimuthDegrees=40", "--set", "lights[0].sun.elevationDegrees=30")
        sets = self.output.read_bytes()
        self.render("--sun", "40,30")
        self.assertEqual(sets, self.output.read_bytes())
        for path in ("lights[].intensity", "lights[3].intensity"):
            run = gnomon("render", BOX, "-o", str(self.output), "--set", f"{path}=3")
            self.assert_ends(run, PROBLEM, f"--set {path} ")

    def test_what_was_meant_is_guessed(self):
        for flags, meant in ((["--set", "shadow.filtr.size=7"], "filter"), (["--view", "dept"], "depth")):
            run = gnomon("render", BOX, "-o", str(self.output), *flags)
            self.assert_ends(run, PROBLEM, f"did you mean {meant}?")

    def test_a_request_that_is_broken_names_its_file(self):
        spec = self.folder / "spec.json"
        for text, said in (('{"width": 64,', "This is not JSON"), ('{"width": 0}', "/width: ")):
            spec.write_text(text)
            for command in (["render", BOX, "-o", str(self.output)], ["plan", BOX], ["evaluate", BOX]):
                self.assert_ends(gnomon(*command, "--spec", str(spec)), PROBLEM, f"({spec})", said)

    def test_a_placement_replaces_that_of_the_request(self):
        spec = self.folder / "spec.json"
        spec.write_text('{"camera": {"orbit": {"azimuthDegrees": 10}}}')
        self.render("--spec", str(spec), "--eye", "3,3,5")
        placed = self.output.read_bytes()
        self.render("--eye", "3,3,5")
        self.assertEqual(placed, self.output.read_bytes())

    def test_faults_name_the_flag(self):
        self.assert_ends(gnomon("render", BOX, "-o", "a.png", "--eye", "1,2"), USAGE, "--eye")
        self.assert_ends(gnomon("render", BOX, "-o", "a.png", "--eye", "1,2,3", "--orbit", "1,2"), USAGE, "--orbit")
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--fov", "180"), PROBLEM, "--fov (/camera/perspective")
        self.assert_ends(gnomon("render", BOX, "-o", str(self.output), "--animation", "none"), PROBLEM, "--animation")

    def test_problems_as_json(self):
        run = gnomon("render", BOX, "-o", str(self.output), "--width", "0", "--exposure", "999", "--problems", "json")
        self.assert_ends(run, PROBLEM)
        told = {problem["pointer"]: problem for problem in json.loads(run.stderr)["problems"]}
        self.assertEqual(told["/width"]["flag"], "--width")
        self.assertEqual(told["/exposure"]["flag"], "--exposure")


class Many(CommandLine):
    def named_alike(self):
        """Two scenes of one name, in folders of their own."""
        scenes = []
        for folder in ("one", "two"):
            (self.folder / folder).mkdir()
            scenes.append(str(shutil.copy(BOX, self.folder / folder / "box.glb")))
        return scenes

    def test_scenes_of_one_name_are_told_apart_by_their_folders(self):
        scenes = self.named_alike()
        self.assert_ends(gnomon("render", *scenes, "-o", str(self.folder / "{folder}-{scene}.png"), *SMALL), OK)
        for folder in ("one", "two"):
            self.assertEqual(png_size((self.folder / f"{folder}-box.png").read_bytes()), (64, 48))

    def test_without_their_folders_the_rest_is_drawn(self):
        scenes = [*self.named_alike(), CAMERAS]
        run = gnomon("render", *scenes, "-o", str(self.folder / "{scene}.png"), *SMALL)
        self.assert_ends(run, PROBLEM, f"({scenes[1]})", scenes[0], "a name with {folder}")
        self.assertEqual(len(run.stderr.splitlines()), 1)
        for name in ("box", "cameras"):
            self.assertEqual(png_size((self.folder / f"{name}.png").read_bytes()), (64, 48))

    def test_a_scene_that_is_cut_is_named(self):
        cut = self.folder / "cut.glb"
        cut.write_bytes(Path(BOX).read_bytes()[:600])
        length = str(Path(BOX).stat().st_size)
        for command in (["render", str(cut), "-o", str(self.output)], ["inspect", str(cut)], ["plan", str(cut)],
                        ["turntable", str(cut), "--frames", "2", "-o", str(self.folder / "{frame}.png")]):  # fmt: skip
            self.assert_ends(gnomon(*command), PROBLEM, f"gnomon: {cut}: ", "600", length)

    def test_a_camera_is_named_or_numbered(self):
        cameras = json.loads(gnomon("inspect", CAMERAS, "--json").stdout)["cameras"]
        for index, camera in enumerate(cameras):
            pictures = set()
            for asked in (camera["name"], str(index), f"node:{camera['node']}"):
                self.render("--camera", asked, scene=CAMERAS)
                pictures.add(self.output.read_bytes())
            self.assertEqual(len(pictures), 1, camera)
        run = gnomon("render", CAMERAS, "-o", str(self.output), "--camera", str(len(cameras)))
        self.assert_ends(run, PROBLEM, "--camera", f"0 = {cameras[0]['name']} (node:{cameras[0]['node']})")
        self.assertIn(f"1: node {cameras[1]['node']} ", gnomon("inspect", CAMERAS).stdout.decode())

    def test_every_scene_by_every_camera(self):
        names = [camera["name"] for camera in json.loads(gnomon("inspect", CAMERAS, "--json").stdout)["cameras"]][:2]
        self.assertEqual(len(set(names)), 2)
        flags = [part for name in names for part in ("--camera", name)]
        run = gnomon("render", CAMERAS, "-o", str(self.folder / "{scene}-{camera}.png"), *SMALL, *flags)
        self.assert_ends(run, OK)
        for name in names:
            self.render("--camera", name, scene=CAMERAS)
            self.assertEqual((self.folder / f"cameras-{name}.png").read_bytes(), self.output.read_bytes())

    def test_one_failure_does_not_stop_the_others(self):
        run = gnomon("render", str(self.folder / "none.glb"), BOX, "-o", str(self.folder / "{scene}.png"), *SMALL)
        self.assert_ends(run, PROBLEM, "none.glb", "no such file")
        self.assertEqual(png_size((self.folder / "box_on_plane.png").read_bytes()), (64, 48))

    def test_collisions_and_strange_placeholders_are_refused(self):
        for name, said in (("a.png", "more than once"), ("{camra}.png", "{camra}")):
            run = gnomon("render", BOX, CAMERAS, "-o", str(self.folder / name), *SMALL)
            self.assert_ends(run, PROBLEM, said)
        self.assertEqual(list(self.folder.iterdir()), [])


class Compare(CommandLine):
    def test_the_exit_code_is_the_verdict(self):
        self.render()
        other = self.folder / "other.png"
        self.assert_ends(gnomon("render", BOX, "-o", str(other), *SMALL, "--exposure", "1"), OK)
        same = gnomon("compare", str(self.output), str(self.output))
        self.assert_ends(same, OK)
        self.assertIn(b"largest 0 ", same.stdout)
        diff = self.folder / "diff.png"
        self.assert_ends(gnomon("compare", str(self.output), str(other), "--diff", str(diff)), PROBLEM)
        self.assertEqual(png_size(diff.read_bytes()), (64, 48))
        for passes in (["--threshold", "1"], ["--share", "1"]):
            self.assert_ends(gnomon("compare", str(self.output), str(other), *passes), OK)
        self.assert_ends(gnomon("compare", str(self.output), str(other), "--threshold", "2"), USAGE)

    def test_floats_are_compared_layer_by_layer(self):
        files = [self.folder / "a.exr", self.folder / "b.exr"]
        views = ["--view", "color", "--view", "depth", "--view", "shadow", "--view", "reference",
                 "--set", "shadow.technique=shadowMap"]
        for file, more in zip(files, ([], ["--exposure", "1"])):
            self.assert_ends(gnomon("render", BOX, "-o", str(file), *SMALL, *views, *more), OK)
        run = gnomon("compare", *map(str, files))
        self.assert_ends(run, PROBLEM)
        told = dict(line.split(": largest ") for line in run.stdout.decode().splitlines())
        self.assertEqual(list(told), ["color", "depth", "reference", "shadow"])
        self.assertGreater(float(told["color"].split()[0]), 0.1)
        self.assertTrue(told["depth"].startswith("0 at 0,0"), told)
        self.assert_ends(gnomon("compare", *map(str, files), "--layer", "depth", "--layer", "shadow"), OK)
        self.assert_ends(gnomon("compare", *map(str, files), "--threshold", "1000"), OK)
        crossed = gnomon("compare", *map(str, files), "--layer", "shadow=reference", "--diff", str(self.folder / "d.png"))
        self.assert_ends(crossed, PROBLEM)
        self.assertIn(b"shadow=reference: largest ", crossed.stdout)
        self.assertEqual(png_size((self.folder / "d.png").read_bytes()), (64, 48))
        self.assert_ends(gnomon("compare", *map(str, files), "--diff", str(self.folder / "e.png")), PROBLEM)
        self.assertTrue((self.folder / "e.depth.png").exists())
        self.assert_ends(gnomon("compare", *map(str, files), "--layer", "dept"), PROBLEM, "--layer", "color, depth, reference, shadow", "dept")

    def test_what_can_not_be_compared_is_told(self):
        self.render()
        other = self.folder / "other.exr"
        self.assert_ends(gnomon("render", BOX, "-o", str(other), *SMALL), OK)
        self.assert_ends(gnomon("compare", str(self.output), str(other)), PROBLEM, "kind", "8 bits", "linear floats")
        two = self.folder / "two.exr"
        self.assert_ends(gnomon("render", BOX, "-o", str(two), *SMALL, "--view", "color", "--view", "depth"), OK)
        self.assert_ends(gnomon("compare", str(two), str(other)), PROBLEM, "no such layer", "depth")
        self.assert_ends(gnomon("render", BOX, "-o", str(two), "--size", "32x48"), OK)
        self.assert_ends(gnomon("compare", str(two), str(other)), PROBLEM, "64x48", "32x48")
        two.write_bytes(two.read_bytes()[:300])
        self.assert_ends(gnomon("compare", str(two), str(other)), PROBLEM, "two.exr")


class Watch(CommandLine):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "scene.glb"
        shutil.copy(BOX, self.scene)

    def watch(self, scene, *more):
        """Begins to watch; gives the first picture."""
        self.process = subprocess.Popen([BINARY, "watch", str(scene), "-o", str(self.output), *more],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment())  # fmt: skip
        self.addCleanup(self.process.communicate)
        self.addCleanup(self.process.kill)
        return self.next()

    def next(self):
        self.assertIn(b"frame.png", self.process.stdout.readline())
        return self.output.read_bytes()

    def replace(self, content, target=None):
        """As editors save: a new file is renamed over the old one."""
        new = self.folder / "new"
        new.write_bytes(content)
        new.rename(target or self.scene)

    def test_a_request_that_changes_is_a_new_picture(self):
        spec = self.folder / "spec.json"
        spec.write_text('{"width": 64, "height": 48}')
        first = self.watch(self.scene, "--spec", str(spec), "--sun", "135,40")
        spec.write_text('{"width": 32, "height": 48}')  # in place
        self.assertEqual(png_size(self.next()), (32, 48))
        self.replace(b'{"width": 32, "height": 0}', spec)
        self.assertIn(b"/height", self.process.stderr.readline())
        self.replace(b'{"width": 64, "height": 48}', spec)
        self.assertEqual(self.next(), first)

    def test_files_that_the_scene_names_are_watched(self):
        scene = split_glb(Path(BOX).read_bytes(), self.folder)
        buffer = self.folder / "parts/buffer 0.bin"
        whole = buffer.read_bytes()
        first = self.watch(scene, *SMALL)
        self.replace(bytes(len(whole)), buffer)  # every corner in one place: nothing is left to see
        self.assertNotEqual(self.next(), first)
        self.assertIn(b"gnomon: warning: The min and max of an accessor", self.process.stderr.readline())
        buffer.unlink()
        self.assertIn(b"buffer 0.bin", self.process.stderr.readline())
        self.replace(whole, buffer)
        self.assertEqual(self.next(), first)

    def test_it_renders_again_and_outlives_broken_files(self):
        first = self.watch(self.scene, *SMALL)
        self.replace(Path(CAMERAS).read_bytes())
        self.assertIn(b"frame.png", self.process.stdout.readline())
        self.assertNotEqual(self.output.read_bytes(), first)
        self.replace(b"broken")
        self.assertIn(b"gnomon: ", self.process.stderr.readline())
        self.replace(Path(BOX).read_bytes())
        self.assertIn(b"frame.png", self.process.stdout.readline())
        self.assertEqual(self.output.read_bytes(), first)
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(TIMEOUT), OK)


class Shells(CommandLine):
    def complete(self, *words):
        script = self.folder / "completion"
        script.write_bytes(gnomon("completion", "bash").stdout)
        asked = 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _gnomon; printf "%s\\n" "${COMPREPLY[@]}"'
        run = subprocess.run(["bash", "-c", asked, str(script), *words], capture_output=True, text=True, timeout=TIMEOUT)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout.split()

    def test_bash_completes_commands_flags_and_values(self):
        self.assertEqual(self.complete("gnomon", "comp"), ["compare", "completion"])
        self.assertEqual(self.complete("gnomon", "render", "--dev"), ["--device"])
        self.assertEqual(self.complete("gnomon", "render", "--device", ""), ["auto", "cpu", "gl"])
        self.assertIn("albedo", self.complete("gnomon", "render", "--view", "a"))
        self.assertNotIn("worker", self.complete("gnomon", ""))

    def test_the_manual_page_has_every_flag_and_no_fault(self):
        page = gnomon("man").stdout
        for flag in (b"\\-\\-eye", b"\\-\\-patience", b"\\-\\-allowed\\-hosts"):
            self.assertIn(flag, page)
        if shutil.which("groff"):
            run = subprocess.run(["groff", "-man", "-ww", "-z"], input=page, capture_output=True, timeout=TIMEOUT)
            self.assertEqual((run.returncode, run.stderr), (0, b""))

    def test_other_shells_have_scripts_too(self):
        zsh, fish = (gnomon("completion", shell).stdout.decode() for shell in ("zsh", "fish"))
        self.assertTrue(zsh.startswith("#compdef gnomon"))
        commands = dict(re.findall(r"^    (\w+)\) _arguments(.*?) ;;$", zsh, re.MULTILINE | re.DOTALL))
        self.assertIn("'1:first:_files'", commands["compare"])
        self.assertIn("'2:second:_files'", commands["compare"])
        self.assertIn("'1:shell:(bash fish zsh)'", commands["completion"])
        for name, text in commands.items():  # the rest of the arguments can be one thing only
            self.assertLessEqual(text.count("'*:"), 1, name)
        self.assertIn("-l eye", fish)
        self.assertIn("'__fish_seen_subcommand_from completion' -f -a 'bash fish zsh'", fish)
        for shell, script in (("zsh", zsh), ("fish", fish)):
            if shutil.which(shell):
                run = subprocess.run([shell, "-n"], input=script.encode(), capture_output=True, timeout=TIMEOUT)
                self.assertEqual((run.returncode, run.stderr), (0, b""), shell)

    def test_what_describes_the_api_is_json(self):
        self.assertIn("/v1/scenes", json.loads(gnomon("openapi").stdout)["paths"])
        self.assertIn("cpu", json.loads(gnomon("capabilities").stdout)["devices"])


if __name__ == "__main__":
    unittest.main()

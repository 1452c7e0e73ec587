"""gnomon sequence and gnomon turntable: the same frames here and on a server, under the names that were asked for."""

import json
import unittest

from command_line import BOX, OK, PROBLEM, SMALL, USAGE, CommandLine, gnomon
from shipped_server import Server, png_size
from webm import Video

REQUEST = {
    "spec": {"width": 64, "height": 48, "antialiasing": "none"},
    "keys": [{"camera": {"orbit": {"azimuthDegrees": 200}}}, {"camera": {"orbit": {"azimuthDegrees": 230}}}],
    "count": 4,
}


class Sequences(CommandLine):
    def run_sequence(self, name, request, *flags):
        run = gnomon("sequence", BOX, "--spec", "-", "-o", str(self.folder / name), *flags, stdin=json.dumps(request).encode())
        return run

    def files(self, pattern):
        return [path.read_bytes() for path in sorted(self.folder.glob(pattern))]

    def test_gives_every_frame_here_as_on_a_server(self):
        self.assert_ends(self.run_sequence("here-{frame}.png", REQUEST, "--device", "cpu"), OK)
        here = self.files("here-*.png")
        self.assertEqual(len(here), 4)
        self.assertEqual(len(set(here)), 4)
        self.assertEqual(png_size(here[0]), (64, 48))
        with Server("--device", "cpu", "--workers", "1") as server:
            url = "http://%s:%d" % server.address
            self.assert_ends(self.run_sequence("there-{frame}.png", REQUEST, "--server", url), OK)
        self.assertEqual(self.files("there-*.png"), here)

    def test_other_videos_than_webm_are_told_what_there_is(self):
        for name in ("turn.mp4", "turn.MOV", "turn-{frame}.mkv", "turn.gif"):
            run = gnomon("turntable", BOX, "-o", str(self.folder / name), "--frames", "2")
            self.assert_ends(run, USAGE, "videos are .webm")
            self.assertNotIn("{frame} in its name", run.stderr.decode())
        self.assert_ends(gnomon("turntable", BOX, "-o", "turn.png"), USAGE, "needs {frame}", ".webm")
        self.assert_ends(gnomon("turntable", BOX, "-o", "turn-{frame}.bmp"), USAGE, ".png", ".webm")

    def test_a_request_that_is_broken_names_its_file(self):
        request = self.folder / "request.json"
        for text in ('{"spec": {', '{"count": 0}', '{"spec": {"width": 0}, "frames": [{}]}'):
            request.write_text(text)
            run = gnomon("sequence", BOX, str(request), "-o", str(self.folder / "{frame}.png"))
            self.assert_ends(run, PROBLEM, f"({request})")

    def test_the_request_may_stand_behind_the_scene(self):
        request = self.folder / "request.json"
        request.write_text(json.dumps(REQUEST))
        self.assert_ends(gnomon("sequence", BOX, str(request), "-o", str(self.folder / "behind-{frame}.png")), OK)
        self.assert_ends(self.run_sequence("named-{frame}.png", REQUEST), OK)
        self.assertEqual(self.files("behind-*.png"), self.files("named-*.png"))
        both = gnomon("sequence", BOX, str(request), "--spec", str(request), "-o", str(self.folder / "both-{frame}.png"))
        self.assert_ends(both, USAGE, "--spec excludes request")

    def test_goes_on_from_a_frame_with_what_its_report_carries(self):
        report = self.folder / "report.json"
        self.assert_ends(self.run_sequence("all-{frame}.png", REQUEST), OK)
        half = dict(REQUEST, frames=[{"camera": {"orbit": {"azimuthDegrees": 200 + 10 * i}}} for i in range(2)])
        del half["keys"], half["count"]
        self.assert_ends(self.run_sequence("half-{frame}.png", half, "--report", str(report)), OK)
        rest = dict(REQUEST, first=2, carried=json.loads(report.read_text())["carried"])
        self.assert_ends(self.run_sequence("rest-{frame}.png", rest), OK)
        self.assertEqual(self.files("half-*.png") + self.files("rest-*.png"), self.files("all-*.png"))

    def test_several_views_have_their_names(self):
        run = self.run_sequence("{view}-{frame}.png", REQUEST, "--view", "color", "--view", "depth")
        self.assert_ends(run, OK)
        self.assertIn(b"8 pictures", run.stdout)
        self.assertEqual(len(self.files("depth-*.png")), 4)

    def test_a_video_here_has_the_frames_of_one_from_a_server(self):
        report = self.folder / "report.json"
        flags = ("--frames-per-second", "8", "--video-quality", "60", "--device", "cpu")
        run = self.run_sequence("here.webm", REQUEST, *flags, "--report", str(report))
        self.assert_ends(run, OK)
        self.assertIn(b"4 frames", run.stdout)
        here = Video((self.folder / "here.webm").read_bytes())
        self.assertEqual((here.size, here.duration, len(here.blocks)), ((64, 48), 0.5, 4))
        self.assertEqual(here.tags["GNOMON_REPORT"], json.loads(report.read_text()))
        with Server("--device", "cpu", "--workers", "1") as server:
            url = "http://%s:%d" % server.address
            self.assert_ends(self.run_sequence("there.webm", REQUEST, *flags[:4], "--server", url, "--report", str(report)), OK)
            broken = dict(REQUEST, frames=[{}, {"camera": {"node": "nobody"}}])
            del broken["keys"], broken["count"]
            self.assert_ends(self.run_sequence("x.webm", broken, "--server", url), PROBLEM, "/frames/1/camera/node")
        self.assertEqual(Video((self.folder / "there.webm").read_bytes()).blocks, here.blocks)
        self.assertEqual([frame["index"] for frame in json.loads(report.read_text())["frames"]], [0, 1, 2, 3])
        self.assert_ends(self.run_sequence("x.webm", broken), PROBLEM, "/frames/1/camera/node")
        self.assertEqual(self.files("x.*"), [])

    def test_faults_name_their_place(self):
        self.assert_ends(self.run_sequence("x-{frame}.webm", REQUEST), USAGE, "{frame}")
        self.assert_ends(self.run_sequence("x.webm", {"frames": [{}, {"width": 80}]}), PROBLEM, "/frames/1/width")
        self.assert_ends(self.run_sequence("x.webm", REQUEST, "--video-quality", "0"), USAGE, "--video-quality")
        self.assert_ends(gnomon("sequence", BOX, "--spec", "-", "-o", "frame.png"), USAGE, "{frame}")
        self.assert_ends(gnomon("sequence", BOX, "-o", "{frame}.png"), USAGE, "--spec is required")
        broken = dict(REQUEST, count=1)
        self.assert_ends(self.run_sequence("x-{frame}.png", broken), PROBLEM, "count")
        broken = {"frames": [{}, {"camera": {"orbit": {"elevationDegrees": 100}}}]}
        self.assert_ends(self.run_sequence("x-{frame}.png", broken), PROBLEM, "/frames/1/camera/orbit/elevationDegrees")
        self.assertEqual(self.files("x-*"), [])


class Turntables(CommandLine):
    def turn(self, *flags):
        return gnomon("turntable", BOX, "--frames", "6", "-o", str(self.folder / "turn-{frame}.png"), *SMALL, *flags)

    def test_turns_around_the_scene_at_one_distance(self):
        report = self.folder / "report.json"
        self.assert_ends(self.turn("--report", str(report)), OK)
        frames = [path.read_bytes() for path in sorted(self.folder.glob("turn-*.png"))]
        self.assertEqual(len(frames), 6)
        self.assertEqual(len(set(frames)), 6)
        self.assertEqual([frame["index"] for frame in json.loads(report.read_text())["frames"]], list(range(6)))

    def test_turns_in_a_video(self):
        output = str(self.folder / "turn.webm")
        self.assert_ends(gnomon("turntable", BOX, "--frames", "6", "-o", output, "--frames-per-second", "12", *SMALL), OK)
        video = Video((self.folder / "turn.webm").read_bytes())
        self.assertEqual((len(video.blocks), video.duration), (6, 0.5))

    def test_a_camera_that_stands_elsewhere_is_refused(self):
        self.assert_ends(self.turn("--eye", "1,2,3"), PROBLEM, "/camera")
        self.assert_ends(gnomon("turntable", BOX, "--frames", "1", "-o", "x-{frame}.png"), USAGE, "--frames")


if __name__ == "__main__":
    unittest.main()

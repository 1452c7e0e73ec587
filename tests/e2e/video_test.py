"""Sequences as video: a WebM that is whole, as long as it says, sent while it is drawn, and that tells how it ended."""

import json
import time
import unittest

from sequences_test import SPEC, SequenceTest, orbit
from shipped_server import SLOW
from webm import CLUSTER, Video


class Videos(SequenceTest):
    def video(self, request):
        reply = self.sequence(request, "video/webm")
        self.assertEqual(reply.status, 200, reply.body[:500])
        self.assertEqual(reply.headers["Content-Type"], "video/webm")
        return Video(reply.body)

    def test_a_block_a_frame_and_at_last_the_report(self):
        request = orbit(6, ["color", "depth"])
        request["spec"] = request["spec"] | {"width": 65, "height": 43, "output": {"format": "exr"}}
        video = self.video(request | {"framesPerSecond": 12.5})
        self.assertEqual(video.size, (65, 43))
        self.assertAlmostEqual(video.duration, 0.48)
        self.assertEqual(video.times, [0, 80, 160, 240, 320, 400])
        flags = [block[3] for block in video.blocks]
        self.assertEqual(flags, [0x80, 0, 0, 0, 0, 0])
        self.assertEqual(list(video.tags), ["GNOMON_REPORT"])
        report = video.tags["GNOMON_REPORT"]
        self.assertEqual([frame["index"] for frame in report["frames"]], list(range(6)))
        self.assertEqual(report["framesPerSecond"], 12.5)
        self.assertLessEqual({"queue", "load", "shadow", "shade", "encode"}, set(report["frames"][0]["stages"]))

    def test_quality_is_what_it_costs(self):
        sizes = []
        for quality in (10, 50, 90):
            sizes.append(sum(map(len, self.video(orbit(3) | {"videoQuality": quality}).blocks)))
        self.assertEqual(sizes, sorted(sizes))
        self.assertGreater(sizes[2], 2 * sizes[0])

    def test_a_later_first_frame_begins_a_file_of_its_own(self):
        request = orbit(6)
        carried = self.video(request | {"frames": request["frames"][:4]}).tags["GNOMON_REPORT"]["carried"]
        video = self.video(request | {"first": 4, "carried": carried})
        self.assertEqual(video.times, [0, 33])
        self.assertAlmostEqual(video.duration, 2 / 30, places=5)
        self.assertEqual(video.blocks[0][3], 0x80)
        self.assertEqual([frame["index"] for frame in video.tags["GNOMON_REPORT"]["frames"]], [4, 5])

    def test_frames_are_sent_as_they_are_drawn(self):
        request = {"spec": SPEC | {"width": 320, "height": 240}, "frames": [{"exposure": i / 500} for i in range(2000)]}
        with self.begin(request, "video/webm") as connection:
            received = b""
            while received.count(CLUSTER.to_bytes(4, "big")) < 3:  # of 2,000, which take minutes
                piece = connection.recv(1 << 16)
                self.assertTrue(piece)
                received += piece

    def test_what_the_report_tells_to_other_forms(self):
        events = self.sequence(orbit(1) | {"framesPerSecond": 24}, "text/event-stream").body.decode()
        self.assertIn('"framesPerSecond":24', events)

    def test_no_video_is_a_job(self):
        path = f"/v1/scenes/{self.scene}/sequences"
        body = json.dumps(orbit(2) | {"framesPerSecond": 20})
        reply = self.server.ask("POST", path, body, self.headers("video/webm") | {"Prefer": "respond-async"})
        self.assertEqual((reply.status, len(Video(reply.body).blocks)), (200, 2))
        self.assertNotIn("Preference-Applied", reply.headers)
        job = self.server.ask("POST", path, body, self.headers("*/*") | {"Prefer": "respond-async"}).json()
        self.assert_problem(self.server.get(job["result"], Accept="video/webm"), 406)
        events = self.server.get(job["result"], Accept="text/event-stream").body.decode()
        self.assertIn('"framesPerSecond":20', events)


class Refused(SequenceTest):
    def test_frames_of_several_sizes(self):
        request = {"spec": SPEC, "frames": [{}, {"exposure": 1}, {"height": 50}]}
        self.assertEqual(self.sequence(request).status, 200)
        self.assert_problem(self.sequence(request, "video/webm"), 400, "/frames/2/height")

    def test_values_out_of_range(self):
        for field, value in (("framesPerSecond", 0), ("framesPerSecond", 240.5), ("videoQuality", 0), ("videoQuality", 101),
                             ("videoQuality", 7.5)):
            with self.subTest(field, value=value):
                self.assert_problem(self.sequence({"frames": [{}], field: value}, "video/webm"), 400, "/" + field)

    def test_a_first_frame_that_can_not_be_drawn_has_its_status(self):
        request = {"spec": SPEC, "frames": [{"camera": {"node": "nobody", "eye": None, "target": None}}]}
        self.assert_problem(self.sequence(request, "video/webm"), 400, "/frames/0/camera/node")

    def test_a_problem_in_the_middle_is_the_tag_at_the_end(self):
        request = {"spec": SPEC, "frames": [{}, {}, {"camera": {"node": "nobody", "eye": None, "target": None}}, {}]}
        video = Video(self.sequence(request, "video/webm").body)
        self.assertEqual(len(video.blocks), 2)
        self.assertAlmostEqual(video.duration, 4 / 30, places=5)
        self.assertEqual(list(video.tags), ["GNOMON_PROBLEM"])
        self.assertEqual(video.tags["GNOMON_PROBLEM"]["problems"][0]["pointer"], "/frames/2/camera/node")

    def test_pictures_that_choose_another_size_end_it(self):
        fewer = {"lights": [{"type": "directional", "direction": [-1, -1.5, -0.5], "shadow": {"cascadeCount": 1}}]}
        request = {"spec": SPEC | {"views": ["atlas"]}, "frames": [{}, fewer]}
        request["spec"] |= {"lights": [{"type": "directional", "direction": [-1, -1.5, -0.5]}]}
        video = Video(self.sequence(request, "video/webm").body)
        self.assertEqual(len(video.blocks), 1, video.size)
        problem = video.tags["GNOMON_PROBLEM"]["problems"][0]
        self.assertEqual(problem["limit"], "{}x{}".format(*video.size))
        self.assertNotEqual(problem["actual"], problem["limit"])


class LittleMemory(SequenceTest):
    flags = ("--video-memory-bytes", "50MB", "--max-sequences", "3")

    def test_a_video_has_room_or_is_refused(self):
        wide = {"spec": SPEC | {"width": 1280, "height": 720}, "frames": [{}]}
        self.assert_problem(self.sequence(wide, "video/webm"), 413, "/spec/width")
        self.assertEqual(self.sequence(wide).status, 200)
        long = {"spec": SPEC | {"width": 320, "height": 240}, "frames": [{"exposure": i / 500} for i in range(2000)]}
        with self.begin(long, "video/webm") as connection:
            self.assertTrue(connection.recv(1))
            refused = self.sequence({"spec": SPEC, "frames": [{}]}, "video/webm")
            self.assert_problem(refused, 429)
            self.assertGreaterEqual(int(refused.headers["Retry-After"]), 1)
            self.assertEqual(self.sequence({"spec": SPEC, "frames": [{}]}).status, 200)
        end = time.monotonic() + 30 * SLOW
        while self.sequence({"spec": SPEC, "frames": [{}]}, "video/webm").status == 429:  # until it has noticed
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)


if __name__ == "__main__":
    unittest.main()

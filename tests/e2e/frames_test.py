"""Frames over HTTP: every form, caching by tag, timing, the one-shot call."""

import base64
import email
import json
import unittest
from concurrent.futures import ThreadPoolExecutor

from shipped_server import EXR_MAGIC, SCENES, SMALL, ServerTest, form, png_size

STAGES = ["queue", "load", "upload", "survey", "plan", "shadow", "shade", "readback", "encode"]


class Frames(ServerTest):
    flags = ("--reply-cache-bytes", "0", "--workers", "1")  # so that every frame is drawn, by one that knows the last

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def frame(self, spec=SMALL, accept="*/*", **headers):
        return self.server.frame(self.scene, spec, accept, **headers)

    def test_a_png_is_the_first_view(self):
        reply = self.frame(SMALL | {"views": ["depth", "color"]}, "image/png")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"))
        self.assertEqual(png_size(reply.body), (64, 48))
        self.assertEqual(reply.body, self.frame(SMALL | {"views": ["depth"]}, "image/png").body)

    def test_an_exr_holds_every_view(self):
        one = self.frame(SMALL, "image/x-exr")
        two = self.frame(SMALL | {"views": ["color", "depth"]}, "image/x-exr")
        for reply in (one, two):
            self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/x-exr"))
            self.assertEqual(reply.body[:4], EXR_MAGIC)
        self.assertIn(b"depth", two.body)
        self.assertNotIn(b"depth", one.body)

    def test_the_spec_decides_where_accept_does_not(self):
        exr = SMALL | {"output": {"format": "exr"}}
        self.assertEqual(self.frame(exr).body[:4], EXR_MAGIC)
        self.assertEqual(png_size(self.frame(exr, "image/png").body), (64, 48))
        self.assertEqual(png_size(self.frame(SMALL, "text/html, image/*;q=0.9").body), (64, 48))

    def test_json_holds_the_report_and_the_same_pictures(self):
        reply = self.frame(SMALL | {"views": ["color", "shadow"]}, "application/json")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "application/json"))
        frame = reply.json()
        self.assertEqual([image["view"] for image in frame["images"]], ["color", "shadow"])
        self.assertEqual({image["contentType"] for image in frame["images"]}, {"image/png"})
        color = base64.b64decode(frame["images"][0]["data"], validate=True)
        self.assertEqual(color, self.frame(SMALL, "image/png").body)
        self.assertEqual(list(frame["report"]["stages"]), STAGES)
        self.assertEqual(frame["report"]["spec"]["output"]["format"], "png")

    def test_a_target_is_met_and_its_choice_is_kept(self):
        spec = SMALL | {"quality": {"maxError": 0.0}}
        reply = self.frame(spec, "application/json")
        self.assertEqual(reply.status, 200)
        self.assertEqual(reply.headers["Cache-Control"], "no-store")
        self.assertNotIn("ETag", reply.headers)
        report = reply.json()["report"]
        quality = report["quality"]
        chosen = quality["tried"][quality["chosen"]]
        self.assertTrue(quality["met"])
        self.assertFalse(quality["cached"])
        self.assertEqual(chosen["error"], 0)
        self.assertGreaterEqual(len(quality["tried"]), 7)
        self.assertEqual(report["spec"]["shadow"]["technique"], chosen["shadow"]["technique"])
        self.assertNotIn("quality", report["spec"])
        again = self.frame(spec, "application/json").json()["report"]["quality"]
        self.assertTrue(again["cached"])
        self.assertTrue(again["met"])
        self.assertEqual(again["tried"], quality["tried"])
        near = spec | {"camera": {"orbit": {"azimuthDegrees": 210.01}}}
        self.frame(spec | {"camera": {"orbit": {}}}, "application/json")
        other = self.frame(near, "application/json").json()["report"]["quality"]
        self.assertTrue(other["cached"])
        self.assertNotIn("met", other, "this view was not measured")

    def test_a_target_that_nothing_reaches_says_so(self):
        reply = self.frame(SMALL | {"quality": {"maxMilliseconds": 0.001}}, "application/json")
        quality = reply.json()["report"]["quality"]
        self.assertFalse(quality["met"])
        times = [trial["milliseconds"] for trial in quality["tried"]]
        self.assertEqual(times[quality["chosen"]], min(times))

    def test_a_plan_has_no_target(self):
        reply = self.server.ask("POST", f"/v1/scenes/{self.scene}/plan", json.dumps({"quality": {"maxError": 0.1}}),
                                {"Content-Type": "application/json"})
        self.assertEqual(reply.status, 400)
        self.assertEqual(reply.json()["problems"][0]["pointer"], "/quality")

    def test_the_effective_spec_gives_the_same_picture(self):
        first = self.frame(SMALL, "application/json").json()
        again = self.frame(first["report"]["spec"], "application/json").json()
        self.assertEqual(again["images"], first["images"])
        self.assertEqual(again["report"]["spec"], first["report"]["spec"])

    def test_multipart_holds_the_report_and_every_view(self):
        reply = self.frame(SMALL | {"views": ["color", "cascades"]}, "multipart/mixed")
        self.assertEqual(reply.status, 200)
        message = email.message_from_bytes(
            b"Content-Type: " + reply.headers["Content-Type"].encode() + b"\r\n\r\n" + reply.body
        )
        parts = message.get_payload()
        self.assertEqual([part.get_filename() for part in parts], ["report.json", "color.png", "cascades.png"])
        self.assertEqual(json.loads(parts[0].get_payload())["spec"]["views"], ["color", "cascades"])
        boundary = b"--" + message.get_boundary().encode()
        color = reply.body.split(boundary)[2].split(b"\r\n\r\n", 1)[1].removesuffix(b"\r\n")
        self.assertEqual(color, self.frame(SMALL, "image/png").body)

    def test_multipart_of_an_exr_holds_one_file(self):
        reply = self.frame(SMALL | {"views": ["color", "depth"], "output": {"format": "exr"}}, "multipart/mixed")
        self.assertEqual(reply.body.count(b"Content-Disposition"), 2)
        self.assertIn(b'filename="frame.exr"', reply.body)

    def test_what_nobody_can_give_is_refused(self):
        self.assert_problem(self.frame(SMALL, "image/avif, text/html"), 406)
        self.assert_problem(self.frame(SMALL, "*/*;q=0"), 406)

    def test_the_query_string_gives_the_same_frame(self):
        path = f"/v1/scenes/{self.scene}/frame"
        reply = self.server.get(f"{path}?width=64&height=48&camera.orbit.azimuthDegrees=30&sun=135,40&view=color")
        spec = SMALL | {
            "camera": {"orbit": {"azimuthDegrees": 30}},
            "lights": [{"type": "directional", "sun": {"azimuthDegrees": 135, "elevationDegrees": 40}}],
        }
        self.assertEqual((reply.status, reply.body), (200, self.frame(spec).body))
        self.assertIn("public", reply.headers["Cache-Control"])
        self.assertEqual(reply.headers["Vary"], "Accept")
        self.assertEqual(self.server.get(f"{path}?width=64&height=48&format=exr").body[:4], EXR_MAGIC)
        self.assert_problem(self.server.get(f"{path}?width=64&widht=64"), 400, "widht")

    def test_a_query_reaches_into_lists(self):
        spec = {"width": 64, "height": 48, "lights": [{"sun": {"azimuthDegrees": 58, "elevationDegrees": 22}, "intensity": 2},
                                                      {"type": "point", "position": [0, 3, 0]}]}  # fmt: skip
        query = "lights%5B1%5D.position=%5B0%2C3%2C0%5D&lights[0].intensity=2&lights[1].type=point&sun=58,22&width=64&height=48"
        reply = self.server.get(f"/v1/scenes/{self.scene}/frame?{query}", Accept="image/png")
        self.assertEqual(reply.body, self.server.frame(self.scene, spec, "image/png").body)
        refused = self.server.get(f"/v1/scenes/{self.scene}/frame?lights[1].type=point")
        self.assert_problem(refused, 400, "lights[1].type")

    def test_a_camera_is_named_or_numbered(self):
        scene = self.server.upload("cameras")
        cameras = self.server.get(f"/v1/scenes/{scene}").json()["cameras"]
        for index, camera in enumerate(cameras):
            frames = [self.server.frame(scene, {"width": 64, "height": 48, "camera": {"node": asked}}, "image/png")
                      for asked in (camera["name"], index, str(index), f"node:{camera['node']}")]  # fmt: skip
            self.assertEqual([frame.status for frame in frames], [200] * 4)
            self.assertEqual(len({frame.body for frame in frames}), 1, camera)
            query = f"/v1/scenes/{scene}/frame?camera.node={index}&width=64&height=48"
            self.assertEqual(self.server.get(query, Accept="image/png").body, frames[0].body)
        refused = self.server.frame(scene, {"camera": {"node": len(cameras)}}, "image/png")
        self.assert_problem(refused, 400, "/camera/node")

    def test_a_known_frame_is_not_drawn_again(self):
        path = f"/v1/scenes/{self.scene}/frame?width=64&height=48"
        tag = self.server.get(path).headers["ETag"]
        self.assertRegex(tag, '^"[0-9a-f]{64}"$')
        for condition in (tag, f'"other", W/{tag}', "*"):
            reply = self.server.get(path, If_None_Match=condition)
            self.assertEqual((reply.status, reply.body, reply.headers["ETag"]), (304, b"", tag))
            self.assertNotIn("Server-Timing", reply.headers)
        self.assertEqual(self.server.get(path, If_None_Match='"other"').status, 200)
        self.assertEqual(self.frame(SMALL, If_None_Match=tag).status, 304)

    def test_tags_tell_forms_and_specs_apart(self):
        accepts = ("image/png", "image/x-exr", "application/json", "multipart/mixed")
        tags = {self.frame(SMALL, accept).headers["ETag"] for accept in accepts}
        tags.add(self.frame(SMALL | {"exposure": 1}).headers["ETag"])
        self.assertEqual(len(tags), 5)

    def test_head_tells_the_tag_and_draws_nothing(self):
        path = f"/v1/scenes/{self.scene}/frame?width=64&height=48"
        reply = self.server.ask("HEAD", path)
        self.assertEqual((reply.status, reply.body), (200, b""))
        self.assertEqual(reply.headers["ETag"], self.server.get(path).headers["ETag"])
        self.assertNotIn("Server-Timing", reply.headers)

    def test_every_stage_is_timed(self):
        reply = self.frame()
        stages = [entry.split(";dur=") for entry in reply.headers["Server-Timing"].split(", ")]
        self.assertEqual([name for name, _ in stages], STAGES)
        self.assertTrue(all(float(time) >= 0 for _, time in stages))
        self.assertEqual(reply.headers["Timing-Allow-Origin"], "*")

    def test_no_body_means_every_default(self):
        spec = self.server.ask("POST", f"/v1/scenes/{self.scene}/frames", headers={"Accept": "application/json"})
        self.assertEqual(spec.status, 200)
        self.assertEqual(spec.json()["report"]["spec"]["width"], 1280)

    def test_the_same_request_gives_the_same_bytes_under_load(self):
        with ThreadPoolExecutor(8) as pool:
            bodies = set(pool.map(lambda _: self.frame().body, range(16)))
        self.assertEqual(len(bodies), 1)

    def test_one_shot(self):
        glb = (SCENES / "box_on_plane.glb").read_bytes()
        body, content_type = form([("scene", "a.glb", glb), ("spec", None, json.dumps(SMALL).encode())])
        reply = self.server.ask("POST", "/v1/render", body, {"Content-Type": content_type})
        self.assertEqual((reply.status, reply.body), (200, self.frame().body))
        self.assertEqual(reply.headers["ETag"], self.frame().headers["ETag"])

    def test_one_shot_is_as_strict(self):
        glb = (SCENES / "box_on_plane.glb").read_bytes()
        scene = ("scene", "a.glb", glb)
        for parts, status, pointer in (
            ([scene, ("spec", None, b'{"width": 0}')], 400, "/width"),
            ([scene, ("spec", None, b"{")], 400, None),
            ([scene, ("spec", None, b"{}"), ("spec", None, b"{}")], 400, "spec"),
            ([scene, scene], 400, "scene"),
            ([("spec", None, b"{}")], 400, "scene"),
            ([("scene", "a.glb", b"not a model")], 400, None),
        ):
            body, content_type = form(parts)
            reply = self.server.ask("POST", "/v1/render", body, {"Content-Type": content_type})
            self.assert_problem(reply, status, pointer)

    def test_a_volume_of_the_upload_is_seen_and_its_light_is_kept(self):
        cloud = {"volumes": [{"file": "cloud.npy", "box": {"min": [-3, 2, -3], "max": [3, 5, 3]},
                              "transferFunction": [{"value": 0}, {"value": 255, "extinction": 5}]}]}
        glb = (SCENES / "box_on_plane.glb").read_bytes()
        body, content_type = form([("scene", "a.glb", glb),
                                   ("file", "cloud.npy", (SCENES / "cloud.npy").read_bytes())])
        stored = self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})
        self.assertEqual(stored.status, 201)
        self.assertEqual(stored.json()["volumeFiles"], ["cloud.npy"])
        frames = [self.server.ask("POST", f"/v1/scenes/{stored.json()['id']}/frames", json.dumps(SMALL | cloud),
                                  {"Content-Type": "application/json", "Accept": "application/json"})
                  for _ in range(2)]
        self.assertEqual([frame.json()["report"]["volumes"][0]["reused"] for frame in frames], [False, True])
        self.assertIn("volume", frames[0].json()["report"]["stages"])
        self.assertEqual(self.frame(SMALL | cloud).status, 400, "another upload, without the file")

    def test_a_camera_that_is_none_is_told(self):
        reply = self.frame(SMALL | {"camera": {"node": "no such camera"}})
        self.assert_problem(reply, reply.status, "/camera/node")
        self.assertIn(reply.status, (400, 404, 422))


class FullQueue(ServerTest):
    flags = ("--queue-limit", "1")

    def test_the_queue_is_bounded_and_says_when_to_come_again(self):
        scene = self.server.upload("box_on_plane")
        spec = {"width": 640, "height": 480}
        with ThreadPoolExecutor(24) as pool:
            replies = list(pool.map(lambda i: self.server.frame(scene, spec | {"exposure": i / 100}), range(24)))
        statuses = {reply.status for reply in replies}
        self.assertEqual(statuses, {200, 429})
        for reply in replies:
            if reply.status == 429:
                self.assert_problem(reply, 429)
                self.assertGreaterEqual(int(reply.headers["Retry-After"]), 1)
        self.assertEqual(self.server.frame(scene, spec).status, 200)


class LittleMemory(ServerTest):
    flags = ("--workers", "1", "--frame-memory-bytes", "40MB")

    def test_a_frame_that_does_not_fit_is_refused_before_it_is_drawn(self):
        scene = self.server.upload("box_on_plane")
        self.assert_problem(self.server.frame(scene, {"width": 1280, "height": 720}), 413, "/views")
        self.assertEqual(self.server.frame(scene, SMALL).status, 200)


class EqualFrames(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def test_an_equal_request_is_answered_from_memory(self):
        first = self.server.frame(self.scene, SMALL)
        again = self.server.frame(self.scene, SMALL)
        self.assertEqual((again.status, again.body), (200, first.body))
        self.assertEqual(again.headers["Cache-Status"], "gnomon; hit")
        self.assertEqual(again.headers["ETag"], first.headers["ETag"])
        self.assertNotIn("Cache-Status", first.headers)
        for other in (SMALL | {"exposure": 1}, SMALL | {"output": {"format": "exr"}}):
            self.assertNotIn("Cache-Status", self.server.frame(self.scene, other).headers)
        report = self.server.frame(self.scene, SMALL, "application/json")
        self.assertNotIn("Cache-Status", report.headers, "it tells times")

    def test_a_deleted_scene_is_not_answered_from_memory(self):
        scene = self.server.upload("multi_scene")
        self.assertEqual(self.server.frame(scene, SMALL).status, 200)
        self.server.ask("DELETE", f"/v1/scenes/{scene}")
        self.assertEqual(self.server.frame(scene, SMALL).status, 404)

    def test_equal_frames_at_once_are_drawn_once(self):
        shadow = {"technique": "rayTraced", "raySamples": 64}
        spec = {"width": 1280, "height": 720, "shadow": shadow, "lights": [{"sun": {"azimuthDegrees": 10, "elevationDegrees": 45}, "angularDiameterDegrees": 30}]}
        with ThreadPoolExecutor(8) as pool:
            replies = list(pool.map(lambda _: self.server.frame(self.scene, spec), range(8)))
        self.assertEqual({reply.status for reply in replies}, {200})
        self.assertEqual(len({reply.body for reply in replies}), 1)
        drawn = {reply.headers["Server-Timing"] for reply in replies if "Server-Timing" in reply.headers}
        self.assertEqual(len(drawn), 1, "all have the times of the one that was drawn, or come from memory")


if __name__ == "__main__":
    unittest.main()

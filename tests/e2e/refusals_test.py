"""What HEAD allows, GET draws: every way to ask for a frame refuses the same, with the same problems."""

import json
import struct
import time
import unittest
from urllib.parse import urlencode

from shipped_server import SCENES, SMALL, TIMEOUT, ServerTest

JSON = {"Content-Type": "application/json"}
CLOUD = {"file": "none.npy", "box": {"min": [-1, 0, -1], "max": [1, 1, 1]}, "transferFunction": [{"value": 0}]}
BEYOND_ALL = {  # wrong in several places at once
    "camera": {"node": "nobody"},
    "nodes": [{"node": "nobody", "visible": False}],
    "debug": {"light": 9},
    "views": ["motion"],
    "motionFrom": {"animation": {"index": 3}},
    "volumes": [CLOUD],
}
REFUSALS = [  # a spec, and the pointers of its problems
    ({"scene": 7}, ["/scene"]),
    ({"materialVariant": "none"}, ["/materialVariant"]),
    ({"camera": {"node": "nobody"}}, ["/camera/node"]),
    ({"nodes": [{"node": "nobody", "visible": False}]}, ["/nodes/0/node"]),
    ({"animation": {"index": 3}}, ["/animation/index"]),
    ({"views": ["motion"], "motionFrom": {"animation": {"index": 3}}}, ["/motionFrom/animation/index"]),
    ({"views": ["motion"], "motionFrom": {"camera": {"node": "nobody"}}}, ["/motionFrom/camera/node"]),
    ({"shadow": {"technique": "lightMap"}, "animation": {"index": 0, "timeSeconds": 1}}, ["/shadow/technique"]),
    ({"debug": {"light": 9}}, ["/debug/light"]),
    ({"views": ["tile"], "shadow": {"cascadeCount": 1}, "debug": {"tile": 3}}, ["/debug/tile"]),
    ({"views": ["atlas"], "shadow": {"enabled": False}}, ["/views"]),
    ({"volumes": [CLOUD]}, ["/volumes/0/file"]),
    (BEYOND_ALL, ["/nodes/0/node", "/camera/node", "/debug/light", "/motionFrom/animation/index", "/volumes/0/file"]),
]


def moving_box():
    """box_on_plane with an animation that moves its box."""
    glb = (SCENES / "box_on_plane.glb").read_bytes()
    length = struct.unpack_from("<I", glb, 12)[0]
    model, binary = json.loads(glb[20 : 20 + length]), glb[28 + length :]
    keys = struct.pack("<2f6f", 0, 1, 0, 0, 0, 1, 0, 0)
    views, accessors = model["bufferViews"], model["accessors"]
    for start, size, form, more in ((0, 8, "SCALAR", {"min": [0], "max": [1]}), (8, 24, "VEC3", {})):
        views.append({"buffer": 0, "byteOffset": len(binary) + start, "byteLength": size})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": form} | more)
    box = next(index for index, node in enumerate(model["nodes"]) if node.get("name") == "box")
    sampler = {"input": len(accessors) - 2, "output": len(accessors) - 1}
    model["animations"] = [{"samplers": [sampler],
                            "channels": [{"sampler": 0, "target": {"node": box, "path": "translation"}}]}]
    binary += keys
    model["buffers"][0]["byteLength"] = len(binary)
    text = json.dumps(model).encode()
    text += b" " * (-len(text) % 4)
    size = 28 + len(text) + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


class Refusing(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        stored = cls.server.ask("POST", "/v1/scenes", moving_box(), {"Content-Type": "model/gltf-binary"})
        assert stored.status == 201, stored.body
        cls.scene = stored.json()["id"]

    def post(self, route, spec):
        return self.server.ask("POST", f"/v1/scenes/{self.scene}/{route}", json.dumps(spec), JSON)

    def job(self, spec):
        """A job of one frame, once it has ended."""
        headers = JSON | {"Prefer": "respond-async"}
        reply = self.server.ask("POST", f"/v1/scenes/{self.scene}/sequences", json.dumps({"spec": spec, "frames": [{}]}),
                                headers)
        self.assertEqual(reply.status, 202, reply.body)
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            job = self.server.get(reply.headers["Location"] + "?wait=5").json()
            if job["state"] not in ("queued", "running"):
                return job
        raise AssertionError("the job does not end")

    def replies(self, spec):
        """(HEAD, GET, POST frames, POST plan)"""
        path = f"/v1/scenes/{self.scene}/frame?" + urlencode({key: json.dumps(value) for key, value in spec.items()})
        return (self.server.ask("HEAD", path), self.server.get(path), self.post("frames", spec),
                self.post("plan", spec))

    def assert_refused(self, spec, pointers):
        with self.subTest(spec=spec):
            head, *others = self.replies(spec)
            self.assertEqual([reply.status for reply in others], [head.status] * 3)
            first, *more = (reply.json()["problems"] for reply in others)
            self.assertEqual([problem["pointer"] for problem in first], pointers)
            for problems in more:
                self.assertEqual(problems, first)

    def assert_drawn(self, spec):
        with self.subTest(spec=spec):
            self.assertEqual([reply.status for reply in self.replies(spec)], [200] * 4)


class Refusals(Refusing):
    def test_every_way_to_a_frame_refuses_the_same(self):
        for spec, pointers in REFUSALS:
            self.assert_refused(SMALL | spec, pointers)

    def test_what_is_allowed_is_drawn(self):
        self.assert_drawn(SMALL)
        self.assert_drawn(SMALL | {"views": ["motion"], "motionFrom": {"animation": {"index": 0, "timeSeconds": 1}}})
        self.assert_drawn(SMALL | {"shadow": {"technique": "lightMap", "lightMap": {"size": 64}}})

    def test_sequences_and_bakes_refuse_it_too(self):
        pose = {"animation": {"index": 0, "timeSeconds": 1}}
        baked = SMALL | pose | {"shadow": {"technique": "lightMap"}}
        frame = self.post("frames", baked).json()["problems"]
        self.assertEqual(self.post("bakes", baked).json()["problems"], frame)
        report = self.post("evaluations", {"spec": SMALL, "variants": [pose | {"shadow": baked["shadow"]}]}).json()
        self.assertEqual(report["rows"][0]["problems"], frame)
        sequence = self.post("sequences", {"spec": SMALL | BEYOND_ALL, "frames": [{}]})
        self.assertEqual(sequence.pointers(), ["/frames/0" + pointer for pointer in REFUSALS[-1][1]])

    def test_a_target_is_no_reason_for_head_to_refuse(self):
        path = f"/v1/scenes/{self.scene}/frame?width=64&height=48&quality.maxError=1"
        self.assertEqual(self.server.ask("HEAD", path).status, 200)


VOLUMES = SMALL | {"shadow": {"technique": "shadowVolume"}}


class WithOpenGl(Refusing):
    flags = ("--device", "gl", "--workers", "1")

    def test_what_only_opengl_draws_is_drawn(self):
        self.assert_drawn(SMALL | {"device": "gl"})
        self.assert_drawn(VOLUMES)
        self.assertEqual(self.job(VOLUMES)["state"], "done")

    def test_the_processor_is_refused(self):
        self.assert_refused(SMALL | {"device": "cpu"}, ["/device"])


class WithoutOpenGl(Refusing):
    flags = ("--device", "cpu", "--workers", "1")

    def test_what_only_opengl_draws_is_refused(self):
        self.assert_refused(SMALL | {"device": "gl"}, ["/device"])
        self.assert_refused(VOLUMES | {"debug": {"light": 9}}, ["/debug/light", "/shadow/technique"])

    def test_the_refusal_names_the_technique_the_device_and_a_way_out(self):
        (problem,) = self.post("frames", VOLUMES).json()["problems"]
        for word in ("shadowVolume", "device cpu", "--device gl", "rayTraced"):
            self.assertIn(word, problem["detail"])
        ended = self.job(VOLUMES)
        self.assertEqual(ended["state"], "failed")
        self.assertEqual([(each["pointer"], each["detail"]) for each in ended["problems"]],
                         [("/frames/0/shadow/technique", problem["detail"])])


class LittleMemory(Refusing):
    flags = ("--frame-memory-bytes", "1MB")

    def test_pictures_that_never_fit_are_refused(self):
        self.assert_refused({"width": 1280, "height": 720}, ["/views"])


class LittleTime(Refusing):
    flags = ("--request-timeout", "1")

    def test_more_work_than_a_request_may_be_is_refused_before(self):
        spec = {"width": 8192, "height": 4096, "views": ["color", "error"], "shadow": {"technique": "rayTraced"}}
        head, get, *_ = self.replies(spec)
        self.assertEqual((head.status, get.status), (413, 413))


if __name__ == "__main__":
    unittest.main()

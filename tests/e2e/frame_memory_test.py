"""What a frame is said to take is what it takes, in memory and time; where there is little of either, each frame is a
picture or a refusal that says why."""

import functools
import itertools
import json
import os
import struct
import sys
import threading
import unittest
from pathlib import Path

import shipped_server
from environments import hdr
from shipped_server import SCENES, Server, form, workers_of

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "soak"))
from memory_group import MemoryGroup  # noqa: E402

MB = 1 << 20
SUN = {"sun": {"azimuthDegrees": 30, "elevationDegrees": 40}}
FULL = {"width": 1920, "height": 1080}
LARGE = {"width": 3840, "height": 2160}
SANITIZED = shipped_server.SLOW > 1  # which keeps what was freed


def volume(index):
    """A volume over the scene, each a little beside the others."""
    return {
        "file": f"v{index}.npy",
        "box": {"min": [-8 + index, 0, -8], "max": [6 + index, 4, 8]},
        "transferFunction": [{"value": 0, "extinction": 0}, {"value": 1, "extinction": 0.1}],
    }


def cloud(side, index):
    """A NumPy file of floats."""
    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({side}, {side}, {side}), }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    numbers = struct.pack("<16f", *[((index + i) % 7) / 7 for i in range(16)]) * (side**3 // 16)
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + numbers


@functools.cache
def picture(name, height):
    """A picture of all directions, as the format that its name ends with."""
    if name.endswith(".hdr"):
        return hdr((200, 180, 160, 129), (90, 80, 70, 128), height)
    spec = {"width": 2 * height, "height": height, "antialiasing": "none", "lights": [SUN], "shadow": {"enabled": False}}
    with Server("--device", "cpu") as server:
        reply = server.frame(upload(server), spec | {"output": {"format": "exr", "exrPixelType": "float"}}, "*/*")
        assert reply.status == 200, reply.body[:300]
        return reply.body


def upload(server, scene="box_on_plane", volumes=0, side=64, around=None):
    """`around`: name and height of a picture of all directions."""
    parts = [("scene", "scene.glb", (SCENES / f"{scene}.glb").read_bytes())]
    if around:
        parts.append(("file", around[0], picture(*around)))
    parts += [("file", f"v{index}.npy", cloud(side, index)) for index in range(volumes)]
    body, content_type = form(parts)
    reply = server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})
    assert reply.status in (200, 201), reply.body
    return reply.json()["id"]


def memory_of(pid):
    """Bytes: resident now, and at most since that was last reset."""
    lines = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    return [int(lines[name].split()[0]) * 1024 for name in ("VmRSS", "VmHWM")]


def lit(count, **shadow):
    """Lights of their own directions."""
    lights = [
        {"sun": {"azimuthDegrees": 30 + 50 * index, "elevationDegrees": 40}, "angularDiameterDegrees": 2}
        for index in range(count)
    ]
    return {"lights": lights, "shadow": shadow}


PLAIN = {"antialiasing": "none"}
SMOOTH = {"antialiasing": "msaa4x"}
CASES = [
    (FULL | PLAIN, "*/*"),
    (FULL | SMOOTH, "*/*"),
    (LARGE | PLAIN, "*/*"),
    (LARGE | SMOOTH, "*/*"),
    (FULL | PLAIN | {"output": {"format": "png", "pngBits": 16}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "exr"}}, "*/*"),
    (FULL | SMOOTH | {"output": {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "npy", "arrayColors": "linear"}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "npy"}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "npz"}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "tiff"}}, "*/*"),
    (FULL | SMOOTH | {"output": {"format": "jpeg"}}, "*/*"),
    (FULL | PLAIN | {"output": {"format": "webp"}}, "*/*"),
    (FULL | SMOOTH | {"views": ["color", "depth", "normal", "shadow"]}, "multipart/mixed"),
    (FULL | SMOOTH | {"views": ["error"]}, "*/*"),
    (FULL | PLAIN | {"views": ["color", "position"]}, "multipart/mixed"),
    (FULL | SMOOTH | {"views": ["casterIds"]}, "*/*"),
    (FULL | SMOOTH | lit(4, technique="rayTraced", raySamples=1), "*/*"),
    (FULL | SMOOTH | lit(4, technique="shadowMap"), "*/*"),
    (FULL | PLAIN | lit(1, technique="shadowMap", filter={"type": "evsm"}), "*/*"),
    (FULL | PLAIN | lit(1, technique="shadowMap", size="XLarge") | {"atlas": {"size": 4096, "baseSize": 2048}}, "*/*"),
    (FULL | PLAIN | {"lights": [SUN], "volumes": [volume(0), volume(1)]}, "*/*"),
    (FULL | SMOOTH | {"lights": [SUN], "volumes": [volume(0)]}, "*/*"),
]
SMALL = {"width": 640, "height": 360}
SKY = {"sky": {"sun": {"azimuthDegrees": 30, "elevationDegrees": 40}}}
AROUND = [
    (SMALL | PLAIN | {"environment": {"file": "around.hdr"}}, ("around.hdr", 2048)),
    (SMALL | PLAIN | {"environment": {"file": "around.exr", "shadows": "rays"}}, ("around.exr", 2048)),
    (SMALL | PLAIN | {"environment": {"file": "around.hdr", "background": "environment"}}, ("around.hdr", 512)),
    (FULL | PLAIN | {"environment": SKY | {"shadows": "rays"}}, None),
    (FULL | SMOOTH | {"environment": {"shadows": "rays"}}, None),
]


class Estimates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if SANITIZED:
            raise unittest.SkipTest("a sanitizer's memory is not the server's")

    def estimate(self, server, scene, spec, accept):
        reply = server.frame(scene, spec, accept)
        self.assertEqual(reply.status, 413, reply.body[:300])
        return int(reply.json()["problems"][0]["actual"].split()[0])

    def peak(self, spec, accept, **files):
        """What a worker that has drawn nothing but a small frame takes beside for this one."""
        with Server("--device", "cpu", "--workers", "1", "--tile-cache-bytes", "0", "--request-timeout", "300") as server:
            scene = upload(server, "city", **files)
            small = {name: value for name, value in spec.items() if name not in ("volumes", "atlas", "environment")}
            self.assertEqual(server.frame(scene, small | {"width": 64, "height": 36}, accept).status, 200)
            worker = max(workers_of(server), key=lambda pid: memory_of(pid)[0])
            try:
                Path(f"/proc/{worker}/clear_refs").write_text("5")
            except OSError:
                self.skipTest("the system does not let the highest memory be reset")
            before = memory_of(worker)[0]
            reply = server.frame(scene, spec, accept)
            self.assertEqual(reply.status, 200, reply.body[:300])
            return memory_of(worker)[1] - before

    def compare(self, estimate, peak, spec):
        if os.environ.get("GNOMON_SHOW"):
            print(f"{estimate / MB:8.1f} {peak / MB:8.1f} {estimate / peak:5.2f} {json.dumps(spec)[:150]}")
        self.assertGreaterEqual(estimate, peak)
        self.assertLessEqual(estimate, 2 * peak + 24 * MB)

    def test_a_frame_takes_at_most_what_is_said_and_at_least_half(self):  # F12
        with Server("--device", "cpu", "--workers", "1", "--frame-memory-bytes", "1MB") as said:
            scenes = {count: upload(said, "city", volumes=count) for count in (0, 1, 2)}
            for spec, accept in CASES:
                with self.subTest(spec=spec, accept=accept):
                    volumes = len(spec.get("volumes", []))
                    estimate = self.estimate(said, scenes[volumes], spec, accept)
                    self.compare(estimate, self.peak(spec, accept, volumes=volumes), spec)

    def test_an_environment_takes_at_most_what_is_said_and_at_least_half(self):  # F12
        with Server("--device", "cpu", "--workers", "1", "--frame-memory-bytes", "1MB") as said:
            for spec, around in AROUND:
                with self.subTest(spec=spec, around=around):
                    estimate = self.estimate(said, upload(said, "city", around=around), spec, "*/*")
                    self.compare(estimate, self.peak(spec, "*/*", around=around), spec)


SIZES = [(640, 360), (1920, 1080), (2048, 2048), (3900, 2193), (4500, 2531)]
FORMATS = [{"format": "png"}, {"format": "exr"}, {"format": "npz"}]


class MemoryGroups(unittest.TestCase):
    def check(self, limit):
        try:
            group = MemoryGroup(f"gnomon-test-{limit}", limit)
        except OSError as error:
            self.skipTest(f"no control group for memory can be made here: {error.strerror or error}")
        self.addCleanup(group.close)
        within = ("sh", "-c", 'echo $$ > "$0/cgroup.procs" && exec "$@"', str(group.folder))
        with Server("--device", "cpu", by=within) as server:
            self.draw_all(server)

    def draw_all(self, server):
        scene, cloudy = upload(server), upload(server, volumes=2, side=32)
        specs = [
            {"width": width, "height": height, "antialiasing": antialiasing, "output": output}
            for (width, height), antialiasing, output in itertools.product(SIZES, ("none", "msaa4x"), FORMATS)
        ]
        clouds = [spec | {"lights": [SUN], "volumes": [volume(0), volume(1)]} for spec in specs[:12:3]]
        calls = [(scene, spec) for spec in specs] + [(cloudy, spec) for spec in clouds]
        workers = workers_of(server)
        alone = {json.dumps(call): server.frame(*call) for call in calls}
        for call, reply in alone.items():
            self.assertIn(reply.status, (200, 413), f"{call} {reply.body[:500]}")
        self.assertEqual({alone[json.dumps((scene, spec))].status for spec in specs[:6]}, {200}, "small ones")
        self.assertIn(413, {reply.status for reply in alone.values()})
        beside = {}
        threads = []
        for index, (of, spec) in enumerate(calls):
            spec = spec | {"exposure": 0.5 + index / 100}  # or it would be the picture of before
            threads.append(threading.Thread(target=lambda c=(of, spec), i=index: beside.update({i: server.frame(*c)})))
        for first in range(0, len(threads), 12):
            for thread in threads[first : first + 12]:
                thread.start()
            for thread in threads[first : first + 12]:
                thread.join()
        for index, call in enumerate(calls):
            reply, before = beside[index], alone[json.dumps(call)]
            if reply.status in (429, 503):
                self.assertGreaterEqual(int(reply.headers["Retry-After"]), 1)
            else:
                self.assertEqual(reply.status, before.status, f"{call} {reply.body[:500]}")
        self.assertEqual(workers_of(server), workers, "a worker was replaced:\n" + server.log_text())

    def test_in_half_a_gigabyte_each_is_a_picture_or_a_refusal(self):  # F12
        self.check(512 * MB)

    def test_in_a_gigabyte_each_is_a_picture_or_a_refusal(self):  # F12
        self.check(1024 * MB)


class Time(unittest.TestCase):
    def test_a_frame_that_was_twice_not_done_is_refused(self):  # F11
        with Server("--device", "cpu", "--request-timeout", "1") as server:
            scene = upload(server)
            light = {"sun": {"azimuthDegrees": 10, "elevationDegrees": 45}, "angularDiameterDegrees": 60}
            for rays in range(8, 513, 8):
                spec = {"width": 1920, "height": 1080, "lights": [light] * 3}
                spec["shadow"] = {"technique": "rayTraced", "raySamples": rays}
                replies = []
                while len(replies) < 3 and {reply.status for reply in replies} <= {504}:
                    replies.append(server.frame(scene, spec | {"exposure": len(replies) / 10}))
                if [reply.status for reply in replies] == [504, 504, 413]:
                    return self.assertEqual(replies[2].json()["problems"][0]["actual"], "more than 1 seconds")
                self.assertIn(replies[-1].status, (200, 413), [reply.status for reply in replies])
                if replies[-1].status == 413:
                    self.assertIn("about", replies[-1].json()["problems"][0]["actual"])
                    self.skipTest("here an estimate refuses whatever takes longer")

    def test_more_volumes_than_a_request_has_time_for_are_refused_at_once(self):  # F11
        with Server("--device", "cpu", "--request-timeout", "5") as server:
            scene = upload(server, volumes=16)
            spec = {"width": 320, "height": 240, "lights": [SUN], "volumes": [volume(index) for index in range(16)]}
            reply = server.frame(scene, spec)
            self.assertIn(reply.status, (200, 413), reply.body[:500])
            if reply.status == 413:
                self.assertIn("seconds", reply.json()["problems"][0]["actual"])


if __name__ == "__main__":
    unittest.main()

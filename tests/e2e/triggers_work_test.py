"""Requests that once took everything from everyone: slow frames, slow loads, large pictures, scenes that come and go."""

import json
import signal
import struct
import subprocess
import tempfile
import threading
import time
import unittest
import zlib

from shipped_server import BINARY, SCENES, SLOW, SMALL, Server, form

GLB = (SCENES / "box_on_plane.glb").read_bytes()


def slow(lights=4, rays=256, width=1280, height=720):
    """A frame of seconds."""
    sun = {"sun": {"azimuthDegrees": 10, "elevationDegrees": 45}, "angularDiameterDegrees": 60}
    shadow = {"technique": "rayTraced", "raySamples": rays}
    lights = [sun | {"intensity": 1 + index} for index in range(lights)]
    return {"width": width, "height": height, "antialiasing": "none", "shadow": shadow, "lights": lights}


def textured(side, count, tag):
    """A scene whose flat pictures take 4 * side * side * count bytes: a few kilobytes of PNG."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    row = b"\0" + b"\x7f\x7f\x7f" * side
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", side, side, 8, 2, 0, 0, 0))
    png += chunk(b"IDAT", zlib.compress(row * side, 1)) + chunk(b"IEND", b"")
    png += bytes(-len(png) % 4)
    corners = struct.pack("<12f", -1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1)
    binary = corners + struct.pack("<8f", 0, 0, 0, 1, 1, 1, 1, 0) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    at = len(binary)
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}
    gltf = {
        "asset": {"version": "2.0", "extras": {"tag": tag}},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive | {"material": index} for index in range(count)]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}} for index in range(count)],
        "textures": [{"source": index} for index in range(count)],
        "images": [{"bufferView": 3 + index, "mimeType": "image/png"} for index in range(count)],
        "buffers": [{"byteLength": at + len(png) * count}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 32},
            {"buffer": 0, "byteOffset": 80, "byteLength": 12},
        ]
        + [{"buffer": 0, "byteOffset": at + index * len(png), "byteLength": len(png)} for index in range(count)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
    }
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    binary += png * count
    size = 28 + len(text) + len(binary)
    return (
        struct.pack("<4sII", b"glTF", 2, size)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(binary), b"BIN\0")
        + binary
    )


def upload(server, glb):
    reply = server.ask("POST", "/v1/scenes", glb, {"Content-Type": "model/gltf-binary"})
    assert reply.status in (200, 201), reply.body
    return reply.json()["id"]


def one_shot(server, glb, spec):
    body, content_type = form([("scene", "a.glb", glb), ("spec", None, json.dumps(spec).encode())])
    return server.ask("POST", "/v1/render", body, {"Content-Type": content_type})


class Beside:
    """A call on a thread of its own; its result once it is joined."""

    def __init__(self, call, *arguments, **named):
        self.result = None

        def run():
            self.result = call(*arguments, **named)

        self.thread = threading.Thread(target=run)
        self.thread.start()

    def join(self):
        self.thread.join()
        return self.result


class SlowFrames(unittest.TestCase):
    def test_a_slow_frame_takes_nothing_from_others_and_ends_in_time(self):  # T1
        with Server("--request-timeout", "5", "--workers", "2") as server:
            scene = server.upload("box_on_plane")
            server.frame(scene, SMALL)
            long = Beside(server.frame, scene, slow(rays=1024, lights=64, width=2560, height=1440))
            time.sleep(0.3)
            for exposure in range(5):
                begun = time.monotonic()
                self.assertEqual(server.frame(scene, SMALL | {"exposure": exposure}).status, 200)
                self.assertLess(time.monotonic() - begun, 2 * SLOW)
            self.assertIn(long.join().status, (413, 504))
            self.assertEqual(server.frame(scene, SMALL | {"exposure": 9}).status, 200)
            self.assertNotIn("did not stop", server.settled_log(), "the frame stopped, its worker lives")

    def test_what_can_never_be_done_in_time_is_told_with_the_numbers(self):  # T1
        with Server("--request-timeout", "1") as server:
            scene = server.upload("box_on_plane")
            begun = time.monotonic()
            reply = server.frame(scene, slow(lights=256, rays=1024, width=4096, height=2160))
            self.assertEqual(reply.status, 413, reply.body)
            self.assertLess(time.monotonic() - begun, 1 * SLOW)
            problem = reply.json()["problems"][0]
            self.assertIn("--request-timeout", problem["detail"])
            self.assertRegex(problem["actual"], r"about \d+ seconds")

    def test_retry_after_knows_what_is_being_drawn(self):  # T18
        with Server("--queue-limit", "1", "--workers", "1") as server:
            scene = server.upload("box_on_plane")
            held = [Beside(server.frame, scene, slow(rays=1024) | {"exposure": index}, Prefer="wait=8") for index in (1, 2, 3)]
            time.sleep(2.5)
            reply = server.frame(scene, slow() | {"exposure": 5})
            if reply.status == 429:  # unless the machine was fast enough
                self.assertGreaterEqual(int(reply.headers["Retry-After"]), 2)
            for each in held:
                each.join()

    def test_a_full_queue_is_no_reason_to_restart(self):  # T24
        with Server("--queue-limit", "1", "--workers", "1") as server:
            scene = server.upload("box_on_plane")
            held = [Beside(server.frame, scene, slow(rays=512) | {"exposure": index}, Prefer="wait=6") for index in range(3)]
            time.sleep(1)
            url = "http://{}:{}".format(*server.address)
            health = subprocess.run([BINARY, "health", "--live", "--url", url], stdout=subprocess.DEVNULL)
            self.assertEqual(health.returncode, 0)
            for each in held:
                each.join()

    def test_a_plan_does_not_wait_for_frames(self):  # T25
        with Server("--workers", "1") as server:
            scene = server.upload("box_on_plane")
            server.frame(scene, SMALL)
            long = Beside(server.frame, scene, slow(rays=512), Prefer="wait=5")
            time.sleep(0.3)
            begun = time.monotonic()
            reply = server.ask("POST", f"/v1/scenes/{scene}/plan", "{}", {"Content-Type": "application/json"})
            self.assertEqual(reply.status, 200)
            self.assertLess(time.monotonic() - begun, 2 * SLOW)
            long.join()


class Memory(unittest.TestCase):
    def test_the_listening_process_holds_no_pictures_or_scenes(self):  # T4, T5
        with Server("--scene-memory-bytes", "300MB", "--workers", "2") as server:
            scene = server.upload("box_on_plane")
            before = server.resident_bytes()
            exr = {"format": "exr", "exrPixelType": "float", "exrCompression": "none"}
            reply = server.frame(scene, {"width": 4096, "height": 2048, "output": exr}, "application/json")
            self.assertEqual(reply.status, 200)
            calls = [Beside(one_shot, server, textured(4096, 1, str(index)), SMALL) for index in range(12)]
            statuses = {call.join().status for call in calls}
            self.assertLessEqual(statuses, {200, 413, 429})
            self.assertLess(server.resident_bytes() - before, 100 << 20, "what passed through it is gone")

    def test_frames_that_wait_hold_no_memory(self):  # T17
        with Server("--frame-memory-bytes", "240MB", "--workers", "2") as server:
            scene = server.upload("box_on_plane")
            large = {"width": 1280, "height": 720, "output": {"format": "exr"}}
            waiting = [Beside(server.frame, scene, large | {"exposure": index / 10}) for index in range(12)]
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            self.assertEqual({call.join().status for call in waiting}, {200})

    def test_a_target_and_its_frame_do_not_want_the_same_memory_twice(self):  # T16
        with Server("--frame-memory-bytes", "60MB", "--workers", "1") as server:
            scene = server.upload("box_on_plane")
            spec = {"width": 640, "height": 360, "quality": {"maxError": 0.05}, "lights": [{"sun": {"azimuthDegrees": 10, "elevationDegrees": 45}}]}
            self.assertIn(server.frame(scene, spec).status, (200, 413))

    def test_a_slow_load_has_a_deadline(self):  # T8
        with Server("--request-timeout", "2", "--workers", "2") as server:
            loads = [Beside(server.ask, "POST", "/v1/scenes", textured(8192, 2, str(index)), {"Content-Type": "model/gltf-binary"}) for index in range(6)]
            time.sleep(0.2)
            begun = time.monotonic()
            reply = one_shot(server, GLB, SMALL)
            self.assertIn(reply.status, (200, 504), reply.body)
            self.assertLess(time.monotonic() - begun, 4 * SLOW)
            self.assertLessEqual({load.join().status for load in loads}, {201, 413, 429, 504})


class Scenes(unittest.TestCase):
    def test_what_was_taken_before_a_signal_is_finished(self):  # T19
        with Server() as server:
            call = Beside(one_shot, server, textured(4096, 2, "z"), SMALL)
            time.sleep(0.2)
            server.process.send_signal(signal.SIGTERM)
            self.assertEqual(call.join().status, 200)
            self.assertEqual(server.process.wait(60 * SLOW), 0)

    def test_a_deleted_scene_stays_deleted(self):  # T20
        with tempfile.TemporaryDirectory() as directory:
            with Server("--store", directory) as server:
                scene = upload(server, textured(4096, 2, "gone"))
            with Server("--store", directory) as server:
                call = Beside(server.frame, scene, SMALL)
                time.sleep(0.1)
                self.assertEqual(server.ask("DELETE", f"/v1/scenes/{scene}").status, 204)
                call.join()
                self.assertEqual(server.get(f"/v1/scenes/{scene}").status, 404)
                self.assertEqual(server.frame(scene, SMALL).status, 404)

    def test_one_shots_are_not_stored_nor_listed(self):  # T21
        with tempfile.TemporaryDirectory() as directory:
            for flags in (("--store", directory), ()):
                with Server(*flags) as server:
                    self.assertEqual(one_shot(server, GLB, SMALL).status, 200)
                    scene = upload(server, GLB)
                    server.ask("DELETE", f"/v1/scenes/{scene}")
                    self.assertEqual(one_shot(server, GLB, SMALL).status, 200)
                    self.assertEqual(server.ask("HEAD", f"/v1/scenes/{scene}").status, 404)
                    self.assertNotIn(scene.encode(), server.get("/v1/scenes").body)

    def test_one_shots_drop_nothing_that_was_stored(self):  # T22
        with Server("--scene-memory-bytes", "200MB", "--workers", "1") as server:
            kept = upload(server, textured(4096, 1, "kept"))
            for number in range(4):
                self.assertEqual(one_shot(server, textured(4096, 1, str(number)), SMALL).status, 200)
            self.assertEqual(server.frame(kept, SMALL).status, 200)

    def test_head_says_what_get_would(self):  # T37
        with Server() as server:
            scene = server.upload("box_on_plane")
            for query, status in (("", 200), ("?camera.node=nobody", 400)):
                reply = server.ask("HEAD", f"/v1/scenes/{scene}/frame{query}")
                self.assertEqual((reply.status, reply.body), (status, b""))
                self.assertEqual(server.get(f"/v1/scenes/{scene}/frame{query}").status, status)


if __name__ == "__main__":
    unittest.main()

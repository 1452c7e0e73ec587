"""Bakes over HTTP: progress, stopping, and the frames that look the maps up."""

import json
import struct
import tempfile
import threading
import time
import unittest
from pathlib import Path

from evaluations_test import events_of
from shipped_server import EXR_MAGIC, SLOW, SMALL, Server, ServerTest, png_size

SUN = {"type": "directional", "direction": [0.4, -1, 0.2]}
BAKED = {"technique": "lightMap", "lightMap": {"size": 128}}
SPEC = {"lights": [SUN], "shadow": BAKED}
LONG = {
    "lights": [SUN | {"angularDiameterDegrees": 5}],
    "shadow": {"technique": "lightMap", "lightMap": {"size": 4096, "samples": 1024}},
}


class BakesTest(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def bake(self, spec, accept="application/json"):
        headers = {"Content-Type": "application/json", "Accept": accept}
        return self.server.ask("POST", f"/v1/scenes/{self.scene}/bakes", json.dumps(spec), headers)

    def begin(self, spec):
        """A bare connection to a bake that has begun, the events read so far, and its key."""
        body = json.dumps(spec)
        connection = self.server.socket()
        head = f"POST /v1/scenes/{self.scene}/bakes HTTP/1.1\r\nHost: localhost\r\nContent-Length: {len(body)}\r\n"
        head += "Content-Type: application/json\r\nAccept: text/event-stream\r\n\r\n"
        connection.sendall((head + body).encode())
        text = ""
        while '"share"' not in text or not text.endswith("\n\n"):
            piece = connection.recv(65536)
            self.assertTrue(piece, text)
            text += piece.decode()
        _, key = next(event for event in events_of(text.split("\r\n\r\n", 1)[1]) if event[0] == "progress")
        return connection, key["key"]

    def remove(self, key):
        return self.server.ask("DELETE", f"/v1/scenes/{self.scene}/bakes/{key}")

    def wait_until_free(self):
        """The seconds until a bake is taken again."""
        start = time.monotonic()
        while (reply := self.bake(SPEC)).status != 200:
            self.assert_problem(reply, 429)
            self.assertLess(time.monotonic() - start, 30 * SLOW)
            time.sleep(0.01)
        return time.monotonic() - start


class Bakes(BakesTest):
    def light_maps(self, spec):
        reply = self.server.frame(self.scene, SMALL | spec, "application/json")
        self.assertEqual(reply.status, 200, reply.body)
        return [light["lightMap"] for light in reply.json()["report"]["lights"]]

    def test_a_frame_reuses_what_was_baked_ahead(self):
        spec = SPEC | {"lights": [SUN | {"direction": [0.1, -1, 0.3]}]}
        first = self.bake(spec)
        self.assertEqual((first.status, first.headers["Content-Type"]), (200, "application/json"), first.body)
        self.assertEqual(first.headers["Cache-Control"], "no-store")
        report = first.json()
        baked = report["lights"][0]
        self.assertEqual((baked["light"], baked["lightMap"]["reused"]), (0, False))
        self.assertLessEqual(max(baked["lightMap"]["width"], baked["lightMap"]["height"]), 128)
        for field in ("charts", "texelsPerMetre", "bakeMilliseconds", "bytes"):
            self.assertGreater(baked["lightMap"][field], 0)
        again = self.bake(spec | SMALL).json()
        self.assertEqual((again["key"], again["lights"][0]["lightMap"]["reused"]), (report["key"], True))
        self.assertTrue(self.light_maps(spec)[0]["reused"])
        brighter = spec | {"lights": [spec["lights"][0] | {"intensity": 9}]}
        self.assertTrue(self.light_maps(brighter)[0]["reused"], "how bright a light is does not change its shadow")
        other = spec | {"lights": [spec["lights"][0] | {"direction": [0.2, -1, 0.3]}]}
        self.assertFalse(self.light_maps(other)[0]["reused"])

    def test_events_tell_progress_of_each_light_and_at_last_the_result(self):
        lights = [SUN | {"direction": [0.3, -1, 0.1]}, {"type": "point", "position": [1, 4, 1], "radius": 0.2}]
        shadow = {"technique": "lightMap", "lightMap": {"size": 512, "samples": 256}}
        reply = self.bake({"lights": lights, "shadow": shadow}, "text/event-stream")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "text/event-stream"), reply.body)
        events = events_of(reply.body.decode())
        steps = [data for name, data in events if name == "progress"]
        self.assertEqual([step["light"] for step in steps], sorted(step["light"] for step in steps))
        self.assertEqual({(step["light"], step["done"], step["of"]) for step in steps}, {(0, 0, 2), (1, 1, 2)})
        for light in (0, 1):
            shares = [step["share"] for step in steps if step["light"] == light]
            self.assertEqual(shares, sorted(shares))
            self.assertLessEqual(shares[-1], 1)
        name, result = events[-1]
        self.assertEqual((name, [each["light"] for each in result["lights"]]), ("result", [0, 1]))
        self.assertEqual({step["key"] for step in steps}, {result["key"]})

    def test_who_removes_a_bake_stops_it(self):
        connection, key = self.begin(LONG)
        with connection:
            self.assert_problem(self.bake(SPEC), 429)
            start = time.monotonic()
            self.assertEqual(self.remove(key).status, 204)
            rest = b""
            while piece := connection.recv(65536):
                rest += piece
            took = time.monotonic() - start
        self.assertIn(b"event: problem", rest)
        self.assertLess(took, 1 * SLOW, "all of it would take minutes")
        self.assert_problem(self.remove(key), 404, "key")
        self.wait_until_free()

    def test_who_leaves_stops_the_bake(self):
        connection, _ = self.begin(LONG)
        connection.close()
        self.assertLess(self.wait_until_free(), 5 * SLOW)

    def test_who_leaves_a_frame_that_bakes_holds_up_no_other(self):
        body = json.dumps(SMALL | LONG)
        connection = self.server.socket()
        head = f"POST /v1/scenes/{self.scene}/frames HTTP/1.1\r\nHost: localhost\r\nContent-Length: {len(body)}\r\n"
        connection.sendall((head + "Content-Type: application/json\r\n\r\n" + body).encode())
        time.sleep(0.5 * SLOW)
        connection.close()
        start = time.monotonic()
        self.assertEqual(self.server.frame(self.scene, SMALL).status, 200)
        self.assertLess(time.monotonic() - start, 5 * SLOW, "all of it would take minutes")

    def test_frames_of_others_are_drawn_beside_a_bake(self):
        connection, key = self.begin(LONG)
        with connection:
            self.assertEqual(self.server.frame(self.scene, SMALL).status, 200)
            self.assertTrue(self.light_maps(SPEC)[0]["width"] > 0)
            self.assertEqual(self.remove(key).status, 204)
        self.wait_until_free()

    def test_two_at_once_do_not_harm_each_other(self):
        replies = []
        ask = lambda: replies.append(self.bake(SPEC).status)
        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(set(replies) <= {200, 429}, replies)
        self.assertIn(200, replies)

    def test_what_can_not_be_baked_is_refused(self):
        self.assert_problem(self.bake({"shadow": {"technique": "rayTraced"}}), 400, "/shadow/technique")
        self.assert_problem(self.bake({"shadow": {"lightmap": {}}}), 400, "/shadow/lightmap")
        self.assert_problem(self.bake({"quality": {"maxError": 0.1}, "shadow": BAKED}), 400, "/quality")
        self.assert_problem(self.bake(SPEC, "image/gif"), 406)
        dense = SPEC | {"shadow": {"technique": "lightMap", "lightMap": {"texelsPerMetre": 1e6}}}
        reply = self.bake(dense)
        self.assert_problem(reply, 400, "/shadow/lightMap/texelsPerMetre")
        self.assertIn("8192", reply.json()["problems"][0]["detail"])
        name, problem = events_of(self.bake(dense, "text/event-stream").body.decode())[-1]
        self.assertEqual((name, problem["status"]), ("problem", 400))
        unknown = self.server.ask("POST", f"/v1/scenes/{'0' * 64}/bakes", "{}", {"Content-Type": "application/json"})
        self.assert_problem(unknown, 404, "id")
        self.assert_problem(self.remove("0" * 64), 404, "key")


class Files(BakesTest):
    """What was baked, in each form."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.two = SPEC | {"lights": [SUN, SUN | {"direction": [-0.4, -1, 0.2], "color": [1, 0, 0]}]}

    def file(self, key, accept, query=""):
        return self.server.get(f"/v1/scenes/{self.scene}/bakes/{key}{query}", Accept=accept)

    def glb(self, data):
        """(JSON, binary) of a GLB."""
        magic, version, length = struct.unpack("<4sII", data[:12])
        self.assertEqual((magic, version, length), (b"glTF", 2, len(data)))
        size = struct.unpack("<I", data[12:16])[0]
        return json.loads(data[20 : 20 + size]), data[28 + size :]

    def test_pictures_of_the_map(self):
        report = self.bake(self.two).json()
        size = tuple(report["lights"][0]["lightMap"][side] for side in ("width", "height"))
        pictures = {query: self.file(report["key"], "image/png", query) for query in ("", "?light=0", "?light=1")}
        for reply in pictures.values():
            self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"))
            self.assertEqual(png_size(reply.body), size)
        self.assertEqual(pictures[""].body, pictures["?light=0"].body)
        self.assertNotEqual(pictures[""].body, pictures["?light=1"].body)
        exr = self.file(report["key"], "image/x-exr").body
        self.assertTrue(exr.startswith(EXR_MAGIC))
        self.assertIn(b"light0.Y\0", exr)
        self.assertIn(b"light1.Y\0", exr)

    def test_a_glb_has_the_light_under_moz_lightmap_and_is_a_scene_again(self):
        key = self.bake(self.two).json()["key"]
        reply = self.file(key, "model/gltf-binary")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "model/gltf-binary"))
        document, binary = self.glb(reply.body)
        self.assertIn("MOZ_lightmap", document["extensionsUsed"])
        self.assertNotIn("KHR_lights_punctual", document["extensionsUsed"])
        for material in document["materials"]:
            light_map = material["extensions"]["MOZ_lightmap"]
            self.assertEqual(light_map["texCoord"], 1)
            self.assertGreater(light_map["intensity"], 0)
        image = document["images"][document["textures"][light_map["index"]]["source"]]
        view = document["bufferViews"][image["bufferView"]]
        png_size(binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]])
        for mesh in document["meshes"]:
            for primitive in mesh["primitives"]:
                accessor = document["accessors"][primitive["attributes"]["TEXCOORD_1"]]
                view = document["bufferViews"][accessor["bufferView"]]
                values = struct.unpack_from(f"<{2 * accessor['count']}f", binary, view["byteOffset"])
                self.assertTrue(all(0 <= value <= 1 for value in values))
        upload = self.server.ask("POST", "/v1/scenes", reply.body, {"Content-Type": "model/gltf-binary"})
        self.assertEqual(upload.status, 201, upload.body)
        original = self.server.get(f"/v1/scenes/{self.scene}").json()
        for field in ("triangles", "instances", "boundsMin", "boundsMax"):
            self.assertEqual(upload.json()[field], original[field])

    def test_a_sky_is_baked_where_rays_to_it_are_asked_for(self):
        sky = {"sky": {"sun": {"elevationDegrees": 40}}, "shadows": "rays", "samples": 1}
        reply = self.bake({"environment": sky, "shadow": BAKED}, "text/event-stream")
        events = events_of(reply.body.decode())
        self.assertEqual(events[-1][0], "result", reply.body)
        report, last = events[-1][1], events[-2][1]
        self.assertNotIn("light", last)
        self.assertEqual((last["done"], last["of"]), (1, 2))
        self.assertEqual([each["light"] for each in report["lights"]], [0])
        size = tuple(report["environment"][side] for side in ("width", "height"))
        pictures = [self.file(report["key"], "image/png", query) for query in ("", "?light=0", "?light=environment")]
        self.assertEqual([png_size(picture.body) for picture in pictures], 3 * [size])
        self.assertEqual(pictures[0].body, pictures[1].body)
        self.assertNotEqual(pictures[0].body, pictures[2].body)
        exr = self.file(report["key"], "image/x-exr").body
        for layer in (b"light0.Y\0", b"environment.R\0", b"environment.G\0", b"environment.B\0"):
            self.assertIn(layer, exr)
        glbs = [self.file(report["key"], "model/gltf-binary", query) for query in ("", "?light=0", "?light=environment")]
        light = [
            self.glb(glb.body)[0]["materials"][0]["extensions"]["MOZ_lightmap"]["intensity"] for glb in glbs
        ]
        self.assertLess(light[2], light[1], "the sun is brighter than its sky")
        self.assertLess(light[1], light[0])
        without = self.bake({"environment": sky | {"shadows": "none"}, "shadow": BAKED}).json()
        self.assertNotIn("environment", without)
        self.assertNotEqual(without["key"], report["key"])
        self.assert_problem(self.file(without["key"], "image/png", "?light=environment"), 400, "/light")

    def test_what_can_not_be_sent_is_refused(self):
        key = self.bake(self.two).json()["key"]
        self.assert_problem(self.file(key, "image/gif"), 406)
        self.assert_problem(self.file("0" * 64, "image/png"), 404, "key")
        for query in ("?light=2", "?light=-1", "?light=x", "?light=0&light=1", "?light=99999999999"):
            self.assertEqual(self.file(key, "image/png", query).status, 400, query)
        self.assert_problem(self.file(key, "image/png", "?lights=1"), 400, "/lights")
        uneven = self.two | {"lights": [SUN, SUN | {"shadow": BAKED | {"lightMap": {"size": 64}}}]}
        key = self.bake(uneven).json()["key"]
        self.assert_problem(self.file(key, "model/gltf-binary"), 400, "/lights/1/shadow/lightMap")
        self.assertEqual(self.file(key, "model/gltf-binary", "?light=1").status, 200)
        self.remove(key)
        self.assert_problem(self.file(key, "image/png"), 404, "key")


class Stored(ServerTest):
    """Maps outlive the server, and a file that was harmed is baked again."""

    def bake(self, server, spec=SPEC):
        scene = server.upload("box_on_plane")
        headers = {"Content-Type": "application/json"}
        reply = server.ask("POST", f"/v1/scenes/{scene}/bakes", json.dumps(spec), headers)
        self.assertEqual(reply.status, 200, reply.body)
        return scene, reply.json()["lights"][0]["lightMap"]

    def test_a_map_survives_a_restart_and_goes_with_its_scene(self):
        with tempfile.TemporaryDirectory() as store:
            with Server("--store", store) as server:
                scene, first = self.bake(server)
                self.assertFalse(first["reused"])
                picture = server.frame(scene, SMALL | SPEC).body
            (file,) = (Path(store) / "light-maps").iterdir()
            self.assertTrue(file.name.startswith(scene))
            with Server("--store", store) as server:
                reply = server.frame(scene, SMALL | SPEC, "multipart/mixed")
                self.assertIn(b'"reused":true', reply.body.replace(b" ", b""))
                self.assertEqual(server.frame(scene, SMALL | SPEC).body, picture)
                self.assertEqual(self.bake(server)[1], first | {"reused": True})
                self.assertEqual(server.ask("DELETE", f"/v1/scenes/{scene}").status, 204)
            self.assertEqual(list((Path(store) / "light-maps").iterdir()), [])

    def test_a_file_that_was_harmed_is_baked_again(self):
        with tempfile.TemporaryDirectory() as store:
            with Server("--store", store) as server:
                self.bake(server)
            (file,) = (Path(store) / "light-maps").iterdir()
            whole = file.read_bytes()
            for harmed in (b"", whole[:-1], whole[:20], whole[:-1] + bytes([whole[-1] ^ 1]), b"x" * len(whole)):
                file.write_bytes(harmed)
                with Server("--store", store) as server:
                    self.assertFalse(self.bake(server)[1]["reused"])
                self.assertEqual(len(file.read_bytes()), len(whole))

    def test_the_directory_stays_within_its_bytes(self):
        with tempfile.TemporaryDirectory() as store:
            with Server("--store", store, "--stored-light-map-bytes", "60KB") as server:
                for azimuth in range(4):
                    light = SUN | {"direction": [0.4 + azimuth / 10, -1, 0.2]}
                    self.bake(server, SPEC | {"lights": [light]})
                sizes = [file.stat().st_size for file in (Path(store) / "light-maps").iterdir()]
                self.assertTrue(0 < sum(sizes) <= 60 * 1024, sizes)


class LittleMemory(BakesTest):
    flags = ("--frame-memory-bytes", "4MB")

    def test_a_bake_that_does_not_fit_is_refused_before_it_begins(self):
        self.assert_problem(self.bake(LONG), 413, "/shadow/lightMap")
        self.assertEqual(self.bake(SPEC).status, 200)


if __name__ == "__main__":
    unittest.main()

"""docker/haproxy_replicas.cfg by the real program, with replicas that share a store: where requests go, and what becomes of
them when a replica dies. Longer proofs: tests/bench/routing.py."""

import base64
import collections
import hashlib
import json
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

from shipped_proxy import HAPROXY, Replicas
from shipped_server import SCENES, SMALL, TIMEOUT

GLB = {"Content-Type": "model/gltf-binary"}
JSON = {"Content-Type": "application/json"}
# Some seconds of work on a core.
LONG = {"width": 640, "height": 360, "antialiasing": "none", "shadow": {"technique": "rayTraced", "raySamples": 256},
        "lights": [{"sun": {"azimuthDegrees": number, "elevationDegrees": 45}, "angularDiameterDegrees": 60}
                   for number in range(8)]}  # fmt: skip


@unittest.skipUnless(HAPROXY, "haproxy is not installed")
class HaproxyReplicas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.fleet = Replicas(3, folder.name, "--device", "cpu", "--workers", "1", slow_start="1s")
        cls.addClassCleanup(cls.fleet.__exit__)
        cls.fleet.wait_for(3)
        cls.scenes = {}
        for name in ("box_on_plane", "room_corner", "ladder", "panes"):
            body = (SCENES / f"{name}.glb").read_bytes()
            cls.scenes[hashlib.sha256(body).hexdigest()] = body
        for scene, body in cls.scenes.items():
            assert cls.fleet.ask("PUT", f"/v1/scenes/{scene}", body, GLB).status == 201
        cls.settle()

    @classmethod
    def settle(cls):
        """Until no scene's place changes any more: weights grow with the checks of a slow start."""
        places, since, end = cls.places(), time.monotonic(), time.monotonic() + TIMEOUT
        while time.monotonic() - since < 2.5:
            assert time.monotonic() < end
            time.sleep(0.1)
            if (now := cls.places()) != places:
                places, since = now, time.monotonic()
        return places

    @classmethod
    def places(cls):
        """Which replica each of many scenes belongs to, whether it is there or not."""
        names = (hashlib.sha256(str(each).encode()).hexdigest() for each in range(300))
        connection = cls.fleet.connect()
        places = {}
        for name in names:
            connection.request("HEAD", f"/v1/scenes/{name}")
            reply = connection.getresponse()
            reply.read()
            places[name] = reply.headers["X-Served-By"]
        connection.close()
        return places

    def frame(self, scene, spec=SMALL):
        return self.fleet.ask("POST", f"/v1/scenes/{scene}/frames", json.dumps(spec), JSON)

    def test_a_scene_has_one_replica(self):
        # One connection: its next request begins when the proxy is done with the last one, which does not count any more.
        connection = self.fleet.connect()
        self.addCleanup(connection.close)
        for scene, body in self.scenes.items():
            digest = base64.b64encode(bytes.fromhex(scene)).decode()
            replies = [
                self.fleet.ask(*request, connection=connection)
                for request in (
                    ("PUT", f"/v1/scenes/{scene}", body, GLB),
                    ("POST", "/v1/scenes", body, GLB | {"Content-Digest": f"sha-256=:{digest}:"}),
                    ("GET", f"/v1/scenes/{scene}"),
                    ("GET", f"/v1/scenes/{scene}/frame?width=64&height=48"),
                    ("POST", f"/v1/scenes/{scene}/plan", json.dumps(SMALL), JSON),
                    ("POST", f"/v1/scenes/{scene}/frames", json.dumps(SMALL), JSON),
                )
            ]
            self.assertEqual({reply.status for reply in replies}, {200}, [reply.body[:300] for reply in replies])
            self.assertEqual(len({reply.headers["X-Served-By"] for reply in replies}), 1)
        self.assertEqual(set(self.places().values()), {"replica1", "replica2", "replica3"})

    def test_what_names_no_scene_goes_round(self):
        for method, path, body, headers in (("GET", "/v1/capabilities", None, {}), ("GET", "/", None, {}),
                                            ("POST", "/v1/scenes", next(iter(self.scenes.values())), GLB)):  # fmt: skip
            replies = [self.fleet.ask(method, path, body, headers) for _ in range(12)]
            self.assertEqual({reply.status for reply in replies}, {200})
            self.assertEqual(len({reply.headers["X-Served-By"] for reply in replies}), 3, path)

    def test_odd_digests_and_paths_are_served_all_the_same(self):
        body = next(iter(self.scenes.values()))
        for digest in ("", "sha-256=", "sha-256=:AAAA:", "sha-256=:" + "!" * 43 + "=:", "sha-512=:" + "A" * 86 + "==:",
                       "sha-256=:" + "A" * 43 + "=:, sha-512=:AAAA:"):  # fmt: skip
            self.assertEqual(self.fleet.ask("POST", "/v1/scenes", body, GLB | {"Content-Digest": digest}).status, 200, digest)
        for path in ("/v1/scenes/", "/v1/scenes/abc/frame", "/v1/scenes/" + "g" * 64, "/v1/scenes/" + "a" * 65, "/v1//scenes"):
            self.assertIn(self.fleet.ask("GET", path).status, (400, 404), path)
        self.assertEqual(self.fleet.ask("GET", "/metrics").status, 404)

    def test_a_scene_that_all_ask_for_is_drawn_by_several(self):
        scene = next(iter(self.scenes))
        with ThreadPoolExecutor(9) as threads:
            replies = list(threads.map(lambda each: self.frame(scene, LONG | {"exposure": 1 + each / 100}), range(9)))
        self.assertEqual({reply.status for reply in replies}, {200})
        counts = collections.Counter(reply.headers["X-Served-By"] for reply in replies)
        self.assertGreaterEqual(len(counts), 2)
        self.assertLessEqual(max(counts.values()), 7, "twice the average, and one as another ends")

    def test_x_one_more_takes_its_share_and_moves_no_other(self):
        before = self.places()
        self.fleet.start("127.0.0.14")
        self.fleet.wait_for(4)
        after = self.settle()
        moved = {scene for scene in before if before[scene] != after[scene]}
        self.assertEqual({after[scene] for scene in moved}, {"replica4"})
        self.assertLess(len(moved), 300 / 4 * 1.3)
        self.assertGreater(len(moved), 300 / 4 * 0.7)

    def at_work(self):
        """The address of a replica that has a task in hand."""
        for address, server in self.fleet.servers.items():
            for line in server.get("/metrics").body.decode().splitlines():
                if line.startswith("gnomon_running_tasks{") and not line.endswith(" 0"):
                    return address
        return None

    def killed_in_work(self, path, body):
        """The reply to a request whose replica is killed while it has it in hand, and that replica's name."""
        with ThreadPoolExecutor(1) as thread:
            reply = thread.submit(self.fleet.ask, "POST", path, body, JSON)
            end = time.monotonic() + TIMEOUT
            while (address := self.at_work()) is None:
                self.assertLess(time.monotonic(), end)
                self.assertFalse(reply.done(), "it was no work")
            self.fleet.kill(address)
            told = reply.result(TIMEOUT)
        self.fleet.restart(address)
        self.fleet.wait_for(len(self.fleet.servers))
        return told, f"replica{int(address.rsplit('.', 1)[1]) - 10}"

    def test_y_a_frame_of_a_replica_that_dies_is_drawn_by_another(self):
        scene = next(iter(self.scenes))
        reply, place = self.killed_in_work(f"/v1/scenes/{scene}/frames", json.dumps(LONG | {"exposure": 2}))
        self.assertEqual((reply.status, reply.body[1:4]), (200, b"PNG"), reply.body[:300])
        self.assertNotEqual(reply.headers["X-Served-By"], place)

    def test_y_what_does_not_fit_a_buffer_is_not_tried_again(self):
        scene = next(iter(self.scenes))
        body = json.dumps(LONG | {"exposure": 3}) + " " * 33_000
        reply, _ = self.killed_in_work(f"/v1/scenes/{scene}/frames", body)
        self.assertEqual(reply.status, 502, reply.body[:300])

    def test_y_work_of_minutes_is_not_tried_again(self):
        scene = next(iter(self.scenes))
        body = json.dumps({"spec": LONG, "frames": [{"exposure": 4 + each} for each in range(8)]})
        reply, _ = self.killed_in_work(f"/v1/scenes/{scene}/sequences", body)
        self.assertEqual(reply.status, 502, reply.body[:300])

    def test_z_nobody_notices_that_a_replica_is_gone(self):
        """Frames go on while one is killed, before any check has failed, and when it is back."""
        statuses, stop = collections.Counter(), threading.Event()

        def draw(number):
            each = 0
            while not stop.is_set():
                each += 1
                scene = list(self.scenes)[each % len(self.scenes)]
                reply = self.frame(scene, SMALL | {"exposure": 1 + number + each / 1e4})
                statuses[reply.status, reply.headers["X-Served-By"]] += 1

        with ThreadPoolExecutor(4) as threads:
            drawing = [threads.submit(draw, number) for number in range(4)]
            for address in list(self.fleet.servers)[:2]:
                self.fleet.kill(address)
                self.fleet.wait_for(len(self.fleet.servers) - 1)
                self.fleet.restart(address)
                self.fleet.wait_for(len(self.fleet.servers))
            stop.set()
            for each in drawing:
                each.result(TIMEOUT)
        self.assertEqual({status for status, _ in statuses}, {200}, statuses)
        self.assertGreater(sum(statuses.values()), 20)


if __name__ == "__main__":
    unittest.main()

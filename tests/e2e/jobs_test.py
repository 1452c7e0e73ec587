"""Sequences as jobs: asked for, looked at, waited for, taken and removed, by whom they belong to."""

import hashlib
import io
import json
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

from evaluations_test import events_of
from redis_place import RedisServer, needs_redis
from sequences_test import SPEC, named, orbit, parts_of
from shipped_server import SCENES, SLOW, TIMEOUT, Server, ServerTest

LAMP = [{"type": "point", "position": [1, 3, 2], "intensity": 400}]
HEAVY = {"width": 4096, "height": 2160, "lights": LAMP * 250, "shadow": {"technique": "rayTraced", "raySamples": 1024}}
LONG = {"spec": SPEC | {"width": 480, "height": 270}, "frames": [{"exposure": i / 500} for i in range(1000)]}


def ask_for(server, scene, request, **headers):
    headers = {"Content-Type": "application/json", "Prefer": "respond-async"} | headers
    return server.ask("POST", f"/v1/scenes/{scene}/sequences", json.dumps(request), headers)


class JobTest(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def tearDown(self):
        for job in self.server.get("/v1/jobs").json()["jobs"]:
            self.server.ask("DELETE", job["address"])
        super().tearDown()

    def submit(self, request):
        reply = ask_for(self.server, self.scene, request)
        self.assertEqual(reply.status, 202, reply.body)
        return reply.json()

    def ended(self, job):
        """The job once it has ended."""
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            reply = self.server.get(job["address"] + "?wait=5")
            self.assertEqual(reply.status, 200, reply.body)
            if reply.json()["state"] not in ("queued", "running"):
                return reply.json()
        raise AssertionError("the job does not end")

    def at_once(self, request, accept="multipart/mixed"):
        """The same as a sequence that is waited for."""
        headers = {"Content-Type": "application/json", "Accept": accept}
        return self.server.ask("POST", f"/v1/scenes/{self.scene}/sequences", json.dumps(request), headers)


class Jobs(JobTest):
    def test_a_job_is_asked_for_waited_for_and_taken(self):
        reply = ask_for(self.server, self.scene, orbit(4), Prefer="respond-async, wait=10")
        self.assertEqual(reply.status, 202, reply.body)
        self.assertEqual(reply.headers["Preference-Applied"], "respond-async")
        job = reply.json()
        self.assertRegex(job["id"], "^[0-9a-f]{32}$")
        self.assertEqual(reply.headers["Location"], f"/v1/jobs/{job['id']}")
        self.assertEqual((job["state"], job["done"], job["of"], job["scene"]), ("queued", 0, 4, self.scene))
        done = self.ended(job)
        self.assertEqual((done["state"], done["done"], done["of"], done["problems"]), ("done", 4, 4, []))
        self.assertLessEqual(done["created"], done["started"])
        self.assertLessEqual(done["started"], done["ended"])
        self.assertLess(done["ended"], done["expires"])
        self.assertEqual(done["result"], job["address"] + "/result")
        self.assertIn(job["id"], [each["id"] for each in self.server.get("/v1/jobs").json()["jobs"]])

    def test_the_result_has_the_bytes_of_the_sequence_that_is_waited_for(self):
        chained = orbit(4, ["color", "depth"])
        alone = orbit(4) | {"stable": False}
        lamps = orbit(3)
        lamps["spec"] = lamps["spec"] | {"lights": LAMP}
        for request in (chained, alone, lamps, chained | {"carried": {"depthRanges": [{"light": 0, "near": 1, "far": 9}]}}):
            job = self.submit(request)
            self.assertEqual(self.ended(job)["state"], "done")
            expected, told = parts_of(self.at_once(request)), parts_of(self.server.get(job["result"]))
            self.assertEqual(list(named(told)), list(named(expected)))
            for (headers, content), (own_headers, own) in zip(expected[:-1], told[:-1]):
                self.assertEqual(own, content)
                self.assertEqual(own_headers, headers)
            report, own_report = json.loads(expected[-1][1]), json.loads(told[-1][1])
            for name in ("carried", "warnings", "renderer"):
                self.assertEqual(own_report[name], report[name])
            self.assertEqual(len(own_report["frames"]), len(report["frames"]))

    def test_the_result_comes_in_every_form_of_a_sequence(self):
        job = self.submit(orbit(2))
        zipped = self.server.get(job["result"], Accept="application/zip")  # which waits for what is not drawn yet
        files = named(parts_of(self.at_once(orbit(2))))
        with zipfile.ZipFile(io.BytesIO(zipped.body)) as archive:
            self.assertEqual(archive.namelist(), list(files))
            for name in archive.namelist()[:-1]:
                self.assertEqual(archive.read(name), files[name])
        events = events_of(self.server.get(job["result"], Accept="text/event-stream").body.decode())
        self.assertEqual([name for name, _ in events], ["frame", "frame", "result"])
        self.assert_problem(self.server.get(job["result"], Accept="video/mp4"), 406)
        connection = self.server.connect()
        for path, accept in [(job["result"], "application/zip"), (job["address"], "text/event-stream")]:
            told = self.server.ask("HEAD", path, headers={"Accept": accept}, connection=connection)
            self.assertEqual((told.status, told.headers["Content-Type"], told.body), (200, accept, b""))
        self.assertEqual(self.server.ask("GET", job["address"], connection=connection).json()["state"], "done")
        connection.close()

    def test_one_frame_is_a_picture_and_several_views_are_parts(self):
        job = self.submit(orbit(2))
        self.ended(job)
        files = named(parts_of(self.at_once(orbit(2))))
        reply = self.server.get(job["frames"].replace("{index}", "1"))
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"))
        self.assertEqual(reply.body, files["frame-00001.png"])
        again = self.server.get(job["address"] + "/frames/1", If_None_Match=reply.headers["ETag"])
        self.assertEqual((again.status, again.body), (304, b""))
        self.assertNotEqual(self.server.get(job["address"] + "/frames/0").headers["ETag"], reply.headers["ETag"])
        self.assert_problem(self.server.get(job["address"] + "/frames/1", Accept="image/jpeg"), 406)
        for index in ("2", "-1", "x", "99999999999"):
            self.assert_problem(self.server.get(f"{job['address']}/frames/{index}"), 404, "index")
        several = self.submit(orbit(1, ["color", "depth"]))
        self.ended(several)
        parts = parts_of(self.server.get(several["address"] + "/frames/0"))
        self.assertEqual([headers["Gnomon-View"] for headers, _ in parts], ["color", "depth"])

    def test_progress_is_told_as_events(self):
        job = self.submit(orbit(5))
        events = events_of(self.server.get(job["address"], Accept="text/event-stream").body.decode())
        self.assertEqual({name for name, _ in events[:-1]}, {"progress"})
        self.assertEqual((events[-1][0], events[-1][1]["state"], events[-1][1]["done"]), ("result", "done", 5))
        counts = [told["done"] for _, told in events]
        self.assertEqual(counts, sorted(counts))

    def test_a_job_whose_frame_can_not_be_drawn_fails_and_keeps_what_it_has(self):
        nobody = {"camera": {"node": "nobody", "eye": None, "target": None}}
        job = self.submit({"spec": SPEC, "frames": [{}, {}, nobody, {}]})
        failed = self.ended(job)
        self.assertEqual((failed["state"], failed["done"]), ("failed", 2))
        self.assertEqual(failed["problems"][0]["pointer"], "/frames/2/camera/node")
        parts = named(parts_of(self.server.get(job["result"])))
        self.assertEqual(list(parts), ["frame-00000.png", "frame-00001.png", "problem.json"])
        self.assert_problem(self.server.get(job["address"] + "/frames/3"), 404, "index")
        first = self.submit({"spec": SPEC, "frames": [nobody]})
        self.ended(first)
        self.assert_problem(self.server.get(first["result"]), 400, "/frames/0/camera/node")

    def test_a_job_of_a_scene_that_was_deleted_fails(self):
        scene = self.server.upload("coplanar")
        reply = ask_for(self.server, scene, LONG)
        self.assertEqual(self.server.ask("DELETE", f"/v1/scenes/{scene}").status, 204)
        failed = self.ended(reply.json())
        self.assertEqual((failed["state"], failed["problems"][0]["code"]), ("failed", "notFound"))

    def test_frames_of_jobs_stand_before_nobody(self):
        job = self.submit(LONG)
        events = self.server.get(job["address"] + "?wait=0").json()
        self.assertIn(events["state"], ("queued", "running"))
        for _ in range(3):
            start = time.monotonic()
            self.assertEqual(self.server.frame(self.scene, {"width": 64, "height": 48}).status, 200)
            self.assertLess(time.monotonic() - start, 20 * SLOW)

    def test_whoever_waits_for_a_job_that_is_removed_is_told(self):
        job = self.submit(LONG)
        waiting = []
        for path, accept in [(job["address"] + "?wait=30", "*/*"), (job["address"], "text/event-stream"),
                             (job["result"], "text/event-stream")]:
            waiting.append(self.server.connect())
            waiting[-1].request("GET", path, headers={"Accept": accept})
        while self.server.get(job["address"]).json()["done"] == 0:
            time.sleep(0.01)
        self.assertEqual(self.server.ask("DELETE", job["address"]).status, 204)
        for connection in waiting:
            text = connection.getresponse().read().decode()
            self.assertTrue('"cancelled"' in text or "event: problem" in text, text[-500:])
            connection.close()
        for method, path in [("GET", ""), ("DELETE", ""), ("GET", "/result"), ("GET", "/frames/0")]:
            self.assert_problem(self.server.ask(method, job["address"] + path), 404, "id")

    def test_what_is_wrong_is_said_at_once(self):
        self.assert_problem(ask_for(self.server, self.scene, {"frames": [{}, {"width": 0}]}), 400, "/frames/1/width")
        self.assert_problem(ask_for(self.server, "0" * 64, {"frames": [{}]}), 404)
        self.assert_problem(self.server.get("/v1/jobs/" + "0" * 32), 404, "id")
        job = self.submit(orbit(1))
        for query, pointer in (("wait=-1", "/wait"), ("wait=61", "/wait"), ("wait=x", "/wait"), ("wait=1&wait=2", "/wait"),
                               ("until=5", "/until")):
            self.assert_problem(self.server.get(f"{job['address']}?{query}"), 400, pointer)


class Bounds(JobTest):
    flags = ("--max-jobs", "2", "--job-bytes", "100KB", "--job-age", "2s", "--job-frames", "1", "--request-timeout", "5")

    def test_a_client_has_only_so_many_jobs_and_old_ones_go(self):
        first = self.submit(orbit(1))
        self.submit(orbit(1))
        refused = ask_for(self.server, self.scene, orbit(1))
        self.assert_problem(refused, 429)
        self.assertGreaterEqual(int(refused.headers["Retry-After"]), 1)
        end = time.monotonic() + TIMEOUT
        while self.server.get(first["address"]).status == 200 and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.server.get(first["address"]).status, 404)

    def test_a_frame_that_is_too_much_work_is_refused(self):
        self.assert_problem(ask_for(self.server, self.scene, {"spec": HEAVY, "frames": [{}, {}]}), 413)

    def test_a_job_without_room_fails(self):
        spec = SPEC | {"width": 256, "height": 256, "output": {"format": "png", "pngCompression": 0}}
        failed = self.ended(self.submit({"spec": spec, "frames": [{}]}))
        self.assertEqual((failed["state"], failed["problems"][0]["code"]), ("failed", "insufficientStorage"))
        self.assert_problem(self.server.get(failed["result"]), 507)


class Owners(unittest.TestCase):
    def keys_in(self, folder):
        """A key file with three keys, and what a request has of each: of ann, bob, and an operator."""
        file = Path(folder, "keys")
        scopes = {"ann": "read,render,upload", "bob": "read,render,upload", "operator": "admin"}
        file.write_text("".join(f"name={name} sha256={hashlib.sha256(name.encode()).hexdigest()} scopes={each}\n"
                                for name, each in scopes.items()))  # fmt: skip
        file.chmod(0o600)
        return str(file), *({"Authorization": f"Bearer {name}"} for name in scopes)

    def assert_operator_rules(self, *flags):
        """An admin's key sees the jobs of all keys, takes their pictures and ends them; others see their own."""
        with tempfile.TemporaryDirectory() as folder:
            keys, ann, bob, operator = self.keys_in(folder)
            with Server("--device", "cpu", "--keys", keys, *flags) as server:
                body = (SCENES / "box_on_plane.glb").read_bytes()
                scene = server.ask("POST", "/v1/scenes", body, {"Content-Type": "model/gltf-binary"} | ann).json()["id"]
                jobs = [ask_for(server, scene, request, **who).json() for who, request in
                        ((ann, LONG), (bob, orbit(2)), (operator, orbit(2)))]  # fmt: skip
                seen = lambda who: [(each["key"], each["id"]) for each in  # noqa: E731
                                    server.ask("GET", "/v1/jobs", headers=who).json()["jobs"]]
                names = [(name, job["id"]) for name, job in zip(("ann", "bob", "operator"), jobs)]
                self.assertEqual(sorted(seen(operator)), sorted(names))
                self.assertEqual([seen(ann), seen(bob)], [names[:1], names[1:2]])
                self.assertEqual(server.ask("GET", jobs[1]["address"] + "?wait=30", headers=operator).json()["state"], "done")
                self.assertEqual(server.ask("GET", jobs[1]["result"], headers=operator).status, 200)
                self.assertEqual(server.ask("DELETE", jobs[0]["address"], headers=bob).status, 404)
                self.assertEqual(server.ask("DELETE", jobs[0]["address"], headers=operator).status, 204)
                self.assertEqual(server.ask("GET", jobs[0]["address"], headers=ann).status, 404)
                self.assertEqual(server.ask("GET", jobs[2]["address"], headers=ann).status, 404)
                self.assertEqual(sorted(seen(operator)), sorted(names[1:]))

    def test_an_operator_sees_and_stops_all_jobs(self):
        self.assert_operator_rules()

    @needs_redis
    def test_an_operator_sees_and_stops_all_jobs_in_redis(self):
        with RedisServer() as redis:
            self.assert_operator_rules("--store", redis.url)

    def test_a_job_belongs_to_the_key_that_made_it(self):
        with tempfile.TemporaryDirectory() as folder:
            keys, ann, bob, _ = self.keys_in(folder)
            with Server("--device", "cpu", "--keys", keys, "--store", folder + "/store") as server:
                body = (SCENES / "box_on_plane.glb").read_bytes()
                scene = server.ask("POST", "/v1/scenes", body, {"Content-Type": "model/gltf-binary"} | ann).json()["id"]
                job = ask_for(server, scene, orbit(2), **ann).json()
                for method, path in [("GET", ""), ("DELETE", ""), ("GET", "/result"), ("GET", "/frames/0")]:
                    self.assertEqual(server.ask(method, job["address"] + path, headers=bob).status, 404, path)
                self.assertEqual(server.ask("GET", "/v1/jobs", headers=bob).json(), {"jobs": []})
                listed = server.ask("GET", "/v1/jobs", headers=ann).json()["jobs"]
                self.assertEqual([each["id"] for each in listed], [job["id"]])
                self.assertEqual(server.ask("GET", job["result"], headers=ann).status, 200)
                self.assertEqual(list(Path(folder, "store").glob("*job*")), [], "pictures have no names")


@needs_redis
class Shared(unittest.TestCase):
    """Two servers with one Redis: each draws, tells and ends the jobs of both."""

    def setUp(self):
        self.redis = self.enterContext(RedisServer("--appendonly", "yes"))
        self.servers = [self.enterContext(Server("--device", "cpu", "--workers", "1", "--store", self.redis.url))
                        for _ in range(2)]
        self.scene = self.servers[0].upload("box_on_plane")

    def frames_drawn(self, server):
        for line in server.get("/metrics").body.decode().splitlines():
            if line.startswith('gnomon_queue_wait_seconds_count{lane="sequence"}'):
                return float(line.split()[-1])
        return 0

    def test_a_job_is_drawn_by_both_and_known_to_both(self):
        first, second = self.servers
        request = orbit(60) | {"stable": False}
        job = ask_for(first, self.scene, request).json()
        done = second.get(job["address"] + "?wait=30").json()
        self.assertEqual((done["state"], done["done"]), ("done", 60))
        self.assertEqual([each["id"] for each in second.get("/v1/jobs").json()["jobs"]], [job["id"]])
        self.assertGreater(self.frames_drawn(first), 0)
        self.assertGreater(self.frames_drawn(second), 0)
        headers = {"Content-Type": "application/json"}
        alone = first.ask("POST", f"/v1/scenes/{self.scene}/sequences", json.dumps(request), headers)
        for server in self.servers:
            told = parts_of(server.get(job["result"]))
            self.assertEqual([content for _, content in told[:-1]], [content for _, content in parts_of(alone)[:-1]])
        self.assertEqual(second.ask("DELETE", job["address"]).status, 204)
        self.assertEqual(first.get(job["address"]).status, 404)

    def test_a_job_outlives_the_server_that_took_it_and_ends_on_any(self):
        first, second = self.servers
        job = ask_for(first, self.scene, LONG | {"stable": False}).json()
        while second.get(job["address"]).json()["done"] == 0:
            time.sleep(0.01)
        first.process.kill()
        first.process.wait()
        before = second.get(job["address"]).json()["done"]
        end = time.monotonic() + TIMEOUT
        while second.get(job["address"]).json()["done"] < before + 3:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        self.assertEqual(second.ask("DELETE", job["address"]).status, 204)

    def test_the_frames_of_a_server_that_is_killed_go_on_within_three_seconds(self):
        first, second = self.servers  # each has one frame in hand, and each job only one that may be drawn
        jobs = [ask_for(first, self.scene, LONG).json()["address"] for _ in range(4)]
        done = {job: 0 for job in jobs}
        while min(done.values()) == 0:
            done = {job: second.get(job).json()["done"] for job in jobs}
        first.process.kill()
        first.process.wait()
        begin = time.monotonic()
        changed = dict.fromkeys(jobs, begin)
        longest = 0.0
        while time.monotonic() < begin + 8:
            for job in jobs:
                reply, now = second.get(job).json(), time.monotonic()
                if reply["done"] > done[job] or reply["state"] == "done":
                    longest = max(longest, now - changed[job])
                    done[job], changed[job] = reply["done"], now
        longest = max(longest, *(time.monotonic() - each for each in changed.values()))
        self.assertLess(longest, 3 * SLOW)

    def test_while_redis_is_away_jobs_are_asked_for_again_later(self):
        server = self.servers[0]
        job = ask_for(server, self.scene, orbit(3)).json()
        self.assertEqual(server.get(job["address"] + "?wait=30").json()["state"], "done")
        self.redis.kill()
        replies = [server.get(job["address"]), server.get(job["result"]), server.get(job["address"] + "/frames/0"),
                   server.get("/v1/jobs"), server.ask("DELETE", job["address"])]
        for reply in replies:
            self.assertEqual(reply.status, 503, reply.body)
            self.assertGreaterEqual(int(reply.headers["Retry-After"]), 1)
            self.assertEqual(reply.json()["problems"][0]["code"], "unavailable")
        time.sleep(3)
        server.settled_log()
        lines = [line for line in server.log_lines() if line.get("event") == "jobs"]
        self.assertEqual(len(lines), 1, lines)
        self.redis.start()
        end = time.monotonic() + TIMEOUT
        while server.get(job["address"]).status != 200 and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(server.get(job["address"]).json()["state"], "done")
        self.assertEqual(server.get(job["address"] + "/frames/2").status, 200)


if __name__ == "__main__":
    unittest.main()

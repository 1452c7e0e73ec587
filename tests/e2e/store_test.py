"""A store with a quota, an age, and more scenes than one list should hold."""

import contextlib
import fcntl
import hashlib
import http.client
import itertools
import json
import os
import subprocess
import tempfile
import threading
import time
import unittest
from pathlib import Path

from shipped_server import SCENES, SLOW, SMALL, TIMEOUT, Server, environment
from shipped_server import BINARY
from triggers_store_test import MEGABYTE, padded, upload

KILOBYTE = 1 << 10


def id_of(glb):
    return hashlib.sha256(glb).hexdigest()


def until(condition):
    """Waits; false where it does not come true."""
    end = time.monotonic() + TIMEOUT
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False


class StoreCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.store = Path(folder.name)
        self.flags = ("--device", "cpu", "--workers", "1", "--store", folder.name)

    def ids(self):
        return sorted(path.stem for path in self.store.glob("*.bundle"))

    def stored_bytes(self):
        return sum(path.stat().st_size for path in self.store.glob("*.bundle"))

    def touch(self, scene):
        (self.store / f"{scene}.bundle").touch()

    def last_use(self, scene):
        return (self.store / f"{scene}.bundle").stat().st_mtime

    def make_old(self, scene):
        os.utime(self.store / f"{scene}.bundle", (0, 0))

    def assert_holds_only(self, scenes):
        """Nothing but these scenes is there: nothing unfinished, no summary of others."""
        names = [path.name for path in self.store.iterdir() if path.is_file()]
        self.assertEqual(sorted(names), sorted(f"{scene}.{ending}" for scene in scenes for ending in ("bundle", "json")))


class Quota(StoreCase):
    def test_what_does_not_fit_is_refused_with_the_number_and_the_flag(self):
        scenes = [padded(300 * KILOBYTE, str(number)) for number in range(3)]
        with Server(*self.flags, "--max-scene-bytes", "500kB", "--store-bytes", "700kB") as server:
            self.assertEqual([upload(server, glb).status for glb in scenes[:2]], [201, 201])
            refused = upload(server, scenes[2])
            self.assertEqual(refused.status, 507)
            problem = refused.json()["problems"][0]
            self.assertIn("--store-bytes", problem["detail"])
            self.assertEqual(problem["limit"], f"{700 * KILOBYTE} bytes")
            self.assertIn(str(len(scenes[2])), problem["actual"])
            self.assertEqual(upload(server, scenes[0]).status, 200, "what is there already needs no room")
            self.assertEqual(server.frame(id_of(scenes[0]), SMALL).status, 200)
            self.assert_holds_only([id_of(glb) for glb in scenes[:2]])
            self.assertEqual(server.ask("DELETE", f"/v1/scenes/{id_of(scenes[0])}").status, 204)
            self.assertEqual(upload(server, scenes[2]).status, 201)

    def test_uploads_at_once_do_not_pass_it_together(self):
        scenes = [padded(300 * KILOBYTE, str(number)) for number in range(8)]
        statuses = []
        with Server(*self.flags, "--max-scene-bytes", "500kB", "--store-bytes", "1MB") as server:
            threads = [threading.Thread(target=lambda glb=glb: statuses.append(upload(server, glb).status)) for glb in scenes]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(set(statuses), {201, 507})
        self.assertEqual(statuses.count(201), len(self.ids()))
        self.assertLessEqual(self.stored_bytes(), MEGABYTE)

    def test_scenes_of_another_server_count(self):
        with Server(*self.flags) as other, Server(*self.flags, "--max-scene-bytes", "500kB", "--store-bytes", "500kB") as server:
            self.assertEqual(upload(other, padded(300 * KILOBYTE, "other")).status, 201)
            own = padded(300 * KILOBYTE, "own")
            self.assertEqual(upload(server, own).status, 507)
            self.assertEqual(other.ask("DELETE", f"/v1/scenes/{self.ids()[0]}").status, 204)
            self.assertTrue(until(lambda: upload(server, own).status == 201))

    def test_it_needs_a_store(self):
        for flag, value in (("--store-bytes", "1GB"), ("--store-age", "30d")):
            done = subprocess.run([BINARY, "serve", "--port", "0", flag, value], capture_output=True, text=True,
                                  timeout=TIMEOUT, env=environment())  # fmt: skip
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(flag, done.stderr)


class Age(StoreCase):
    def test_a_scene_goes_when_nobody_used_it_for_so_long(self):
        with Server(*self.flags, "--store-age", "3s") as server, Server(*self.flags, "--store-age", "3s") as other:
            unused, drawn, sent = (upload(server, padded(100, name)).json()["id"] for name in ("unused", "drawn", "sent"))
            glb = padded(100, "never")
            begin = time.monotonic()
            while unused in self.ids():
                self.assertLess(time.monotonic() - begin, TIMEOUT)
                # Both servers keep what either of them uses: pictures from memory and known uploads, too.
                self.assertEqual(other.frame(drawn, SMALL).status, 200)
                self.assertEqual(upload(server, (SCENES / "box_on_plane.glb").read_bytes()).status in (200, 201), True)
                self.touch(sent)
                time.sleep(0.1)
            self.assertGreater(time.monotonic() - begin, 2.5)
            self.assertEqual(server.get(f"/v1/scenes/{unused}").status, 404)
            self.assertEqual(server.frame(unused, SMALL).status, 404)
            self.assertEqual(other.frame(unused, SMALL).status, 404)
            self.assert_holds_only(self.ids())
            self.assertEqual(server.frame(drawn, SMALL).status, 200)
            self.assertTrue(server.log_has(unused) if unused in server.log_text() else other.log_has(unused))

    def test_a_scene_that_was_drawn_goes_once_nobody_draws_it(self):
        with Server(*self.flags) as server:
            scene = upload(server, padded(100, "drawn")).json()["id"]
        with Server(*self.flags, "--store-age", "2s") as server:  # whose workers read the bundle from the disk
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            self.assertTrue(until(lambda: scene not in self.ids()))
            self.assertEqual(server.frame(scene, SMALL).status, 404)

    def test_a_scene_is_there_for_as_long_as_it_is_worked_on(self):
        with Server(*self.flags) as server:
            scene = upload(server, padded(100, "worked on")).json()["id"]
        with Server(*self.flags, "--store-age", "1s") as server:
            body = json.dumps({"spec": {"width": 960, "height": 540}, "sweep": "sizes", "repeats": 40})
            replies = []
            thread = threading.Thread(
                target=lambda: replies.append(
                    server.ask("POST", f"/v1/scenes/{scene}/evaluations", body, {"Content-Type": "application/json"})
                )
            )
            begin = time.monotonic()
            thread.start()
            while thread.is_alive():
                there = scene in self.ids()
                self.assertTrue(there or not thread.is_alive(), time.monotonic() - begin)
                time.sleep(0.05)
            thread.join()
            self.assertGreater(time.monotonic() - begin, 2, "it has to last longer than the age")
            self.assertEqual(replies[0].status, 200)
            self.assertTrue(until(lambda: scene not in self.ids()))

    def test_a_scene_in_use_is_not_taken_away(self):
        with Server(*self.flags, "--store-age", "1s") as server:
            scene = upload(server, padded(100, "held")).json()["id"]
            bundle = self.store / f"{scene}.bundle"
            with bundle.open("rb") as held:
                fcntl.flock(held, fcntl.LOCK_SH)  # as a server has it that reads it
                os.utime(bundle, (0, 0))
                time.sleep(2)
                self.assertTrue(bundle.exists())
            self.assertTrue(until(lambda: not bundle.exists()))

    def test_without_an_age_nothing_goes(self):
        glb = padded(100, "old")
        with Server(*self.flags) as server:
            scene = upload(server, glb).json()["id"]
            self.make_old(scene)
        with Server(*self.flags) as server:
            self.assertEqual(server.frame(scene, SMALL).status, 200)
        self.assertTrue(until(lambda: self.last_use(scene) > time.time() - TIMEOUT), "drawing marks it")


class Orphans(StoreCase):
    def test_files_of_a_dead_server_go_and_those_of_a_living_one_stay(self):
        (self.store / "light-maps").mkdir()
        paths = [folder / f".writing-{name}" for folder in (self.store, self.store / "light-maps") for name in "ab"]
        for path in paths:
            path.write_bytes(b"half")
            os.utime(path, (time.time() - 100,) * 2)
        living = [path.open("rb") for path in paths[1::2]]
        try:
            for file in living:  # as a server does that writes them, however slowly
                fcntl.flock(file, fcntl.LOCK_EX)
            with Server(*self.flags, "--store-age", "2s") as server:
                self.assertEqual([path.exists() for path in paths], [False, True, False, True])
                paths[0].write_bytes(b"half")
                orphan = self.store / ("a" * 64 + ".json")
                orphan.write_text("{}")
                os.utime(paths[0], (time.time() - 100,) * 2)
                self.assertTrue(until(lambda: not paths[0].exists() and not orphan.exists()), "while it runs")
                self.assertTrue(paths[1].exists())
                self.assertEqual(server.get("/livez").status, 200)
        finally:
            for file in living:
                file.close()

    def test_what_a_killed_server_was_writing_goes(self):
        # How long a file is half written depends on the disk: one after another is sent until one is caught at it.
        def send(server):
            with contextlib.suppress(OSError, http.client.HTTPException):
                for number in itertools.count():
                    upload(server, padded(32 * MEGABYTE, str(number)))
                    for path in self.store.glob("*.bundle"):
                        path.unlink()

        def caught():
            with Server(*self.flags) as server:
                thread = threading.Thread(target=send, args=(server,))
                thread.start()
                end = time.monotonic() + TIMEOUT
                while not list(self.store.glob(".writing-*")) and time.monotonic() < end:
                    time.sleep(0.001)
                server.process.kill()
                thread.join()
            return list(self.store.glob(".writing-*"))

        left = next(filter(None, (caught() for _ in range(5))), [])
        self.assertTrue(left, "no server was caught while it wrote")
        for path in left:
            os.utime(path, (time.time() - 100,) * 2)
        with Server(*self.flags):
            self.assertEqual(list(self.store.glob(".writing-*")), [])


class Shared(StoreCase):
    def test_what_one_server_does_the_other_sees_within_a_second(self):
        glb = padded(100, "shared")
        scene, target = id_of(glb), f"/v1/scenes/{id_of(glb)}/frame?width=64&height=48"
        with Server(*self.flags) as one, Server(*self.flags) as other:
            self.assertEqual(upload(one, glb).status, 201)
            self.assertEqual(upload(other, glb).status, 200)
            drawn = other.get(target)  # which is then in the memory of its front and of its worker
            self.assertEqual((drawn.status, one.get(target).body), (200, drawn.body))
            self.assertEqual(one.ask("DELETE", f"/v1/scenes/{scene}").status, 204)
            begin = time.monotonic()
            self.assertTrue(until(lambda: other.get(target).status == 404))
            self.assertLess(time.monotonic() - begin, 1 * SLOW)
            self.assertEqual(other.frame(scene, SMALL).status, 404)
            self.assertEqual(other.get("/v1/scenes").json(), {"scenes": []})
            self.assert_holds_only([])
            self.assertEqual(upload(other, glb).status, 201)
            self.assertTrue(until(lambda: one.get(target).body == drawn.body))


    def test_a_choice_of_settings_is_made_once_for_all(self):
        spec = SMALL | {"quality": {"maxError": 0.0}}
        glb = padded(100, "chosen")
        with Server(*self.flags) as one:
            scene = upload(one, glb).json()["id"]
            made = one.frame(scene, spec, "application/json").json()["report"]["quality"]
        with Server(*self.flags) as other:
            kept = other.frame(scene, spec, "application/json").json()["report"]["quality"]
        self.assertEqual((made["cached"], kept["cached"]), (False, True))
        self.assertEqual((kept["chosen"], kept["tried"]), (made["chosen"], made["tried"]))


class T26(StoreCase):
    COUNT = 100_000 // SLOW

    def test_T26_a_page_of_a_hundred_thousand_scenes_holds_nobody_up(self):
        with Server(*self.flags) as server:
            known = upload(server, padded(10, "known")).json()
            summary = json.dumps(known, separators=(",", ":"))
        text = (self.store / f"{known['id']}.json").read_text()
        self.assertEqual(json.loads(text), json.loads(summary))
        ids = sorted([known["id"]] + [hashlib.sha256(b"%d" % number).hexdigest() for number in range(self.COUNT)])
        middle = next(number for number, scene in enumerate(ids) if scene > "8" * 64)
        for scene in ids:
            (self.store / f"{scene}.bundle").touch()
        for scene in ids[501:506] + ids[middle : middle + 1000]:  # those that are listed
            (self.store / f"{scene}.json").write_text(text.replace(known["id"], scene))
        with Server(*self.flags, "--store-bytes", "1GB") as server:
            self.assertEqual(server.frame(known["id"], SMALL).status, 200)
            before = server.resident_bytes()
            stop, slowest = threading.Event(), [0.0, 0.0]

            def list_pages():
                while not stop.is_set():
                    begin = time.monotonic()
                    self.assertEqual(len(server.get("/v1/scenes?limit=1000&after=" + "8" * 64).json()["scenes"]), 1000)
                    slowest[0] = max(slowest[0], time.monotonic() - begin)

            lister = threading.Thread(target=list_pages)
            lister.start()
            for number in range(40):
                begin = time.monotonic()
                self.assertEqual(server.get("/livez").status, 200)
                self.assertEqual(server.frame(known["id"], SMALL | {"exposure": 0.1 + number / 100}).status, 200)
                self.assertEqual(server.ask("HEAD", f"/v1/scenes/{ids[middle + number]}").status, 200)
                slowest[1] = max(slowest[1], time.monotonic() - begin)
            stop.set()
            lister.join()
            self.assertLess(slowest[0], 3 * SLOW, "a page")
            self.assertLess(slowest[1], 1.5 * SLOW, "others meanwhile")
            self.assertLess(server.resident_bytes() - before, 96 * MEGABYTE)
            after = [scene["id"] for scene in server.get(f"/v1/scenes?limit=5&after={ids[500]}").json()["scenes"]]
            self.assertEqual(after, ids[501:506])

    def test_T26_pages_of_large_summaries_end_early(self):
        def many_cameras(count, tag):
            glb = padded(10, tag)
            length = int.from_bytes(glb[12:16], "little")
            document = json.loads(glb[20 : 20 + length])
            first = len(document["nodes"])
            document.setdefault("cameras", []).append({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}})
            camera = len(document["cameras"]) - 1
            document["nodes"] += [{"name": f"{number:0256d}", "camera": camera} for number in range(count)]
            document["scenes"][0]["nodes"] += list(range(first, first + count))
            text = json.dumps(document).encode()
            text += b" " * (-len(text) % 4)
            body = len(text).to_bytes(4, "little") + b"JSON" + text + glb[20 + length :]
            return b"glTF" + (2).to_bytes(4, "little") + (12 + len(body)).to_bytes(4, "little") + body

        with Server(*self.flags) as server:
            for number in range(4):
                self.assertEqual(upload(server, many_cameras(12_000, str(number))).status, 201)
            first = server.get("/v1/scenes").json()
            self.assertEqual([scene["id"] for scene in first["scenes"]], self.ids()[: len(first["scenes"])])
            self.assertLess(len(first["scenes"]), 4, "8 MiB are enough for a page")
            second = server.get(f"/v1/scenes?after={first['next']}").json()
            self.assertEqual([scene["id"] for scene in first["scenes"] + second["scenes"]], self.ids())
            refused = upload(server, many_cameras(60_000, "too many"))
            self.assertEqual((refused.status, refused.json()["problems"][0]["limit"]), (413, f"{16 * MEGABYTE} bytes"))
            self.assertEqual(len(self.ids()), 4)


if __name__ == "__main__":
    unittest.main()

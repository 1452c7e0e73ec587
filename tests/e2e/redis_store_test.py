"""Scenes in Redis: what a store in a directory does, and what a Redis server that is away or asks for a password means."""

import threading
import unittest
from pathlib import Path

import scene_pages_test
import store_test
import triggers_store_test
from redis_place import OnRedis, RedisServer, needs_redis
from rights import needs_to_see_closed_processes
from shipped_server import SMALL, Server, workers_of
from store_test import MEGABYTE, id_of, padded, until, upload


class Quota(OnRedis, store_test.Quota):
    test_it_needs_a_store = None


class Age(OnRedis, store_test.Age):
    # Of a directory's files, which are locked and marked.
    test_a_scene_in_use_is_not_taken_away = None
    test_a_scene_is_there_for_as_long_as_it_is_worked_on = None
    test_files_of_a_dead_server_go_and_those_of_a_living_one_stay = None
    test_what_a_killed_server_was_writing_goes = None


class Shared(OnRedis, store_test.Shared):
    pass


class Pages(OnRedis, scene_pages_test.Pages):
    test_the_page_follows_them = None  # the same code

    @classmethod
    def setUpClass(cls):
        redis = RedisServer()
        cls.addClassCleanup(redis.__exit__)
        cls.flags = (*scene_pages_test.Pages.flags, "--store", redis.url)
        super().setUpClass()

    def setUp(self):
        pass


class Uploads(OnRedis, unittest.TestCase):
    test_servers_leave_each_others_alone = (
        triggers_store_test.Store.test_servers_of_one_store_leave_each_others_uploads_alone
    )
    test_a_lower_limit_leaves_what_is_stored = triggers_store_test.Store.test_a_lower_limit_leaves_what_is_stored


def reading(server, name):
    """The value of a metric without labels."""
    for line in server.get("/metrics").body.decode().splitlines():
        if line.startswith(name + " "):
            return float(line.split()[1])
    raise AssertionError(f"there is no metric {name}")


class Away(OnRedis, unittest.TestCase):
    def test_what_is_in_memory_is_served_and_all_else_waits(self):
        glb, later = padded(100, "warm"), padded(100, "later")
        with Server(*self.flags) as server:
            scene = upload(server, glb).json()["id"]
            self.assertEqual(server.frame(scene, SMALL).status, 200)
            self.redis.kill()
            self.assertEqual(server.frame(scene, SMALL | {"exposure": 0.5}).status, 200)
            self.assertEqual(server.get(f"/v1/scenes/{scene}").status, 200)
            self.assertEqual(upload(server, glb).status, 200, "it is known")
            for reply in (
                upload(server, later),
                server.frame("0" * 64, SMALL),
                server.get("/v1/scenes"),
                server.ask("DELETE", f"/v1/scenes/{scene}"),
            ):
                self.assertEqual((reply.status, reply.json()["title"]), (503, "Service Unavailable"))
                self.assertGreaterEqual(int(reply.headers["Retry-After"]), 1)
                self.assertNotIn("127.0.0.1", reply.body.decode())
            ready = server.get("/readyz")
            self.assertEqual(ready.status, 200)
            self.assertIn(b"Redis is away", ready.body)
            self.assertEqual(reading(server, "gnomon_store_reachable"), 0)
            self.redis.start()
            self.assertTrue(until(lambda: upload(server, later).status == 201))
            self.assertEqual(server.get("/readyz").body, b"ready\n")
            self.assertEqual(reading(server, "gnomon_store_reachable"), 1)
            self.assertEqual(len(self.ids()), 2)

    def test_a_server_starts_without_it_and_finds_it(self):
        self.redis.kill()
        with Server(*self.flags) as server:
            self.assertEqual(upload(server, padded(100, "early")).status, 503)
            self.redis.start()
            self.assertTrue(until(lambda: upload(server, padded(100, "early")).status == 201))

    def test_killed_and_started_while_clients_upload_and_draw(self):
        warm = padded(100, "warm")
        kept, statuses, drawn, stop = [], set(), set(), threading.Event()

        def uploads(server, name):
            for number in range(10_000):
                if stop.is_set():
                    return
                glb = padded(3 * MEGABYTE, f"{name} {number}")
                status = upload(server, glb).status
                statuses.add(status)
                if status == 201:
                    kept.append(id_of(glb))

        def frames(server, scene):
            number = 0
            while not stop.is_set():
                number += 1
                drawn.add(server.frame(scene, SMALL | {"exposure": 0.1 + number / 10_000}).status)

        with Server(*self.flags) as one, Server(*self.flags) as other:
            scene = upload(one, warm).json()["id"]
            self.assertEqual(other.frame(scene, SMALL).status, 200)
            threads = [threading.Thread(target=uploads, args=(one, "one")), threading.Thread(target=uploads, args=(other, "two")),
                       threading.Thread(target=frames, args=(other, scene))]  # fmt: skip
            for thread in threads:
                thread.start()
            for _ in range(2):
                there = len(kept)
                self.assertTrue(until(lambda there=there: len(kept) >= there + 2))
                self.redis.kill()
                self.assertTrue(until(lambda: 503 in statuses))
                self.redis.start()
            there = len(kept)
            self.assertTrue(until(lambda: len(kept) >= there + 2), "it goes on by itself")
            stop.set()
            for thread in threads:
                thread.join()
            self.assertEqual(statuses, {201, 503})
            self.assertEqual(drawn, {200}, "what is warm is drawn all the time")
        stored = self.ids()
        self.assertLessEqual(set(kept) | {scene}, set(stored), "what was 201 is there")
        with Server(*self.flags) as fresh:
            for each in stored:
                self.assertEqual(fresh.frame(each, SMALL).status, 200, "what is there is whole")
        for key in self.redis.ask("KEYS", "gnomon:part:*"):
            if not any(key.startswith("gnomon:part:" + self.redis.ask("HGET", f"gnomon:scene:{each}", "parts")) for each in stored):
                self.assertGreater(self.redis.ask("TTL", key), 0, "what is left of an upload expires")


@needs_redis
class Secrets(unittest.TestCase):
    def test_a_password_is_taken_and_never_told(self):
        with RedisServer("--requirepass", "swordfish-17") as redis:
            password = redis.path / "password"
            password.write_text("swordfish-17\n")
            flags = ("--device", "cpu", "--workers", "1", "--store")
            at = redis.url.removeprefix("redis://")
            for more in ([redis.url, "--redis-password-file", str(password)], [f"redis://:swordfish-17@{at}"]):
                with Server(*flags, *more) as server:
                    self.assertEqual(upload(server, padded(100, "x")).status in (200, 201), True)
                    redis.kill()
                    self.assertTrue(until(lambda: upload(server, padded(10, "y")).status == 503))
                    told = server.get("/metrics").body + server.get("/v1/capabilities").body + server.get("/readyz").body
                    self.assertNotIn(b"swordfish", told)
                    self.assertNotIn("swordfish", server.settled_log())
                    redis.start()
            with Server(*flags, f"redis://:wrong-herring@{at}") as server:
                self.assertEqual(upload(server, padded(100, "z")).status, 503)
                self.assertTrue(server.log_has("WRONGPASS"))
                self.assertNotIn("herring", server.settled_log())

    def test_it_may_come_by_a_variable(self):
        with RedisServer("--requirepass", "swordfish-17") as redis:
            at = redis.url.removeprefix("redis://")
            with Server("--device", "cpu", "--workers", "1", variables={"GNOMON_STORE": f"redis://:swordfish-17@{at}"}) as server:
                self.assertEqual(upload(server, padded(100, "x")).status, 201)
                started = workers_of(server)
                self.assertTrue(started)
                with self.subTest("workers' variables"):
                    needs_to_see_closed_processes()
                    for worker in started:
                        variables = Path(f"/proc/{worker}/environ").read_bytes()
                        self.assertIn(b"PATH=", variables)
                        self.assertNotIn(b"swordfish", variables)

    def test_tls_is_spoken_and_the_certificate_checked(self):
        with RedisServer(tls=True) as redis:
            flags = ("--device", "cpu", "--workers", "1", "--store", redis.url)
            with Server(*flags, "--redis-authorities", str(redis.authorities)) as server:
                scene = upload(server, padded(5 * MEGABYTE, "tls")).json()["id"]
            with Server(*flags, "--redis-authorities", str(redis.authorities)) as server:
                self.assertEqual(server.frame(scene, SMALL).status, 200)
            with Server(*flags) as server:
                self.assertEqual(server.frame(scene, SMALL).status, 503)
                self.assertTrue(server.log_has("certificate"))


class Refused(unittest.TestCase):
    def test_what_makes_no_sense_ends_the_start(self):
        for flags, words in (
            (("--store", "redis://:secret-word@host:99999"), "out of range"),
            (("--store", "redis://"), "no valid host"),
            (("--store", "rediss://host", "--redis-password-file", "/nowhere"), "password"),
            (("--store", "redis://host", "--redis-authorities", "/nowhere"), "rediss://"),
            (("--redis-authorities", "/nowhere"), "--store"),
        ):
            with self.assertRaises(AssertionError) as refused:
                Server("--device", "cpu", *flags)
            self.assertIn(words, str(refused.exception))
            self.assertNotIn("secret-word", str(refused.exception))


if __name__ == "__main__":
    unittest.main()

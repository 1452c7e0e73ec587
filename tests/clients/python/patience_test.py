"""The Python client against a server that is busy, has dropped a scene, restarts, or asks for a key."""

import asyncio
import hashlib
import itertools
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from shipped_server import SCENES, SLOW, Server

import gnomon
from gnomon import png

BOX = SCENES / "box_on_plane.glb"
SMALL = {"width": 64, "height": 48}


def url_of(server):
    return "http://{}:{}".format(*server.address)


def replies_of(server, status):
    """How many requests were answered so."""
    return sum(line.get("status") == status for line in server.log_lines())


class Busy(unittest.TestCase):
    def test_a_full_queue_is_waited_out(self):
        with Server("--device", "cpu", "--queue-limit", "1", "--workers", "1") as server:
            with gnomon.Session(url_of(server), patience=120 * SLOW) as session, ThreadPoolExecutor(12) as threads:
                scene = session.upload(BOX)
                specs = [{"width": 640, "height": 480, "exposure": 0.01 * index} for index in range(24)]
                pictures = list(threads.map(lambda spec: session.picture(scene, spec), specs))
            self.assertTrue(all(each.startswith(png.SIGNATURE) for each in pictures))
            server.settled_log()
            self.assertGreater(replies_of(server, 429), 0, "nobody had to wait")

    def test_patience_has_an_end(self):
        with Server("--device", "cpu") as server, TemporaryDirectory() as folder:
            keys = Path(folder) / "keys"
            keys.write_text(f"name=slow sha256={hashlib.sha256(b'slow').hexdigest()} scopes=admin requestsPerSecond=0.01\n")
            keys.chmod(0o600)
            with Server("--device", "cpu", "--keys", str(keys)) as strict:
                with gnomon.Session(url_of(strict), key="slow", patience=2) as session:
                    session.capabilities()
                    with self.assertRaises(gnomon.Busy) as caught:
                        session.capabilities()
            self.assertEqual(caught.exception.status, 429)
            self.assertGreater(caught.exception.retry_after, 2)


class Evictions(unittest.TestCase):
    def test_a_scene_that_was_dropped_is_uploaded_again(self):
        box, city = BOX.read_bytes(), (SCENES / "pebble.glb").read_bytes()
        limit = max(len(box), len(city)) + 1000
        with Server("--device", "cpu", "--bundle-memory-bytes", str(limit), "--max-scene-bytes", str(limit),
                    "--reply-cache-bytes", "0") as server:
            with gnomon.Session(url_of(server)) as session:
                scenes = [session.upload(BOX), session.upload(city)]
                self.assertLess(len(list(session.list())), 2, "nothing was dropped")
                for scene in itertools.islice(itertools.cycle(scenes), 4):
                    self.assertTrue(session.picture(scene, **SMALL).startswith(png.SIGNATURE))
                with gnomon.Session(url_of(server)) as stranger, self.assertRaises(gnomon.NotFound):
                    stranger.picture(scenes[0].id, **SMALL)


class Restarts(unittest.TestCase):
    def test_a_server_that_comes_back_is_found(self):
        with Server("--device", "cpu") as first:
            session = gnomon.Session(url_of(first), patience=60 * SLOW)
            scene = session.upload(BOX)
            first.end()
            with ThreadPoolExecutor(1) as threads:
                waiting = threads.submit(session.picture, scene, **SMALL)
                with Server("--device", "cpu", port=first.address[1]):
                    self.assertTrue(waiting.result(60 * SLOW).startswith(png.SIGNATURE))
                    session.close()

    def test_no_server_is_told(self):
        with Server() as server:
            url = url_of(server)
        with gnomon.Session(url, patience=0.3) as session:
            with self.assertRaisesRegex(gnomon.ConnectionFailed, url):
                session.capabilities()


class Keys(unittest.TestCase):
    def test_a_key_is_shown(self):
        with TemporaryDirectory() as folder:
            keys = Path(folder) / "keys"
            keys.write_text(f"name=ci sha256={hashlib.sha256(b'secret').hexdigest()} scopes=read,render,upload\n")
            keys.chmod(0o600)
            with Server("--device", "cpu", "--keys", str(keys)) as server:
                with gnomon.Session(url_of(server), key="secret") as session:
                    self.assertTrue(session.picture(BOX, **SMALL).startswith(png.SIGNATURE))
                with gnomon.Session(url_of(server)) as session:
                    with self.assertRaises(gnomon.Refused) as caught:
                        session.picture("0" * 64, **SMALL)
                    self.assertEqual(caught.exception.status, 401)


class Asynchronous(unittest.TestCase):
    def test_frames_are_drawn_at_once(self):
        async def frames(url):
            async with gnomon.AsyncSession(url, concurrency=4) as session:
                scene = await session.upload(BOX)
                specs = [{**SMALL, "exposure": 0.1 * index} for index in range(8)]
                return await asyncio.gather(*(session.picture(scene, spec) for spec in specs))

        with Server("--device", "cpu") as server:
            pictures = asyncio.run(frames(url_of(server)))
        self.assertEqual(len(set(pictures)), 8)

    def test_a_cancelled_call_stops_the_server_and_a_waiting_one_ends(self):
        async def cancelled(server):
            async with gnomon.AsyncSession(url_of(server)) as session:
                scene = await session.upload(BOX)
                task = asyncio.create_task(session.evaluate(scene, sweep="all", repeats=100, width=1280, height=720))
                while not task.done():
                    # The one permit for evaluations is taken once a second evaluation is refused.
                    with gnomon.Session(url_of(server), patience=0) as impatient:
                        try:
                            await asyncio.to_thread(impatient.evaluate, scene, variants=[{}], repeats=1, **SMALL)
                        except gnomon.Busy:
                            break
                task.cancel()
                begun = time.monotonic()
                with self.assertRaises(asyncio.CancelledError):
                    await task
                rows = await session.evaluate(scene, variants=[{}], repeats=1, **SMALL)
                return len(rows), time.monotonic() - begun

        with Server("--device", "cpu") as server:
            rows, seconds = asyncio.run(cancelled(server))
        self.assertEqual(rows, 1)
        self.assertLess(seconds, 20 * SLOW, "the evaluation went on after it was cancelled")


if __name__ == "__main__":
    unittest.main()

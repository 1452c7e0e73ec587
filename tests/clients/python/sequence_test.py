"""Sequences of the Python client against the shipped server."""

import asyncio
import contextlib
import socket
import threading
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from shipped_server import SCENES, Server
from webm import Video

import gnomon

BOX = SCENES / "box_on_plane.glb"
SMALL = {"width": 64, "height": 48}


def azimuths(*degrees):
    return [{"camera": {"orbit": {"azimuthDegrees": each}}} for each in degrees]


class CuttingProxy:
    """Passes everything between a client and a server, but breaks off replies: the first after `limits[0]` bytes, the next
    after `limits[1]` and so on; those behind are whole."""

    def __init__(self, address, limits):
        self._address = address
        self._limits = list(limits)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = "http://{}:{}".format(*self._listener.getsockname())
        self.cuts = 0
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self._thread.join(10)

    def _serve(self):
        with contextlib.suppress(OSError):
            while True:
                client, _ = self._listener.accept()
                threading.Thread(target=self._pass, args=(client,), daemon=True).start()

    def _pass(self, client):
        with client, socket.create_connection(self._address) as server:
            limit = self._limits.pop(0) if self._limits else None
            threading.Thread(target=self._copy, args=(client, server, None), daemon=True).start()
            self._copy(server, client, limit)

    def _copy(self, source, sink, limit):
        with contextlib.suppress(OSError):
            while True:
                data = source.recv(65536 if limit is None else min(65536, limit))
                if not data:
                    break
                sink.sendall(data)
                if limit is not None:
                    limit -= len(data)
                    if limit <= 0:
                        self.cuts += 1
                        break
        for each in (source, sink):
            with contextlib.suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)


class Sequences(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = cls.enterClassContext(Server("--device", "cpu", "--max-sequences", "1"))
        cls.url = "http://{}:{}".format(*cls.server.address)
        cls.session = gnomon.Session(cls.url)
        cls.addClassCleanup(cls.session.close)
        cls.scene = cls.session.upload(BOX)

    def assert_same(self, found, wanted):
        self.assertEqual([frame.index for frame in found], [frame.index for frame in wanted])
        for one, other in zip(found, wanted):
            self.assertEqual(set(one.views), set(other.views))
            for view in other.views:
                np.testing.assert_array_equal(one.views[view], other.views[view], f"{one.index} {view}")

    def test_unstable_frames_are_those_drawn_alone(self):
        frames = [*self.session.sequence(self.scene, frames=azimuths(10, 80), stable=False, views=["color", "depth"], **SMALL)]
        alone = [self.session.frame(self.scene, patch, views=["color", "depth"], **SMALL) for patch in azimuths(10, 80)]
        self.assertTrue((frames[0].color != frames[1].color).any())
        for found, wanted in zip(frames, alone):
            for view in ("color", "depth"):
                np.testing.assert_array_equal(found.views[view], wanted.views[view])

    def test_keys_are_interpolated(self):
        frames = [*self.session.sequence(self.scene, keys=azimuths(0, 40), count=5, stable=False, **SMALL)]
        self.assertEqual([frame.index for frame in frames], [0, 1, 2, 3, 4])
        self.assertEqual(set(frames[0].views), {"color", "depth", "ids", "shadow"})
        wanted = self.session.frame(self.scene, azimuths(10)[0], **SMALL)
        np.testing.assert_array_equal(frames[1].color, wanted.color)

    def test_leaving_early_frees_the_place(self):
        for _ in range(3):  # the server draws one sequence at a time
            for frame in self.session.sequence(self.scene, keys=azimuths(0, 300), count=2000, **SMALL):
                break
            self.assertEqual(frame.index, 0)
        self.assertEqual(len([*self.session.sequence(self.scene, frames=azimuths(1), **SMALL)]), 1)

    def test_problems_have_their_places(self):
        with self.assertRaises(gnomon.BadRequest) as caught:
            next(self.session.sequence(self.scene, frames=[{}, {"shadow": {"cascadeCount": 99}}], **SMALL))
        self.assertIn("/frames/1/shadow/cascadeCount", [each.pointer for each in caught.exception.problems])

    def test_a_problem_in_the_middle_comes_behind_its_frames(self):
        frames = self.session.sequence(self.scene, frames=[{}, {}, {"camera": {"node": "nobody"}}], **SMALL)
        self.assertEqual([next(frames).index, next(frames).index], [0, 1])
        with self.assertRaises(gnomon.BadRequest) as caught:
            next(frames)
        self.assertEqual([each.pointer for each in caught.exception.problems], ["/frames/2/camera/node"])

    def test_a_broken_connection_is_gone_on_with(self):
        asked = {"keys": azimuths(0, 90), "count": 6, **SMALL}
        wanted = [*self.session.sequence(self.scene, **asked)]
        self.assertEqual(len(wanted), 6)
        with TemporaryDirectory() as folder:
            wanted[0].save(Path(folder) / "frame.npz")
            size = (Path(folder) / "frame.npz").stat().st_size
        with CuttingProxy(self.server.address, [size * 5 // 2, 100, size * 3 // 2]) as proxy:
            with gnomon.Session(proxy.url) as session:
                found = [*session.sequence(self.scene.id, **asked)]
            self.assertEqual(proxy.cuts, 3)
        self.assert_same(found, wanted)

    def test_a_connection_that_always_breaks_is_given_up(self):
        with CuttingProxy(self.server.address, [3000] * 100) as proxy, gnomon.Session(proxy.url) as session:
            with self.assertRaises((ConnectionError, OSError)):
                next(session.sequence(self.scene.id, frames=azimuths(1), **SMALL))
            self.assertEqual(proxy.cuts, 4)

    def test_a_video_is_whole_or_not_there(self):
        moves = azimuths(*range(0, 60, 10))
        with TemporaryDirectory() as folder:
            path = Path(folder) / "turn.webm"
            report = self.session.video(self.scene, path, frames=moves, framesPerSecond=12, videoQuality=50, **SMALL)
            self.assertEqual([frame["index"] for frame in report["frames"]], list(range(6)))
            self.assertEqual(report["framesPerSecond"], 12)
            video = Video(path.read_bytes())
            self.assertEqual((len(video.blocks), video.size, video.duration), (6, (64, 48), 0.5))
            size = path.stat().st_size
            path.unlink()
            with self.assertRaises(gnomon.BadRequest) as caught:
                self.session.video(self.scene, path, frames=[{}, {}, {"camera": {"node": "nobody"}}], **SMALL)
            self.assertEqual([each.pointer for each in caught.exception.problems], ["/frames/2/camera/node"])
            with self.assertRaises(gnomon.BadRequest):
                self.session.video(self.scene, path, frames=[{}], framesPerSecond=0)
            with self.assertRaisesRegex(ValueError, "webm"):
                self.session.video(self.scene, path.with_suffix(".mp4"), frames=moves, **SMALL)
            with CuttingProxy(self.server.address, [size // 2]) as proxy, gnomon.Session(proxy.url) as session:
                with self.assertRaises(ConnectionError):
                    session.video(self.scene.id, path, frames=moves, **SMALL)
                self.assertEqual(proxy.cuts, 1)
            self.assertEqual([*Path(folder).iterdir()], [])

    def test_frames_can_be_awaited_and_left(self):
        asked = {"frames": azimuths(0, 30, 60), **SMALL}

        async def all_of_them():
            async with gnomon.AsyncSession(self.url) as session:
                async for frame in session.sequence(self.scene.id, keys=azimuths(0, 300), count=2000, **SMALL):
                    break
                return [frame async for frame in session.sequence(self.scene.id, **asked)]

        self.assert_same(asyncio.run(all_of_them()), [*self.session.sequence(self.scene, **asked)])


if __name__ == "__main__":
    unittest.main()

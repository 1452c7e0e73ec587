"""Jobs of the Python client against the shipped server."""

import asyncio
import unittest

import numpy as np
from shipped_server import SCENES, TIMEOUT, Server

import gnomon

BOX = SCENES / "box_on_plane.glb"
SMALL = {"width": 64, "height": 48}
PATCHES = [{"camera": {"orbit": {"azimuthDegrees": each}}} for each in (0, 20, 40)]
NOBODY = {"camera": {"node": "nobody"}}


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = cls.enterClassContext(Server("--device", "cpu"))
        cls.session = gnomon.Session("http://{}:{}".format(*cls.server.address))
        cls.addClassCleanup(cls.session.close)

    def test_a_job_has_the_frames_of_the_sequence(self):
        job = self.session.submit(BOX, frames=PATCHES, **SMALL)
        self.assertIn(job.id, [each.id for each in self.session.jobs()])
        frames = [*job.frames()]
        self.assertEqual(job.wait(TIMEOUT)["state"], "done")
        self.assertEqual(job.progress, (3, 3))
        self.assertIn("done 3/3", repr(job))
        for found, expected in zip(frames, self.session.sequence(BOX, frames=PATCHES, **SMALL), strict=True):
            self.assertEqual(found.index, expected.index)
            for view in expected.views:
                np.testing.assert_array_equal(found.views[view], expected.views[view], view)
        again = self.session.job(job.id)
        np.testing.assert_array_equal(again.frame(1).color, frames[1].color)
        job.cancel()
        with self.assertRaises(gnomon.NotFound):
            self.session.job(job.id)

    def test_a_frame_that_can_not_be_drawn_fails_the_job(self):
        job = self.session.submit(BOX, frames=[{}, NOBODY], **SMALL)
        with self.assertRaises(gnomon.JobFailed) as failed:
            job.wait(TIMEOUT)
        self.assertEqual(failed.exception.problems[0].pointer, "/frames/1/camera/node")
        self.assertIn("/frames/1/camera/node", str(failed.exception))
        found = job.frames()
        self.assertEqual(next(found).index, 0)
        with self.assertRaises(gnomon.JobFailed):
            next(found)
        job.cancel()

    def test_a_job_that_is_removed_or_takes_long_is_told(self):
        job = self.session.submit(BOX, frames=[{}] * 3000, width=320, height=180)
        with self.assertRaises(TimeoutError):
            job.wait(0.2)
        self.assertLess(job.progress[0], 3000)
        job.cancel()
        with self.assertRaises(gnomon.JobCancelled):
            job.wait(5)

    def test_jobs_are_awaited(self):
        async def work():
            async with gnomon.AsyncSession(self.session.url) as session:
                job = await session.submit(BOX, frames=PATCHES[:1], **SMALL)
                return (await session.wait(job, TIMEOUT))["done"]

        self.assertEqual(asyncio.run(work()), 1)


if __name__ == "__main__":
    unittest.main()

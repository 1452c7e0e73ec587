"""gnomon sequence --async and gnomon jobs: asked for, looked at, waited for, fetched and cancelled."""

import json
import unittest
import zipfile

from command_line import BOX, OK, PROBLEM, USAGE, AgainstServer, gnomon

SMALL = {"width": 64, "height": 48, "antialiasing": "none"}
FRAMES = [{"camera": {"orbit": {"azimuthDegrees": each}}} for each in (10, 30, 50)]


class Jobs(AgainstServer):
    flags = ("--device", "cpu")

    def submit(self, request):
        run = gnomon("sequence", BOX, "--spec", "-", "--async", *self.where, stdin=json.dumps(request).encode())
        self.assert_ends(run, OK)
        return run.stdout.decode().strip()

    def test_a_job_from_beginning_to_end(self):
        request = {"spec": SMALL, "frames": FRAMES}
        job = self.submit(request)
        self.assertRegex(job, "^[0-9a-f]{32}$")
        waited = gnomon("jobs", "wait", job, *self.where)
        self.assert_ends(waited, OK)
        self.assertIn(b"done  3/3 frames", waited.stdout)
        listed = gnomon("jobs", "ls", *self.where)
        self.assertIn(waited.stdout.strip(), listed.stdout.splitlines())
        shown = gnomon("jobs", "show", job, *self.where)
        self.assertEqual(json.loads(shown.stdout)["state"], "done")
        file = self.folder / "some/where/frames.zip"
        self.assert_ends(gnomon("jobs", "fetch", job, "-o", str(file), *self.where), OK)
        self.assertEqual([path.name for path in file.parent.iterdir()], ["frames.zip"])
        within = gnomon("jobs", "fetch", job, "-o", str(file / "frames.zip"), *self.where)
        self.assert_ends(within, PROBLEM, f"The folder {file} can't be made")
        drawn = gnomon("sequence", BOX, "--spec", "-", "-o", str(self.folder / "frame-{frame}.png"), "--device", "cpu",
                       stdin=json.dumps(request).encode())
        self.assert_ends(drawn, OK)
        with zipfile.ZipFile(file) as archive:
            pictures = [archive.read(name) for name in archive.namelist() if name.endswith(".png")]
        self.assertEqual(pictures, [path.read_bytes() for path in sorted(self.folder.glob("frame-*.png"))])
        self.assert_ends(gnomon("jobs", "cancel", job, *self.where), OK)
        self.assert_ends(gnomon("jobs", "show", job, *self.where), PROBLEM, "no job")

    def test_a_job_that_fails_says_why(self):
        job = self.submit({"spec": SMALL, "frames": [{}, {"camera": {"node": "nobody"}}]})
        self.assert_ends(gnomon("jobs", "wait", job, *self.where), PROBLEM, "/frames/1/camera/node")
        file = self.folder / "frames.zip"
        self.assert_ends(gnomon("jobs", "fetch", job, "-o", str(file), *self.where), PROBLEM, "/frames/1/camera/node")
        with zipfile.ZipFile(file) as archive:
            self.assertEqual(archive.namelist(), ["frame-00000.png", "problem.json"])

    def test_wrong_command_lines_are_told(self):
        for arguments, words in [
            (("jobs",), "action"),
            (("jobs", "look"), "look"),
            (("jobs", "show"), "id"),
            (("jobs", "show", "7"), "id"),
            (("jobs", "ls", "0" * 32), "id"),
            (("jobs", "fetch", "0" * 32), "--output"),
            (("jobs", "show", "0" * 32, "-o", "x"), "--output"),
            (("sequence", BOX, "--async", *self.where), "--spec"),
            (("sequence", BOX, "--spec", "-"), "--output"),
            (("sequence", BOX, "--spec", "-", "--async"), "--server"),
            (("sequence", BOX, "--spec", "-", "--async", "-o", "{frame}.png", *self.where), "--output"),
        ]:
            with self.subTest(arguments):
                self.assert_ends(gnomon(*arguments, stdin=b"{}"), USAGE, words)
        self.assert_ends(gnomon("jobs", "cancel", "0" * 32, *self.where), PROBLEM, "no job")

    def test_what_can_not_be_fetched_leaves_no_file(self):
        missing = gnomon("jobs", "fetch", "0" * 32, "-o", str(self.folder / "frames.zip"), *self.where)
        self.assert_ends(missing, PROBLEM, "no job")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()

"""Runs of the shipped binary, and what they have to end with."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from shipped_server import BINARY, SCENES, TIMEOUT, ServerTest, environment

BOX = str(SCENES / "box_on_plane.glb")
SMALL = ["--size", "64x48"]
OK, PROBLEM, USAGE = 0, 1, 2


def gnomon(*arguments, stdin=b"", cwd=None, **variables):
    """A run of the binary; further keywords are environment variables."""
    return subprocess.run(
        [BINARY, *arguments], input=stdin, capture_output=True, timeout=TIMEOUT, cwd=cwd, env=environment(**variables)
    )


def split_glb(glb, folder):
    """The GLB as scene.gltf and "parts/buffer 0.bin", written to a folder; gives the .gltf's path."""
    length = int.from_bytes(glb[12:16], "little")
    document = json.loads(glb[20 : 20 + length])
    (folder / "parts").mkdir()
    (folder / "parts" / "buffer 0.bin").write_bytes(glb[28 + length :])
    document["buffers"][0]["uri"] = "parts/buffer%200.bin"
    (folder / "scene.gltf").write_text(json.dumps(document))
    return str(folder / "scene.gltf")


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.output = self.folder / "frame.png"

    def assert_ends(self, run, status, *said):
        self.assertEqual(run.returncode, status, run.stderr.decode())
        for text in said:
            self.assertIn(text, run.stderr.decode())

    def render(self, *arguments, scene=BOX, **options):
        run = gnomon("render", scene, "-o", str(self.output), *SMALL, *arguments, **options)
        self.assert_ends(run, OK)
        return run


class AgainstServer(ServerTest, CommandLine):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.url = "http://{}:{}".format(*cls.server.address)
        cls.where = ["--server", cls.url]

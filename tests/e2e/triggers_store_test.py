"""A store on a disk that is full, that several servers share, or whose limits were higher before."""

import hashlib
import json
import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

from shipped_server import SCENES, SLOW, SMALL, Server

MEGABYTE = 1 << 20


def padded(size, tag):
    """The same scene with an unused tail in its buffer, so that it has a size and an id of its own."""
    glb = (SCENES / "box_on_plane.glb").read_bytes()
    length = struct.unpack("<I", glb[12:16])[0]
    document, binary = json.loads(glb[20 : 20 + length]), glb[28 + length :]
    document["asset"]["extras"] = {"tag": tag}
    binary = binary[: document["buffers"][0]["byteLength"]] + os.urandom(size)
    document["buffers"][0]["byteLength"] = len(binary)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary


def upload(server, glb):
    return server.ask("POST", "/v1/scenes", glb, {"Content-Type": "model/gltf-binary"})


class Store(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.store = Path(folder.name)
        self.flags = ("--device", "cpu", "--store", folder.name)

    def test_servers_of_one_store_leave_each_others_uploads_alone(self):
        scenes = [padded(8 * MEGABYTE, str(number)) for number in range(6)]
        statuses = []
        with Server(*self.flags) as one, Server(*self.flags) as other:
            threads = [
                threading.Thread(target=lambda server=server, glb=glb: statuses.append(upload(server, glb).status))
                for server, glb in zip([one, other] * 3, scenes)
            ]
            for thread in threads:
                thread.start()
            starts = [Server(*self.flags) for _ in range(2)]  # while the others write
            for thread in threads:
                thread.join()
            for server in starts:
                server.__exit__()
            self.assertEqual(statuses, [201] * 6)
            for glb in scenes:
                self.assertEqual(other.get(f"/v1/scenes/{hashlib.sha256(glb).hexdigest()}").status, 200)

    def test_a_file_that_another_server_is_writing_is_not_removed(self):
        young, old = self.store / ".writing-1-1", self.store / ".writing-1-2"
        for path in (young, old):
            path.write_bytes(b"half")
        os.utime(old, (time.time() - 4000,) * 2)
        with Server(*self.flags) as server:
            self.assertEqual(upload(server, padded(100, "x")).status, 201)  # with no clash of names either
        self.assertTrue(young.exists())
        self.assertFalse(old.exists())

    def test_a_lower_limit_leaves_what_is_stored(self):
        glb = padded(100_000, "large")
        with Server(*self.flags) as server:
            scene = upload(server, glb).json()["id"]
        with Server(*self.flags, "--max-scene-bytes", "1KB") as server:
            self.assertEqual(server.frame(scene, SMALL).status, 200)

    def test_a_summary_without_its_scene_is_removed(self):
        orphan = self.store / ("a" * 64 + ".json")
        orphan.write_text("{}")
        with Server(*self.flags):
            self.assertFalse(orphan.exists())

    def test_scenes_read_from_disk_are_in_no_memory_of_the_front(self):  # T6
        with Server(*self.flags) as server:
            scenes = [upload(server, padded(24 * MEGABYTE, str(number))).json()["id"] for number in range(12)]
        with Server(*self.flags) as server:
            before, statuses = server.resident_bytes(), []
            threads = [
                threading.Thread(target=lambda scene=scene: statuses.append(server.frame(scene, SMALL).status))
                for scene in scenes
            ]
            for thread in threads:
                thread.start()
            most = 0
            while any(thread.is_alive() for thread in threads):
                most = max(most, server.resident_bytes())
                time.sleep(0.01)
            self.assertEqual(statuses, [200] * len(scenes))
            self.assertLess(most - before, 32 * MEGABYTE * SLOW, "of 288 MB that the workers read")

    def test_a_full_disk_is_said_to_be_full_and_keeps_nothing(self):
        if "GNOMON_IN_NAMESPACE" not in os.environ:  # mounting needs a namespace of one's own
            name = f"{type(self).__name__}.{self._testMethodName}"
            namespace = ["unshare", "--mount", *(["--map-root-user"] if os.getuid() else [])]
            if subprocess.run([*namespace, "true"], capture_output=True).returncode != 0:
                self.skipTest("the system lets us mount nothing, as in a container")
            command = [*namespace, sys.executable, "-B", __file__, name]
            inside = os.environ | {"GNOMON_IN_NAMESPACE": "1"}
            done = subprocess.run(command, env=inside, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr[-3000:])
            return
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=3m", "none", str(self.store)], check=True)
        self.addCleanup(subprocess.run, ["umount", str(self.store)])
        with Server(*self.flags) as server:
            for number in range(3):
                reply = upload(server, padded(5 * MEGABYTE, str(number)))
                self.assertEqual((reply.status, reply.json()["title"]), (507, "Insufficient Storage"))
            self.assertEqual([path for path in self.store.iterdir() if path.is_file()], [])
            self.assertEqual(upload(server, padded(MEGABYTE, "small")).status, 201)


if __name__ == "__main__":
    unittest.main()

"""Uploads of broken models, again and again: each gets a clean answer, and the server's memory comes back."""

import json
import random
import struct
import unittest

from shipped_server import SCENES, ServerTest

NAMES = ("box_on_plane", "normal_mapped", "multi_scene", "leaves", "lights", "city")
CUTS = 6
CHANGES = 6
SPANS = 3
ROUNDS = 2  # of a span
SLACK = 300 << 10  # bytes: what the heaps keep free at their ends


def mended(glb):
    """With the length of the whole in its header, so that what follows is read."""
    return glb[:8] + struct.pack("<I", len(glb)) + glb[12:] if len(glb) >= 12 else glb


def broken(glb, generator):
    for cut in range(CUTS):
        yield mended(glb[: len(glb) * cut // CUTS])
    for _ in range(CHANGES):
        changed = bytearray(glb)
        for _ in range(4):
            changed[generator.randrange(12, len(changed))] ^= generator.randrange(1, 256)
        yield bytes(changed)


class BrokenUploads(ServerTest):
    # A heap may keep as much free as a frame takes, which would hide what is lost.
    variables = {"MALLOC_TRIM_THRESHOLD_": str(128 << 10)}

    def upload(self, glb):
        return self.server.ask("POST", "/v1/scenes", glb, {"Content-Type": "model/gltf-binary"})

    def a_round(self):
        """Uploads every broken model, and takes away again what loads all the same; how many were refused."""
        generator = random.Random(20)  # every round the same files
        refused = 0
        for name in NAMES:
            for glb in broken((SCENES / f"{name}.glb").read_bytes(), generator):
                reply = self.upload(glb)
                self.assertIn(reply.status, (200, 201, 400, 413, 422), reply.body[:300])
                if reply.status < 300:
                    gone = self.server.ask("DELETE", f"/v1/scenes/{reply.json()['id']}")
                    self.assertEqual(gone.status, 204, gone.body[:300])
                else:
                    self.assert_problem(reply, reply.status)
                    refused += 1
        return refused

    def test_memory_comes_back(self):
        refused = self.a_round()  # libraries, pools and the allocator's own arenas
        self.a_round()
        self.assertGreater(refused, len(NAMES) * CUTS // 2)
        sizes = [self.server.resident_bytes()]
        for _ in range(SPANS):
            for _ in range(ROUNDS):
                self.assertEqual(self.a_round(), refused)
            sizes.append(self.server.resident_bytes())
        growths = [after - before for before, after in zip(sizes, sizes[1:])]
        uploads = ROUNDS * len(NAMES) * (CUTS + CHANGES)
        steps = ", ".join(f"{growth >> 10:+}" for growth in growths)
        print(f"resident: {sizes[0] >> 20} MiB; {steps} KiB by {uploads} uploads each")
        # A thread that comes to a heap for the first time takes a step; what is lost grows in every span.
        self.assertLess(min(growths), SLACK)

    def test_a_limit_is_quoted(self):
        limits = self.server.get("/v1/capabilities").json()["limits"]
        nodes = limits["maxNodes"] + 1
        text = json.dumps({"asset": {"version": "2.0"}, "nodes": [{}] * nodes})
        reply = self.server.ask("POST", "/v1/scenes", text, {"Content-Type": "model/gltf+json"})
        self.assert_problem(reply, 413, "/nodes")
        problem = reply.json()["problems"][0]
        self.assertEqual((problem["limit"], problem["actual"]), (str(limits["maxNodes"]), str(nodes)))


if __name__ == "__main__":
    unittest.main()

"""Every malformed, hostile or unsupported glTF of the shared assets: a 4xx problem, or a scene; never a crash."""

import json
import os
import unittest
from pathlib import Path

from shipped_server import SMALL, ServerTest, form

ASSETS = Path(os.environ["GNOMON_TEST_ASSETS"])
MANIFEST = ASSETS / "manifest.json"


@unittest.skipUnless(MANIFEST.exists(), f"there are no assets at {ASSETS}")
class BadAssets(ServerTest):
    def upload(self, asset):
        first = Path(asset["files"][0])
        if len(asset["files"]) == 1:
            kind = "model/gltf-binary" if first.suffix == ".glb" else "model/gltf+json"
            return self.server.ask("POST", "/v1/scenes", (ASSETS / first).read_bytes(), {"Content-Type": kind})
        parts = [("scene", first.name, (ASSETS / first).read_bytes())]
        for file in asset["files"][1:]:
            parts.append(("file", os.path.relpath(file, first.parent), (ASSETS / file).read_bytes()))
        body, content_type = form(parts)
        return self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})

    def test_each_is_refused_or_drawn(self):
        assets = json.loads(MANIFEST.read_text())["bad"]
        self.assertGreater(len(assets), 50)
        for asset in assets:
            with self.subTest(asset["path"]):
                reply = self.upload(asset)
                if asset["expect_hint"] == "reject" or reply.status not in (200, 201):
                    self.assertIn(reply.status, (400, 413, 422), reply.body[:300])
                    self.assert_problem(reply, reply.status)
                    self.assertNotIn(b"/work", reply.body)
                else:
                    frame = self.server.frame(reply.json()["id"], SMALL)
                    self.assertIn(frame.status, (200, 400, 422), frame.body[:300])
        self.assertEqual(self.server.frame(self.server.upload("box_on_plane"), SMALL).status, 200)


if __name__ == "__main__":
    unittest.main()

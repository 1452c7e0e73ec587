"""Every malformed, hostile or unsupported glTF of the shared assets: a 4xx problem, or a scene with a warning; never a
crash. What violates glTF is refused where it has to conform."""

import json
import os
import unittest
from pathlib import Path

from shipped_server import SMALL, ServerTest, form

ASSETS = Path(os.environ["GNOMON_TEST_ASSETS"])
MANIFEST = ASSETS / "manifest.json"


@unittest.skipUnless(MANIFEST.exists(), f"there are no assets at {ASSETS}")
class BadAssets(ServerTest):
    def upload(self, asset, path="/v1/scenes"):
        first = Path(asset["files"][0])
        if len(asset["files"]) == 1:
            kind = "model/gltf-binary" if first.suffix == ".glb" else "model/gltf+json"
            return self.server.ask("POST", path, (ASSETS / first).read_bytes(), {"Content-Type": kind})
        parts = [("scene", first.name, (ASSETS / first).read_bytes())]
        for file in asset["files"][1:]:
            parts.append(("file", os.path.relpath(file, first.parent), (ASSETS / file).read_bytes()))
        body, content_type = form(parts)
        return self.server.ask("POST", path, body, {"Content-Type": content_type})

    def assert_told(self, reply):
        """A refusal whose problems have a code that is not our own mistake, and a place where the file has places."""
        self.assertIn(reply.status, (400, 413, 422), reply.body[:300])
        self.assert_problem(reply, reply.status)
        self.assertNotIn(str(ASSETS.parent).encode(), reply.body)
        for problem in reply.json()["problems"]:
            self.assertNotEqual(problem["code"], "internal", problem)
            self.assertTrue(problem["detail"], problem)
            # What holds no JSON that could be read has no place in it.
            if problem["code"] != "malformed" and "GLB" not in problem["detail"]:
                self.assertRegex(problem["pointer"], "^/", problem)

    def answer_to(self, asset):
        """(what came of it, where, what was said)"""
        reply = self.upload(asset)
        if reply.status not in (200, 201):
            self.assert_told(reply)
            problem = reply.json()["problems"][0]
            return f"{reply.status} {problem['code']}", problem["pointer"], problem["detail"]
        warnings = reply.json()["warnings"]
        if asset["validator"]["error_codes"]:
            self.assertTrue(warnings, "it violates glTF, is accepted, and nothing is said")
            # Of what is never drawn, as points, the data are not looked at.
            if not any("not drawn" in warning for warning in warnings):
                self.assert_told(self.upload(asset, "/v1/scenes?strict=true"))
        frame = self.server.frame(reply.json()["id"], SMALL)
        self.assertIn(frame.status, (200, 400, 422), frame.body[:300])
        if frame.status != 200:
            return f"loads, {frame.status}", "", frame.json()["problems"][0]["detail"]
        return "drawn", "", "; ".join(warnings)

    def test_each_is_refused_or_drawn(self):
        assets = json.loads(MANIFEST.read_text())["bad"]
        listed = {file for asset in assets for file in asset["files"]}
        on_disk = {str(path.relative_to(ASSETS)) for path in (ASSETS / "bad").rglob("*.gl*")}
        self.assertEqual(on_disk - listed, set(), "every file is held")
        table = []
        for asset in assets:
            with self.subTest(asset["path"]):
                table.append((asset["path"].removeprefix("bad/"), asset["expect_hint"], *self.answer_to(asset)))
        print()
        for path, hint, answer, pointer, said in table:
            print(f"{path:58} {hint:17} {answer:23} {pointer} {said}"[:220])
        self.assertEqual(len(table), len(assets))
        print(f"{len(table)} files, {sum(row[2] == 'drawn' for row in table)} drawn, the others refused")
        self.assertEqual(self.server.frame(self.server.upload("box_on_plane"), SMALL).status, 200)


if __name__ == "__main__":
    unittest.main()

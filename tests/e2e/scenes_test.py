"""Scenes over HTTP: uploads in every form, names, listing, removal, and what a restart finds again."""

import hashlib
import json
import tempfile
import unittest
from pathlib import Path

from shipped_server import SCENES, SMALL, Server, ServerTest, form

GLB = {"Content-Type": "model/gltf-binary"}


def split_glb(glb):
    """(glTF JSON as a dict, binary) of a GLB."""
    length = int.from_bytes(glb[12:16], "little")
    return json.loads(glb[20 : 20 + length]), glb[28 + length :]


class Scenes(ServerTest):
    def setUp(self):
        self.glb = (SCENES / "box_on_plane.glb").read_bytes()
        self.id = hashlib.sha256(self.glb).hexdigest()
        self.server.ask("DELETE", f"/v1/scenes/{self.id}")

    def test_an_upload_is_new_once(self):
        first = self.server.ask("POST", "/v1/scenes", self.glb, GLB)
        self.assertEqual(first.status, 201)
        self.assertEqual(first.headers["Location"], f"/v1/scenes/{self.id}")
        summary = first.json()
        self.assertEqual((summary["id"], summary["bytes"], summary["triangles"]), (self.id, len(self.glb), 14))
        second = self.server.ask("POST", "/v1/scenes", self.glb, GLB)
        self.assertEqual((second.status, second.json()), (200, summary))
        self.assertEqual(self.server.get(f"/v1/scenes/{self.id}").json(), summary)

    def test_put_holds_the_bytes_against_the_name(self):
        self.assertEqual(self.server.ask("PUT", f"/v1/scenes/{self.id}", self.glb, GLB).status, 201)
        self.assertEqual(self.server.ask("PUT", f"/v1/scenes/{self.id}", self.glb, GLB).status, 200)
        wrong = "0" * 64
        self.assert_problem(self.server.ask("PUT", f"/v1/scenes/{wrong}", self.glb, GLB), 422)
        self.assertEqual(self.server.ask("HEAD", f"/v1/scenes/{wrong}").status, 404)
        self.assert_problem(self.server.ask("PUT", "/v1/scenes/abc", self.glb, GLB), 400, "id")

    def test_its_nodes_come_in_pages(self):
        self.server.upload("box_on_plane")
        path = f"/v1/scenes/{self.id}/nodes"
        whole = self.server.get(path).json()
        self.assertNotIn("next", whole)
        self.assertEqual([node["node"] for node in whole["nodes"]], list(range(len(whole["nodes"]))))
        self.assertEqual(sum(node["triangles"] for node in whole["nodes"]), 14)
        first = self.server.get(path + "?limit=1").json()
        rest = self.server.get(f"{path}?after={first['next']}").json()
        self.assertEqual(first["nodes"] + rest["nodes"], whole["nodes"])
        for query in ("limit=0", "limit=10001", "after=-1", "after=x", "limit=1&limit=1", "first=1"):
            self.assert_problem(self.server.get(f"{path}?{query}"), 400, "/" + query.split("=")[0])
        self.assert_problem(self.server.get(f"/v1/scenes/{'0' * 64}/nodes"), 404, "id")

    def test_head_tells_existence_without_a_body(self):
        self.assertEqual(self.server.ask("HEAD", f"/v1/scenes/{self.id}").status, 404)
        self.server.upload("box_on_plane")
        reply = self.server.ask("HEAD", f"/v1/scenes/{self.id}")
        self.assertEqual((reply.status, reply.body), (200, b""))

    def test_delete_removes(self):
        self.server.upload("box_on_plane")
        self.assertIn(self.id, [scene["id"] for scene in self.server.get("/v1/scenes").json()["scenes"]])
        self.assertEqual(self.server.ask("DELETE", f"/v1/scenes/{self.id}").status, 204)
        self.assert_problem(self.server.ask("DELETE", f"/v1/scenes/{self.id}"), 404, "id")
        self.assert_problem(self.server.get(f"/v1/scenes/{self.id}"), 404)
        self.assert_problem(self.server.frame(self.id, SMALL), 404, "id")

    def test_a_gltf_with_its_files_comes_as_a_form(self):
        gltf, binary = split_glb(self.glb)
        gltf["buffers"][0]["uri"] = "data/box%20one.bin"
        model = json.dumps(gltf).encode()
        binary = binary[: gltf["buffers"][0]["byteLength"]]
        names = [
            [("scene", "box.gltf", model), ("file", "data/box one.bin", binary)],
            [("scene", None, model), ("data/box one.bin", "whatever", binary)],
        ]
        ids = set()
        for parts in names:
            body, content_type = form(parts)
            reply = self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})
            self.assertIn(reply.status, (200, 201), reply.body)
            self.assertEqual(reply.json()["triangles"], 14)
            ids.add(reply.json()["id"])
        self.assertEqual(len(ids), 1)
        self.assertEqual(self.server.frame(ids.pop(), SMALL).status, 200)

    def test_a_form_must_bring_what_the_model_names_and_nothing_outside(self):
        gltf, binary = split_glb(self.glb)
        for uri in ("missing.bin", "../box.bin", "/etc/passwd", "file:///etc/passwd", "http://127.0.0.1/x"):
            gltf["buffers"][0]["uri"] = uri
            body, content_type = form([("scene", "a.gltf", json.dumps(gltf).encode()), ("file", "box.bin", binary)])
            reply = self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type})
            self.assertIn(reply.status, (400, 422), uri)
            self.assert_problem(reply, reply.status)
        body, content_type = form([("scene", "a.glb", self.glb), ("file", "../../x", b"x")])
        self.assert_problem(self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type}), 400, "file")
        body, content_type = form([("model", "a.glb", self.glb)])
        self.assert_problem(self.server.ask("POST", "/v1/scenes", body, {"Content-Type": content_type}), 400, "scene")

    def test_what_violates_gltf_is_repaired_or_refused_as_the_upload_asks(self):
        longer = self.glb + b"past the end"
        repaired = self.server.ask("POST", "/v1/scenes", longer, GLB)
        self.assertEqual(repaired.status, 201)
        warnings = repaired.json()["warnings"]
        self.assertIn("after its end", " ".join(warnings))
        name = hashlib.sha256(longer).hexdigest()
        reports = [self.server.frame(name, SMALL, "application/json").json()["report"]]
        shot = [("scene", "scene", longer), ("spec", None, json.dumps(SMALL).encode())]
        body, kind = form(shot)
        once = self.server.ask("POST", "/v1/render", body, {"Content-Type": kind, "Accept": "application/json"})
        reports.append(once.json()["report"])
        for report in reports:
            self.assertEqual(report["warnings"][: len(warnings)], warnings)

        strict_form, strict_kind = form([*shot, ("strict", None, b"true")])
        for method, path, content, content_type in (
            ("POST", "/v1/scenes?strict=true", longer, GLB["Content-Type"]),
            ("PUT", f"/v1/scenes/{name}?strict=true", longer, GLB["Content-Type"]),
            ("POST", "/v1/render?strict=true", body, kind),
            ("POST", "/v1/render", strict_form, strict_kind),
        ):
            refused = self.server.ask(method, path, content, {"Content-Type": content_type})
            self.assert_problem(refused, 422)
            self.assertIn("after its end", refused.json()["problems"][0]["detail"])
        self.assertEqual(self.server.get(f"/v1/scenes/{name}").status, 200, "who wants it repaired has it")
        self.assertEqual(self.server.ask("POST", "/v1/scenes?strict=true", self.glb, GLB).status, 201)
        self.assertEqual(self.server.ask("POST", "/v1/scenes?strict=true", self.glb, GLB).status, 200)
        self.assertEqual(self.server.ask("POST", "/v1/scenes?strict=false", longer, GLB).status, 200)
        self.assert_problem(self.server.ask("POST", "/v1/scenes?strict=1", self.glb, GLB), 400, "/strict")

    def test_other_types_are_refused(self):
        for content_type in ("application/octet-stream", "text/plain", "application/json"):
            reply = self.server.ask("POST", "/v1/scenes", self.glb, {"Content-Type": content_type})
            self.assert_problem(reply, 415)
        self.assert_problem(self.server.ask("POST", "/v1/scenes", self.glb, GLB | {"Content-Encoding": "gzip"}), 415)

    def test_an_empty_or_broken_model_is_refused(self):
        self.assert_problem(self.server.ask("POST", "/v1/scenes", b"", GLB), 400)
        self.assert_problem(self.server.ask("POST", "/v1/scenes", self.glb[:-100], GLB), 400)


class Store(unittest.TestCase):
    def test_a_restart_finds_the_scenes_and_draws_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as store:
            with Server("--store", store) as server:
                scene = server.upload("box_on_plane")
                summary = server.get(f"/v1/scenes/{scene}").json()
                before = server.frame(scene, SMALL)
                self.assertEqual(server.end(), 0)
            self.assertEqual(sorted(path.suffix for path in Path(store).iterdir()), [".bundle", ".json"])
            with Server("--store", store) as server:
                self.assertEqual(server.get("/v1/scenes").json()["scenes"], [summary])
                after = server.frame(scene, SMALL)
                self.assertEqual((after.status, after.body), (200, before.body))
                self.assertEqual(server.frame(scene, SMALL, If_None_Match=before.headers["ETag"]).status, 304)
                self.assertEqual(server.end(), 0)

    def test_damaged_bytes_are_told_and_not_served(self):
        with tempfile.TemporaryDirectory() as store:
            with Server("--store", store) as server:
                scene = server.upload("box_on_plane")
                self.assertEqual(server.end(), 0)
            bundle = Path(store) / f"{scene}.bundle"
            bundle.write_bytes(bundle.read_bytes()[:-1] + b"x")
            with Server("--store", store) as server:
                self.assertEqual(server.frame(scene, SMALL).status, 404)
                self.assertTrue(server.log_has("do not match"))
                server.upload("box_on_plane")
                self.assertEqual(server.frame(scene, SMALL).status, 200)
                self.assertEqual(server.end(), 0)


if __name__ == "__main__":
    unittest.main()

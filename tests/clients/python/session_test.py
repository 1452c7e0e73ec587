"""The Python client against the shipped server: frames as arrays, plans, evaluations, bakes, scenes."""

import base64
import contextlib
import io
import json
import os
import struct
import unittest
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

import numpy as np
from environments import RED
from shipped_server import BINARY, EXR_MAGIC, SCENES, ServerTest

import gnomon
from gnomon import png, transport

BOX = SCENES / "box_on_plane.glb"
SMALL = {"width": 64, "height": 48}


def glb_parts():
    """The JSON and the buffer of the scene."""
    content = BOX.read_bytes()
    length = struct.unpack_from("<I", content, 12)[0]
    return json.loads(content[20:20 + length]), content[28 + length:]


def write_gltf(path, uri, name, change=lambda gltf: None):
    """The scene with its buffer in a file beside it, or as a data: URI, or, without a name, nowhere."""
    gltf, data = glb_parts()
    change(gltf)
    gltf["buffers"][0]["uri"] = uri if uri != "data:" else "data:;base64," + base64.b64encode(data).decode()
    if name:
        (path.parent / name).parent.mkdir(exist_ok=True)
        (path.parent / name).write_bytes(data)
    path.write_text(json.dumps(gltf))
    return path


class SessionTest(ServerTest):
    flags = ("--device", "cpu")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.url = "http://{}:{}".format(*cls.server.address)
        cls.session = gnomon.Session(cls.url)
        cls.addClassCleanup(cls.session.close)


class Frames(SessionTest):
    def test_the_usual_views_are_arrays(self):
        frame = self.session.frame(BOX, sun=(135, 40), **SMALL)
        for view, dtype, shape in (("color", np.uint8, (48, 64, 3)), ("depth", np.float32, (48, 64)),
                                   ("ids", np.int32, (48, 64)), ("shadow", np.float32, (48, 64))):
            values = getattr(frame, view)
            self.assertEqual((values.dtype, values.shape), (dtype, shape), view)
        seen = frame.ids >= 0
        self.assertTrue(0 < seen.sum() < seen.size)
        np.testing.assert_array_equal(np.isfinite(frame.depth), seen)
        self.assertEqual(set(np.unique(frame.ids[seen])), {0, 2})
        self.assertTrue(0 < (frame.shadow < 0.5).sum() < 0.5 * seen.sum())
        self.assertEqual(frame.size, (64, 48))
        self.assertEqual(frame.report["spec"]["lights"][0]["sun"]["azimuthDegrees"], 135)
        self.assertIn("shade", frame.timings)
        self.assertIn("color, depth, ids, shadow", repr(frame))

    def test_colors_are_those_of_the_png(self):
        frame = self.session.frame(BOX, views=["color"], **SMALL)
        np.testing.assert_array_equal(frame.color, png.decode(self.session.picture(BOX, **SMALL)))
        np.testing.assert_array_equal(frame.color, png.decode(frame._repr_png_()))

    def test_colors_can_be_linear(self):
        frame = self.session.frame(BOX, views=["color"], output={"arrayColors": "linear"}, **SMALL)
        self.assertEqual((frame.color.dtype, frame.color.shape), (np.float32, (48, 64, 3)))

    def test_a_view_that_was_not_asked_for_is_told(self):
        frame = self.session.frame(BOX, views=["depth", "normal"], **SMALL)
        self.assertEqual(frame.normal.shape, (48, 64, 3))
        with self.assertRaisesRegex(AttributeError, "no 'color'; its views are depth, normal"):
            frame.color

    def test_positions_lie_on_the_rays_of_the_camera(self):
        eye = np.array((3.0, 4.0, 9.0))
        camera = gnomon.camera.look_at(eye, (0, 1, 0), fovYDegrees=40)
        frame = self.session.frame(BOX, camera=camera, views=["depth", "position"], **SMALL)
        seen = np.isfinite(frame.depth)
        forward = (np.array((0, 1, 0)) - eye) / np.linalg.norm(np.array((0, 1, 0)) - eye)
        np.testing.assert_allclose(((frame.position[seen] - eye) @ forward), frame.depth[seen], rtol=1e-4)

    def test_a_pose_and_a_calibration_show_what_look_at_shows(self):
        eye, target = (12, 9, 20), (0, 1, 0)
        focal = 24 / np.tan(np.radians(20))
        K = [[focal, 0, 31.5], [0, focal, 23.5], [0, 0, 1]]
        wanted = png.decode(self.session.picture(BOX, camera=gnomon.camera.look_at(eye, target, fovYDegrees=40), **SMALL))
        usual = png.decode(self.session.picture(BOX, **SMALL))
        self.assertGreater(np.abs(usual.astype(int) - wanted).mean(), 1)
        for axes in ("opencv", "opengl"):
            camera = gnomon.camera.from_pose(gnomon.camera.pose(eye, target, axes=axes), axes, K)
            found = png.decode(self.session.picture(BOX, camera=camera, **SMALL))
            self.assertLess(np.abs(found.astype(int) - wanted).mean(), 0.5, axes)

    def test_a_node_stands_where_a_matrix_puts_it(self):
        place = np.eye(4)
        place[:3, 3] = (1.5, 0, -2)
        before = self.session.frame(BOX, views=["ids", "position"], **SMALL)
        for matrix in (place, place.T.ravel(), place.astype(np.float32)):
            node = gnomon.spec.NodeOptions(node=2, matrix=matrix)
            after = self.session.frame(BOX, nodes=[node], views=["ids", "position"], **SMALL)
            box = [frame.position[frame.ids == 2] for frame in (before, after)]
            self.assertGreater(len(box[1]), 10)
            for one, other in ((box[0].min(0), box[1].min(0)), (box[0].max(0), box[1].max(0))):
                np.testing.assert_allclose(other - one, (1.5, 0, -2), atol=0.4)

    def test_motion_is_that_of_the_camera(self):
        old, new = (gnomon.camera.look_at((x, 5, 12), (x, 1, 0), fovYDegrees=40) for x in (0, 0.5))
        still = self.session.frame(BOX, camera=new, views=["motion", "depth"], motionFrom={"camera": new}, **SMALL)
        self.assertEqual((still.motion.dtype, still.motion.shape), (np.float32, (48, 64, 2)))
        seen = np.isfinite(still.depth)
        np.testing.assert_allclose(still.motion[seen], 0, atol=1e-3)
        moved = self.session.frame(BOX, camera=new, views=["motion", "depth"], motionFrom={"camera": old}, **SMALL)
        focal = 24 / np.tan(np.radians(20))
        np.testing.assert_allclose(np.abs(moved.motion[seen][:, 0]), focal * 0.5 / moved.depth[seen], rtol=0.01)
        np.testing.assert_allclose(moved.motion[seen][:, 1], 0, atol=0.01)

    def test_the_digest_of_a_frame_is_checked(self):
        scene = self.session.upload(BOX)
        with mock.patch("gnomon.transport.check_digest", side_effect=transport.check_digest) as check:
            self.session.picture(scene, **SMALL)
        header, content = check.call_args.args
        self.assertRegex(header, "^sha-256=:.{44}:$")
        with self.assertRaises(gnomon.DigestMismatch):
            transport.check_digest(header, content + b"x")

    def test_frames_are_saved_in_every_format(self):
        frame = self.session.frame(BOX, views=["color", "depth"], **SMALL)
        starts = {".png": png.SIGNATURE, ".exr": EXR_MAGIC, ".tiff": b"II", ".jpg": b"\xff\xd8", ".webp": b"RIFF",
                  ".npy": b"\x93NUMPY", ".npz": b"PK"}
        with TemporaryDirectory() as folder:
            for suffix, start in starts.items():
                path = Path(folder) / f"frame{suffix}"
                frame.save(path)
                self.assertEqual(path.read_bytes()[:len(start)], start, suffix)
            again = gnomon.read_frame((Path(folder) / "frame.npz").read_bytes())
            np.testing.assert_array_equal(again.depth, frame.depth)
            frame.save(Path(folder) / "depth.npy", "depth")
            np.testing.assert_array_equal(np.load(Path(folder) / "depth.npy"), frame.depth)
            with self.assertRaisesRegex(ValueError, ".npz .png"):
                frame.save(Path(folder) / "frame.bmp")

    def test_labels_are_added_to_a_saved_frame(self):
        frame = self.session.frame(BOX, views=["color", "depth"], **SMALL)
        labelled = np.load(io.BytesIO(frame.npz(K=np.eye(3), label=7)))
        self.assertEqual(labelled.files, [*np.load(io.BytesIO(frame.npz())).files, "K", "label"])
        np.testing.assert_array_equal(labelled["K"], np.eye(3))
        self.assertEqual(labelled["label"], 7)
        np.testing.assert_array_equal(labelled["depth"], frame.depth)
        with self.assertRaisesRegex(ValueError, "'depth' is a view"):
            frame.npz(depth=[1])

    def test_render_finds_or_starts_a_server(self):
        here = gnomon.render(BOX, sun=(135, 40), server=self.url, **SMALL)
        with mock.patch.dict(os.environ, {"GNOMON_SERVER": self.url}):
            found = gnomon.render(str(BOX), sun=(135, 40), **SMALL)
        np.testing.assert_array_equal(here.color, found.color)
        with gnomon.Session(binary=BINARY, flags=["--device", "cpu"]) as own:
            self.assertNotEqual(own.url, self.url)
            np.testing.assert_array_equal(own.frame(BOX, sun=(135, 40), **SMALL).color, here.color)

    def test_a_program_that_is_missing_is_told(self):
        with mock.patch.dict(os.environ, {"GNOMON_BINARY": "/nowhere/gnomon"}):
            with self.assertRaisesRegex(FileNotFoundError, "GNOMON_BINARY"):
                gnomon.Session()
        with self.assertRaisesRegex(RuntimeError, "--no-such-flag"):
            gnomon.Session(binary=BINARY, flags=["--no-such-flag"])


class Scenes(SessionTest):
    def test_a_scene_is_uploaded_once(self):
        first = self.session.upload(BOX)
        self.assertEqual(first.summary["nodes"], 3)
        self.assertEqual(self.session.upload(BOX.read_bytes()), first)
        uploads = [line for line in self.server.settled_log().splitlines() if '"PUT"' in line and first.id in line]
        self.assertEqual(len(uploads), 1, uploads)
        self.assertEqual(self.session.scene(first), first.summary)
        self.assertIn(first.id, [scene["id"] for scene in self.session.list()])

    def test_a_gltf_brings_the_files_beside_it(self):
        expected = self.session.frame(BOX, **SMALL)
        with TemporaryDirectory() as folder:
            for number, (uri, name) in enumerate({
                    "box.bin": "box.bin",
                    "./box.bin": "box.bin",
                    "my%20data/the%20box.bin": "my data/the box.bin",
                    "my data/the other box.bin": "my data/the other box.bin",
                    "b%C3%BCro/100%25.bin": "b\u00fcro/100%.bin",
                    "say%20%22hi%22;.bin": 'say "hi";.bin',
                    "data:": None,
            }.items()):
                with self.subTest(uri):
                    model = write_gltf(Path(folder) / f"a model {number}.gltf", uri, name)
                    np.testing.assert_array_equal(self.session.frame(model, **SMALL).color, expected.color)

    def test_a_model_that_violates_gltf_is_repaired_or_refused(self):
        conforming = SCENES / "cameras.glb"
        longer = conforming.read_bytes() + b"past the end"
        with self.assertWarnsRegex(gnomon.GnomonWarning, "after its end"):
            scene = self.session.upload(longer)
        self.assertEqual(self.session.frame(scene, **SMALL).report["warnings"][0], scene.summary["warnings"][0])
        for _ in range(2):
            with self.assertRaisesRegex(gnomon.BadRequest, "after its end"):
                self.session.upload(longer, strict=True)
            self.assertEqual(self.session.upload(conforming, strict=True).summary["warnings"], [])
        with self.assertRaisesRegex(gnomon.BadRequest, "after its end"):
            gnomon.render(longer, strict=True, server=self.url, **SMALL)
        with self.assertRaisesRegex(ValueError, "strict"):
            gnomon.render(scene, strict=True, server=self.url, **SMALL)
        self.assertEqual(gnomon.render(conforming, strict=True, server=self.url, **SMALL).color.shape, (48, 64, 3))

    def test_files_outside_of_a_models_folder_are_sent_where_that_is_allowed(self):
        expected = self.session.frame(BOX, **SMALL)
        with TemporaryDirectory() as folder:
            (Path(folder) / "model").mkdir()
            model = write_gltf(Path(folder) / "model" / "box.gltf", "..\\data\\box.bin", "../data/box.bin")
            with self.assertRaisesRegex(ValueError, "allow_outside_files"):
                self.session.upload(model)
            with self.assertWarnsRegex(gnomon.GnomonWarning, "backslash"):
                scene = self.session.upload(model, allow_outside_files=True)
        np.testing.assert_array_equal(self.session.frame(scene, **SMALL).color, expected.color)

    def test_a_file_beside_a_gltf_that_changes_is_seen(self):
        with TemporaryDirectory() as folder:
            model = write_gltf(Path(folder) / "box.gltf", "maps/box.bin", "maps/box.bin")
            before = self.session.frame(model, views=["ids"], **SMALL)
            self.assertEqual(self.session.scene(model)["id"], self.session.upload(model).id)
            data = Path(folder) / "maps" / "box.bin"
            content = np.frombuffer(data.read_bytes(), np.uint8).copy()
            data.write_bytes(bytes(len(content)))
            after = self.session.frame(model, views=["ids"], **SMALL)
            self.assertTrue((before.ids >= 0).any())
            self.assertFalse((after.ids >= 0).any())

    def test_a_file_that_is_not_beside_a_gltf_is_named(self):
        with TemporaryDirectory() as folder:
            model = write_gltf(Path(folder) / "box.gltf", "box.bin", None)
            with self.assertRaisesRegex(gnomon.BadRequest, '/buffers/0/uri: .*"box.bin"'):
                self.session.frame(model, **SMALL)

    def test_an_environment_is_one_of_the_files_of_an_upload(self):
        scene = self.session.upload(BOX, {"red.hdr": RED})
        self.assertEqual(scene.summary["environmentFiles"], ["red.hdr"])
        lit = self.session.frame(scene, SMALL | {"environment": {"file": "red.hdr"}, "lights": []}).color
        red, _, blue = lit[..., :3].reshape(-1, 3).astype(float).mean(axis=0)
        self.assertGreater(red, blue + 10)
        with self.assertRaises(gnomon.BadRequest):
            self.session.frame(BOX, SMALL | {"environment": {"file": "red.hdr"}})

    def test_nodes_have_their_names(self):
        nodes = [*self.session.nodes(BOX)]
        self.assertEqual([each["node"] for each in nodes], [0, 1, 2])
        frame = self.session.frame(BOX, views=["ids", "casterIds"], sun=(135, 40), **SMALL)
        self.assertEqual(frame.names, {-1: "", **{each["node"]: each["name"] for each in nodes}})
        self.assertEqual({frame.names[each] for each in np.unique(frame.ids)}, {"", "ground", "box"})
        with mock.patch("gnomon.scene_calls.NODES_ON_PAGE", 2):
            self.assertEqual([*self.session.nodes(BOX)], nodes)
        for each in self.session.sequence(BOX, frames=[{}], **SMALL):
            self.assertEqual(each.names, frame.names)

    def test_what_is_odd_is_warned_of_once(self):
        def told(call):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
            self.assertTrue(all(each.category is gnomon.GnomonWarning and each.filename == __file__ for each in caught))
            return [str(each.message) for each in caught]

        def with_too_much(gltf):
            first = len(gltf["nodes"])
            gltf["extensionsUsed"] = ["EXT_unheard_of", "KHR_lights_punctual"]
            gltf["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
            gltf["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": 0}}} for _ in range(300)]
            gltf["scenes"][0]["nodes"] += list(range(first, first + 300))

        with TemporaryDirectory() as folder:
            path = write_gltf(Path(folder) / "lights.gltf", "data:", None, with_too_much)
            with gnomon.Session(self.url) as session:
                of_scene = told(lambda: session.upload(path))
                self.assertTrue(any("EXT_unheard_of" in each for each in of_scene), of_scene)
                self.assertEqual(sorted(of_scene), sorted(session.scene(path)["warnings"]))
                of_frame = told(lambda: session.frame(path, **SMALL))
                self.assertTrue(any("300 lights" in each for each in of_frame), of_frame)
                self.assertTrue(set(of_frame).isdisjoint(of_scene))
                self.assertEqual(told(lambda: session.frame(path, **SMALL)), [])
                self.assertEqual(told(lambda: session.upload(path)), [])
                self.assertEqual(told(lambda: session.plan(path, **SMALL)), [])
                self.assertEqual(told(lambda: [*session.sequence(path, frames=[{}], **SMALL)]), [])
            with gnomon.Session(self.url) as session:
                found = told(lambda: [*session.sequence(path, frames=[{}, {}], **SMALL)])
                self.assertEqual(sorted(found), sorted(of_scene + of_frame))

    def test_a_deleted_scene_is_gone(self):
        scene = self.session.upload(SCENES / "pebble.glb")
        self.session.delete(scene)
        with self.assertRaises(gnomon.NotFound):
            self.session.picture(scene.id, **SMALL)

    def test_an_animated_plan_and_its_capabilities(self):
        plan = self.session.plan(BOX, shadow={"cascadeCount": 2}, **SMALL)
        self.assertEqual(len(plan["lights"][0]["tiles"]), 2)
        self.assertRegex(self.session.capabilities()["renderer"]["fingerprint"], "^[0-9a-f]{16}$")

    def test_problems_have_their_places(self):
        with self.assertRaises(gnomon.BadRequest) as caught:
            self.session.frame(BOX, width=0, shadow={"cascadeCount": 99})
        problem = caught.exception
        self.assertEqual(problem.status, 400)
        self.assertEqual([(each.pointer, each.limit, each.actual) for each in problem.problems],
                         [("/width", "1..16384", "0"), ("/shadow/cascadeCount", "1..8", "99")])
        self.assertIn("/width: This is out of range. Accepted: 1..16384. Given: 0.", str(problem))
        with self.assertRaises(gnomon.BadRequest) as caught:
            self.session.upload(b"{}")
        self.assertEqual(caught.exception.status, 422)

    def test_a_large_refused_body_still_tells_why(self):
        with self.assertRaises(gnomon.TooLarge):
            self.session.upload(b"glTF" + bytes(300 << 20))


class LongWork(SessionTest):
    def test_an_evaluation_is_a_table(self):
        variants = [{"shadow": {"filter": {"type": "hard"}}}, {"shadow": {"cascadeCount": 0}}]
        with self.assertRaises(gnomon.BadRequest) as caught:
            self.session.evaluate(BOX, variants=variants, repeats=1, **SMALL)
        self.assertIn("/variants/1/shadow/cascadeCount", [each.pointer for each in caught.exception.problems])
        rows = self.session.evaluate(BOX, variants=variants[:1], repeats=1, **SMALL)
        self.assertEqual(len(rows), 1)
        self.assertEqual(rows[0]["name"], "filter.type hard")
        self.assertGreater(rows[0]["milliseconds"], 0)
        self.assertGreater(rows[0]["stages.shadow"], 0)
        self.assertIn("misclassified", rows[0])
        self.assertEqual(rows.report["rows"][0]["metrics"]["misclassified"], rows[0]["misclassified"])

    def test_progress_is_shown_where_it_is_wanted(self):
        for wanted in (True, False):
            with gnomon.Session(self.url, progress=wanted) as session, contextlib.redirect_stderr(io.StringIO()) as shown:
                session.evaluate(BOX, variants=[{}, {"shadow": {"cascadeCount": 1}}], repeats=1, **SMALL)
            self.assertEqual("evaluating" in shown.getvalue(), wanted)

    def test_a_bake_is_kept_under_its_key(self):
        spec = {"lights": [{"sun": {}}], "shadow": {"technique": "lightMap", "lightMap": {"size": 64, "samples": 4}}}
        report = self.session.bake(BOX, spec)
        self.assertEqual(self.session.baked(BOX, report["key"])[:4], b"glTF")
        self.assertEqual(self.session.baked(BOX, report["key"], "image/png", light=0)[:8], png.SIGNATURE)


class Orbits(SessionTest):
    def test_the_widget_asks_for_frames_that_the_server_draws(self):
        widget = gnomon.orbit(self.session, BOX, sun=(135, 40), shadow={"cascadeCount": 2}, width=64, height=48)
        self.assertIn(widget.address, widget._repr_html_())
        path = widget.address[len(self.url):]
        reply = self.server.get(path + "&width=64&height=48&camera.orbit.azimuthDegrees=90.00")
        self.assertEqual((reply.status, reply.body[:8]), (200, png.SIGNATURE), reply.body[:300])


if __name__ == "__main__":
    unittest.main()

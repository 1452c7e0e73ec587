"""The parts of the Python client that need no server."""

import base64
import hashlib
import io
import json
import pickle
import struct
import unittest
import warnings
import zipfile
import zlib
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import gnomon
from gnomon import bundle, camera, golden, json_form, png, problems, spec, streams, webm
from gnomon.picture import picture_of
from gnomon.transport import check_digest
from gnomon.warned import Warned

RANDOM = np.random.default_rng(7)


def filtered_png(picture, kind):
    """A PNG with every row filtered by that kind, computed byte by byte as the standard has it."""
    height, width, channels = picture.shape
    rows = b""
    for y in range(height):
        row = bytearray([kind])
        for x in range(width):
            for c in range(channels):
                left = int(picture[y, x - 1, c]) if x else 0
                above = int(picture[y - 1, x, c]) if y else 0
                corner = int(picture[y - 1, x - 1, c]) if x and y else 0
                nearest = min((abs(above - corner), 0, left), (abs(left - corner), 1, above),
                              (abs(left + above - 2 * corner), 2, corner))[2]
                row.append((int(picture[y, x, c]) - [0, left, above, (left + above) // 2, nearest][kind]) & 255)
        rows += bytes(row)
    head = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    return png.SIGNATURE + png._chunk(b"IHDR", head) + png._chunk(b"IDAT", zlib.compress(rows)) + png._chunk(b"IEND", b"")


class Png(unittest.TestCase):
    def test_what_is_written_is_read_again(self):
        for shape in ((1, 1), (5, 7), (5, 7, 3), (4, 9, 4)):
            picture = RANDOM.integers(0, 256, shape, dtype=np.uint8)
            np.testing.assert_array_equal(png.decode(png.encode(picture)), picture)

    def test_every_filter_is_read(self):
        for channels in (1, 3, 4):
            picture = RANDOM.integers(0, 256, (6, 5, channels), dtype=np.uint8)
            for kind in range(5):
                read = png.decode(filtered_png(picture, kind))
                np.testing.assert_array_equal(read.reshape(picture.shape), picture, f"filter {kind}")

    def test_what_is_no_such_png_is_refused(self):
        whole = png.encode(np.zeros((2, 2, 3), np.uint8))
        for data in (b"", b"GIF89a", whole[:20], whole[:45], whole.replace(b"\x00\x00\x00\x02", b"\x00\x00\x00\x03", 1)):
            with self.assertRaises(ValueError):
                png.decode(data)
        with self.assertRaisesRegex(ValueError, "uint8"):
            png.encode(np.zeros((2, 2, 3)))


class VideoName(unittest.TestCase):
    def test_it_ends_in_webm(self):
        for name in ("turn.webm", "turn.WEBM", Path("out") / "turn.webm"):
            webm.check_video_name(name)
        for name in ("x.mp4", "x", "webm", Path("x.webm.mp4")):
            with self.assertRaisesRegex(ValueError, r"ends in \.webm"):
                webm.check_video_name(name)


class JsonForm(unittest.TestCase):
    def test_dataclasses_leave_none_out_and_dicts_keep_it(self):
        asked = json_form.frame_spec(spec.FrameSpec(width=np.int64(8), lights=[spec.Light(sun=spec.Sun(1, 2))]),
                                     camera={"node": None}, height=4)
        self.assertEqual(asked, {"width": 8, "height": 4, "camera": {"node": None},
                                 "lights": [{"sun": {"azimuthDegrees": 1, "elevationDegrees": 2}}]})

    def test_the_sun_is_short_for_a_light(self):
        light = {"sun": {"azimuthDegrees": 135, "elevationDegrees": 40}}
        self.assertEqual(json_form.frame_spec(sun=(135, 40)), {"lights": [light]})
        with self.assertRaises(TypeError):
            json_form.frame_spec(sun=(135, 40), lights=[])

    def test_the_sun_is_two_numbers(self):
        for sun in ((135, 40), [135, 40], np.array([135, 40]), (np.float32(135), np.int64(40))):
            light, = json_form.frame_spec(sun=sun)["lights"]
            self.assertEqual(light["sun"], {"azimuthDegrees": 135, "elevationDegrees": 40})
        for wrong in ("135,40", "12", (1, 2, 3), (1,), 135, (1, "2"), (None, 2), {"azimuthDegrees": 1}):
            with self.assertRaisesRegex(ValueError, "sun is .azimuth, elevation. in degrees"):
                json_form.frame_spec(sun=wrong)

    def test_an_unknown_field_is_told_with_the_known_ones(self):
        with self.assertRaisesRegex(TypeError, "no widht; it has .*width"):
            json_form.frame_spec(widht=4)
        with self.assertRaises(TypeError):
            spec.Sun(azimuth=3)

    def test_a_matrix_of_a_node_goes_column_by_column(self):
        matrix = np.arange(16.0).reshape(4, 4)
        made = json_form.to_json(spec.NodeOptions(node=0, matrix=matrix))
        self.assertEqual(made["matrix"], [0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15])
        flat = [float(each) for each in range(16)]
        self.assertEqual(json_form.to_json(spec.NodeOptions(node=0, matrix=flat))["matrix"], flat)

    def test_numbers_that_json_lacks_are_refused(self):
        with self.assertRaises(ValueError):
            json_form.encoded({"exposure": float("nan")})


class Cameras(unittest.TestCase):
    def test_a_pose_looks_at_its_target(self):
        for axes, forward in (("opencv", (0, 0, 1)), ("opengl", (0, 0, -1))):
            pose = camera.pose((1, 2, 3), (4, 0, -3), axes=axes)
            np.testing.assert_allclose(pose[:3, :3] @ forward, np.array((3, -2, -6)) / 7)
            np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
            self.assertAlmostEqual(np.linalg.det(pose[:3, :3]), 1)
            np.testing.assert_allclose(pose[:3, 3], (1, 2, 3))
        self.assertGreater((camera.pose((0, 0, 5)) @ (0, -1, 0, 0))[1], 0, "OpenCV's y points downwards")

    def test_a_camera_that_looks_nowhere_is_refused(self):
        for eye, target in (((0, 0, 0), (0, 0, 0)), ((0, 5, 0), (0, 0, 0))):
            with self.assertRaises(ValueError):
                camera.pose(eye, target)

    def test_a_calibration_is_scaled_about_the_corner_of_the_picture(self):
        made = camera.intrinsics([[800, 0, 319.5], [0, 820, 239.5], [0, 0, 1]], scale=0.5)
        self.assertEqual((made.fx, made.fy, made.cx, made.cy), (400, 410, 159.5, 119.5))
        for wrong in (np.eye(4), [[800, 1, 0], [0, 800, 0], [0, 0, 1]], [[800, 0, 0], [0, 800, 0], [0, 0, 2]]):
            with self.assertRaises(ValueError):
                camera.intrinsics(wrong)

    def test_a_pose_and_a_calibration_make_a_camera(self):
        made = json_form.to_json(camera.from_pose(np.eye(4), "opengl", [[9, 0, 1], [0, 9, 2], [0, 0, 1]]))
        self.assertEqual(made, {"pose": {"worldFromCamera": np.eye(4).tolist(), "axes": "opengl"},
                                "intrinsics": {"fx": 9, "fy": 9, "cx": 1, "cy": 2}})


class Streams(unittest.TestCase):
    def test_parts_come_with_and_without_a_length(self):
        binary = b"a\r\n--x\r\nb"
        stream = io.BytesIO(b"--x\r\nContent-Type: a/b\r\nContent-Length: %d\r\n\r\n%b\r\n" % (len(binary), binary) +
                            b"--x\r\nContent-Type: c/d\r\n\r\nline\r\nline\r\n--x--\r\n")
        found = [(part.headers.get_content_type(), part.content) for part in streams.parts(stream, "x")]
        self.assertEqual(found, [("a/b", binary), ("c/d", b"line\r\nline")])

    def test_a_reply_that_breaks_off_is_told(self):
        for text in (b"--x\r\nContent-Length: 9\r\n\r\nabc", b"--x\r\nA: b\r\n\r\nabc\r\n"):
            with self.assertRaises(ConnectionError):
                list(streams.parts(io.BytesIO(text), "x"))

    def test_events(self):
        text = b': hello\n\nevent: progress\ndata: {"done":\ndata: 1}\n\nevent: problem\ndata: {"status": 504}\n\n'
        found = streams.events(io.BytesIO(text))
        self.assertEqual(next(found), ("progress", {"done": 1}))
        with self.assertRaises(gnomon.TimedOut):
            next(found)

    def test_a_digest_that_does_not_match_is_told(self):
        digest = base64.b64encode(hashlib.sha256(b"abc").digest()).decode()
        check_digest(f"sha-512=:AAAA:, sha-256=:{digest}:", b"abc")
        check_digest(None, b"abc")
        with self.assertRaises(gnomon.DigestMismatch):
            check_digest(f"sha-256=:{digest}:", b"abd")


class Problems(unittest.TestCase):
    def test_a_reply_of_something_else_is_still_a_problem(self):
        for body in (b"", b"<html>", b"[]", b'{"problems": [1]}', b"\xff"):
            self.assertEqual(problems.problem_from(502, body).status, 502)
        self.assertIn("<html>", str(problems.problem_from(502, b"<html>")))


class Bundles(unittest.TestCase):
    def test_a_model_brings_what_it_names_beside_it_and_nothing_else(self):
        with TemporaryDirectory() as folder:
            (Path(folder) / "my data.bin").write_bytes(b"1234")
            (Path(folder) / "secret").write_bytes(b"secret")
            named = ["my%20data.bin", "data:;base64,AAAA", "../x", "%2e%2e/x", "/nowhere/x", "http://a/x", "c:x",
                     "missing.png", "a%00b", "x" * 5000]
            model = Path(folder) / "a.gltf"
            model.write_text(json.dumps({"buffers": [{"uri": uri} for uri in named]}))
            made = bundle.bundle(model, {"smoke.npy": b"5"})
        self.assertEqual(made.files, {"my data.bin": b"1234", "smoke.npy": b"5"})
        self.assertEqual(made.id, "")

    def test_a_name_is_looked_up_as_the_server_does(self):
        named = {"b.bin": "b.bin", "./c.bin": "c.bin", "a/../d": "d", "maps/e%20f.png": "maps/e f.png",
                 "maps/g h.png": "maps/g h.png", "maps\\h.png": "maps/h.png", "../i.png": "_up/i.png",
                 "a/../../../j.png": "_up/_up/j.png", "/k/../l.png": "_root/l.png", "file:///m%20n.png": "_root/m n.png",
                 "http://a/o.png": None, "a%0Ab": None, "..": None}
        model = json.dumps({"images": [{"uri": uri} for uri in named]}).encode()
        found = bundle.files_beside("models/a.gltf", model)
        self.assertEqual(set(found), {name for name in named.values() if name})
        self.assertEqual(found["maps/h.png"], Path("models/maps/h.png"))
        self.assertEqual(found["_up/i.png"], Path("models/../i.png"))

    def test_files_outside_of_the_models_folder_are_sent_only_where_that_is_allowed(self):
        with TemporaryDirectory() as folder:
            (Path(folder) / "models").mkdir()
            outside = Path(folder) / "outside.png"
            outside.write_bytes(b"1234")
            (Path(folder) / "models" / "link.png").symlink_to(outside)
            model = Path(folder) / "models" / "a.gltf"
            for uri, name in (("../outside.png", "_up/outside.png"), (f"file://{outside}", f"_root{outside}"),
                              (str(outside), f"_root{outside}"), ("link.png", "link.png")):
                model.write_text(json.dumps({"images": [{"uri": uri}]}))
                with self.assertRaisesRegex(ValueError, "allow_outside_files"):
                    bundle.bundle(model)
                self.assertEqual(bundle.bundle(model, allow_outside_files=True).files, {name: b"1234"})

    def test_a_boundary_is_one_that_servers_take(self):
        made = bundle.upload_body(bundle.Bundle(b"{}", {"a.bin": b"1", 'b"c.bin': b"2"}))
        boundary = made.content_type.partition("boundary=")[2]
        self.assertRegex(boundary, "^[0-9a-z-]{1,70}$")  # RFC 2046, 5.1.1
        self.assertEqual(made.content.count(f"--{boundary}\r\n".encode()), 3)
        self.assertIn(b'filename="b%22c.bin"', made.content)

    def test_what_is_no_gltf_names_nothing(self):
        for model in (b"", b"glTF", b"glTF" + bytes(16), b"[]", b'{"buffers": 3}', b'{"buffers": [{"uri": 3}]}'):
            self.assertEqual(bundle.uris(model), [])


class Pictures(unittest.TestCase):
    def test_every_kind_of_view_is_a_picture(self):
        depth = np.array([[1, 3], [2, np.inf]], np.float32)
        self.assertEqual(picture_of("depth", depth).tolist(), [[0, 255], [128, 255]])
        ids = picture_of("ids", np.array([[-1, 0], [0, 1]], np.int32))
        self.assertEqual(ids[0, 0].tolist(), [0, 0, 0])
        self.assertEqual(ids[0, 1].tolist(), ids[1, 0].tolist())
        self.assertNotEqual(ids[0, 1].tolist(), ids[1, 1].tolist())
        self.assertEqual(picture_of("color", np.full((1, 1, 3), 0.2158605, np.float32)).tolist(), [[[128] * 3]])
        for view, shape in (("normal", (2, 2, 3)), ("motion", (2, 2, 2)), ("position", (2, 2, 3)), ("shadow", (2, 2))):
            made = picture_of(view, np.full(shape, np.inf, np.float32))
            png.encode(made)

    def test_a_picture_that_differs_is_shown(self):
        with TemporaryDirectory() as name:
            folder = Path(name)
            picture = np.full((4, 5, 3), 100, np.uint8)
            other = picture.copy()
            other[1, 2] += 10
            stored = folder / "golden" / "box.png"
            with self.assertRaisesRegex(AssertionError, "--gnomon-update"):
                golden.check(picture, stored, folder, golden.Tolerance())
            golden.check(picture, stored, folder, golden.Tolerance(), update=True)
            golden.check(picture, stored, folder, golden.Tolerance())
            golden.check(other, stored, folder, golden.Tolerance(10, 1))
            with self.assertRaisesRegex(AssertionError, "differs by 10 at most and 0.5 in the mean"):
                golden.check(other, stored, folder, golden.Tolerance(9, 1))
            shown = png.decode((folder / "box-diff.png").read_bytes())
            self.assertEqual(shown.shape, (4, 15, 3))
            self.assertEqual(shown[1, [2, 7, 12], 0].tolist(), [110, 100, 80])
            with self.assertRaisesRegex(AssertionError, "shape"):
                golden.check(picture[1:], stored, folder, golden.Tolerance(255, 255))


class Warnings(unittest.TestCase):
    """What is warned of, and where."""

    def told(self, *calls):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for call, scene, *texts in calls:
                call(scene, texts)
        for each in caught:
            self.assertIs(each.category, gnomon.GnomonWarning)
            self.assertEqual(each.filename, __file__, "the line of the caller is shown")
        return [str(each.message) for each in caught]

    def test_each_is_told_once_for_each_scene(self):
        made = Warned()
        self.assertEqual(self.told((made.of_scene, "a", "node 1 is odd", "node 2 is odd"), (made.of_scene, "a", "node 1 is odd"),
                                   (made.of_frame, "a", "node 2 is odd"), (made.of_scene, "b", "node 1 is odd")),
                         ["node 1 is odd", "node 2 is odd", "node 1 is odd"])

    def test_of_frames_each_kind_is_told_by_the_first(self):
        made = Warned()
        self.assertEqual(self.told((made.of_frame, "a", "light 0: 17.5 pixels", "light 1: 20 pixels"),
                                   (made.of_frame, "a", "light 0: 18 pixels", "no sun"), (made.of_frame, "a", "no sun")),
                         ["light 0: 17.5 pixels", "light 1: 20 pixels", "no sun"])

    def test_they_can_be_errors(self):
        made = Warned()
        with warnings.catch_warnings():
            warnings.simplefilter("error", gnomon.GnomonWarning)
            with self.assertRaisesRegex(gnomon.GnomonWarning, "odd"):
                made.of_scene("a", ["odd"])
            made.of_scene("a", ["odd"])


class Frames(unittest.TestCase):
    """Frames as they are read from an .npz."""

    def stored(self):
        content = io.BytesIO()
        with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("report.json", '{"stages": {"shade": 2.5}}')
            for name, value in {"color": 7, "depth": 1.5}.items():
                with archive.open(f"{name}.npy", "w") as file:
                    np.save(file, np.full((2, 3), value))
        return content.getvalue()

    def test_arrays_are_read_when_they_are_asked_for(self):
        content = self.stored()
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            entry = archive.getinfo("depth.npy")
        at = entry.header_offset + 30 + len("depth.npy") + entry.compress_size // 2
        frame = gnomon.read_frame(content[:at] + bytes([content[at] ^ 0xff]) + content[at + 1:])
        self.assertEqual(list(frame.views), ["color", "depth"])
        self.assertEqual(frame.timings, {"shade": 2.5})
        np.testing.assert_array_equal(frame.color, np.full((2, 3), 7))
        self.assertIs(frame.color, frame.views["color"])
        with self.assertRaises((zlib.error, zipfile.BadZipFile)):
            frame.depth

    def test_a_frame_survives_pickling_without_its_session(self):
        alive = gnomon.read_frame(self.stored(), lambda spec, media_type: b"", names=lambda: {-1: "", 0: "box"})
        self.assertEqual(alive.names[0], "box")
        frame = pickle.loads(pickle.dumps(alive))
        with self.assertRaisesRegex(ValueError, "no session"):
            frame.names
        np.testing.assert_array_equal(frame.depth, np.full((2, 3), 1.5))

    def test_a_view_that_was_not_drawn_is_named(self):
        with self.assertRaisesRegex(AttributeError, "no 'normal'; its views are color, depth"):
            gnomon.read_frame(self.stored()).normal


if __name__ == "__main__":
    unittest.main()

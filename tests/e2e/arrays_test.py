"""Frames in every format over HTTP: arrays as NumPy reads them, pictures by their signatures, digests of all."""

import base64
import email
import hashlib
import io
import json
import unittest
import zipfile

import numpy

from shipped_server import SMALL, ServerTest, png_size

VIEWS = ["color", "depth", "normal", "shadow", "ids", "instances", "materials", "albedo", "position", "casterIds", "error"]
INDICES = {"ids", "instances", "materials", "casterIds"}
VECTORS = {"normal", "position"}
COLORS = {"color", "albedo"}
MAGIC = {
    "image/png": b"\x89PNG",
    "image/x-exr": b"\x76\x2f\x31\x01",
    "application/x-npy": b"\x93NUMPY\x01\x00",
    "application/zip": b"PK\3\4",
    "image/tiff": b"II*\0",
    "image/jpeg": b"\xff\xd8\xff",
    "image/webp": b"RIFF",
}
FORMATS = dict(zip(MAGIC, ("png", "exr", "npy", "npz", "tiff", "jpeg", "webp")))
SUFFIXES = dict(zip(MAGIC, (".png", ".exr", ".npy", ".npz", ".tiff", ".jpg", ".webp")))
LIT = SMALL | {"camera": {"node": "camera"}, "lights": [{"sun": {"azimuthDegrees": 120, "elevationDegrees": 40}}]}


def array(content):
    return numpy.load(io.BytesIO(content), allow_pickle=False)


class Formats(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = cls.server.upload("box_on_plane")

    def frame(self, spec, accept="*/*", **headers):
        reply = self.server.frame(self.scene, LIT | spec, accept, **headers)
        self.assertEqual(reply.status, 200, reply.body[:500])
        digest = base64.b64encode(hashlib.sha256(reply.body).digest()).decode()
        self.assertEqual(reply.headers["Repr-Digest"], f"sha-256=:{digest}:")
        return reply

    def npz(self, **output):
        reply = self.frame({"views": VIEWS, "output": {"format": "npz"} | output})
        self.assertEqual(reply.headers["Content-Type"], "application/zip")
        return reply.body

    def assert_is_array_of(self, view, pixels, colors="uint8"):
        channels = (3,) if view in VECTORS | COLORS else ()
        self.assertEqual(pixels.shape, (48, 64) + channels, view)
        self.assertEqual(pixels.dtype, "int32" if view in INDICES else colors if view in COLORS else "float32", view)
        self.assertTrue(pixels.flags["C_CONTIGUOUS"])

    def test_numpy_reads_every_view(self):
        with numpy.load(io.BytesIO(self.npz())) as arrays:
            self.assertEqual(set(arrays.files) - {"report.json"}, set(VIEWS))
            for view in VIEWS:
                self.assert_is_array_of(view, arrays[view])
                alone = array(self.frame({"views": [view], "output": {"format": "npy"}}).body)
                numpy.testing.assert_array_equal(alone, arrays[view], view)

    def test_numbers_mean_what_they_say(self):
        with numpy.load(io.BytesIO(self.npz())) as arrays:
            nothing = arrays["ids"] == -1
            self.assertTrue(0 < nothing.sum() < nothing.size)
            numpy.testing.assert_array_equal(numpy.isinf(arrays["depth"]), nothing)
            numpy.testing.assert_array_equal(numpy.isinf(arrays["position"]).all(axis=2), nothing)
            lengths = numpy.linalg.norm(arrays["normal"][~nothing], axis=1)
            numpy.testing.assert_allclose(lengths, 1, atol=1e-3)
            self.assertGreaterEqual(arrays["shadow"].min(), 0)
            self.assertLessEqual(arrays["shadow"].max(), 1 + 1e-5)  # floats that were filtered

    def test_an_npz_is_a_sound_zip_with_the_report(self):
        with zipfile.ZipFile(io.BytesIO(self.npz())) as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual(archive.namelist(), [f"{view}.npy" for view in VIEWS] + ["report.json"])
            self.assertEqual({entry.date_time for entry in archive.infolist()}, {(1980, 1, 1, 0, 0, 0)})
            self.assertEqual(json.loads(archive.read("report.json"))["spec"]["views"], VIEWS)

    def test_linear_colors_are_floats(self):
        with numpy.load(io.BytesIO(self.npz(arrayColors="linear"))) as arrays:
            for view in VIEWS:
                self.assert_is_array_of(view, arrays[view], colors="float32")

    def test_a_transparent_background_has_its_channel(self):
        spec = {"background": {"alpha": 0}, "antialiasing": "none", "views": ["color", "ids"],
                "output": {"format": "npz"}}
        with numpy.load(io.BytesIO(self.frame(spec).body)) as arrays:
            self.assertEqual(arrays["color"].shape, (48, 64, 4))
            self.assertEqual(set(arrays["color"][arrays["ids"] == -1][:, 3]) - {0}, set(), "nothing is transparent")

    def test_a_single_pixel_is_an_array(self):
        pixel = array(self.frame({"width": 1, "height": 1, "views": ["depth"], "output": {"format": "npy"}}).body)
        self.assertEqual(pixel.shape, (1, 1))

    def test_a_format_comes_by_accept_by_spec_and_in_every_form(self):
        for media_type, magic in MAGIC.items():
            spec = {"views": ["color", "normal"], "output": {"format": FORMATS[media_type]}}
            own = self.frame(spec)
            self.assertEqual(own.headers["Content-Type"], media_type)
            self.assertTrue(own.body.startswith(magic), media_type)
            one_file = media_type in ("image/x-exr", "application/zip")
            has_report = media_type == "application/zip"
            asked = self.frame({"views": ["color", "normal"]}, media_type)
            self.assertEqual(asked.headers["Content-Type"], media_type)
            self.assertEqual(own.headers["ETag"].startswith("W/"), has_report)
            if not has_report:
                self.assertEqual(asked.body, own.body, media_type)

            reply = self.frame(spec, "multipart/mixed")
            head = b"Content-Type: " + reply.headers["Content-Type"].encode() + b"\r\n\r\n"
            parts = email.message_from_bytes(head + reply.body).get_payload()
            names = ["frame"] if one_file else ["color", "normal"]
            self.assertEqual([part.get_filename() for part in parts[1:]], [name + SUFFIXES[media_type] for name in names])
            self.assertEqual({part.get_content_type() for part in parts[1:]}, {media_type})

            images = self.frame(spec, "application/json").json()["images"]
            self.assertEqual([image["contentType"] for image in images], [media_type] * len(names))
            first = base64.b64decode(images[0]["data"], validate=True)
            self.assertTrue(first.startswith(magic))
            if not has_report:
                self.assertEqual(first, own.body)

    def test_head_and_query_know_every_format(self):
        for media_type, name in FORMATS.items():
            path = f"/v1/scenes/{self.scene}/frame?width=64&height=48&format={name}"
            chrome = "image/avif,image/webp,image/apng,image/svg+xml,image/*,*/*;q=0.8"
            head = self.server.ask("HEAD", path)
            self.assertEqual((head.status, head.headers["Content-Type"]), (200, media_type))
            reply = self.server.get(path, Accept=chrome)
            self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, media_type), "as an <img> asks")
            self.assertEqual(head.headers["ETag"], reply.headers["ETag"])

    def test_a_reply_from_memory_has_its_digest_and_a_304_none(self):
        spec = {"output": {"format": "tiff"}, "exposure": 0.5}
        first = self.frame(spec)
        again = self.frame(spec)
        self.assertEqual(again.headers["Cache-Status"], "gnomon; hit")
        self.assertEqual(again.headers["Repr-Digest"], first.headers["Repr-Digest"])
        known = self.server.frame(self.scene, LIT | spec, If_None_Match=first.headers["ETag"])
        self.assertEqual(known.status, 304)
        self.assertNotIn("Repr-Digest", known.headers)
        self.assertNotIn("Cache-Status", self.frame({"output": {"format": "npz"}}).headers)
        self.assertNotIn("Cache-Status", self.frame({"output": {"format": "npz"}}).headers, "it tells times")

    def test_sixteen_bits_are_in_the_header(self):
        for view, color_type in (("color", 2), ("depth", 0), ("ids", 0), ("normal", 2)):
            body = self.frame({"views": [view], "output": {"pngBits": 16}}).body
            self.assertEqual((png_size(body), body[24], body[25]), ((64, 48), 16, color_type), view)

    def test_qualities_matter_and_are_checked(self):
        for name, field in (("jpeg", "jpegQuality"), ("webp", "webpQuality")):
            sizes = [len(self.frame({"output": {"format": name, field: quality}}).body) for quality in (10, 95)]
            self.assertLess(sizes[0], sizes[1], name)
        reply = self.server.frame(self.scene, LIT | {"output": {"jpegQuality": 0, "webpQuality": 101, "pngBits": 12}})
        self.assertEqual(reply.status, 400)
        self.assertEqual(sorted(reply.pointers()), ["/output/jpegQuality", "/output/pngBits", "/output/webpQuality"])

    def test_a_webp_that_none_can_hold_is_refused(self):
        wide = {"width": 16384, "height": 1}
        self.assert_problem(self.server.frame(self.scene, wide | {"output": {"format": "webp"}}), 413, "/width")
        self.assert_problem(self.server.frame(self.scene, wide, "image/webp"), 413, "/width")


class LittleMemory(ServerTest):
    flags = ("--workers", "1", "--frame-memory-bytes", "80MB")

    def test_what_encoding_holds_counts(self):
        scene = self.server.upload("box_on_plane")
        spec = {"width": 2000, "height": 1000, "views": ["normal"], "antialiasing": "none"}
        self.assertEqual(self.server.frame(scene, spec, "image/png").status, 200)
        self.assert_problem(self.server.frame(scene, spec, "application/x-npy"), 413, "/views")


if __name__ == "__main__":
    unittest.main()

"""POST /render as Drake's client sends it: pictures against closed forms, what the operator chooses, and refusals."""

import base64
import hashlib
import json
import math
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from drake_client import FOCAL, HEIGHT, WIDTH, above, ball, box, depth_of, fields, moved, post, rgb_of, scene
from metrics_test import metrics_of, until
from shipped_server import BINARY, TIMEOUT, Server, ServerTest, environment

TOO_FAR = math.inf
BOX = box((0.5, 0.25, 0.25))
ROOM = [(BOX, (0.8, 0.1, 0.1), moved(-0.2, 0, 0.25)), (ball(0.2), (0.1, 0.2, 0.8), moved(0.7, 0.3, 0.2)),
        (box((3, 3, 0.05)), (0.5, 0.5, 0.5), moved(0, 0, -0.05))]  # fmt: skip
EYE = (0.1, 0.05, 3.0)


def seen_at(x, y, eye=EYE, center=None):
    """Where the ray through a pixel's centre goes: its direction, z = -1."""
    center = center or (WIDTH / 2 - 0.5, HEIGHT / 2 - 0.5)
    return (x - center[0]) / FOCAL, -(y - center[1]) / FOCAL


def expected_depth(x, y, eye=EYE, center=None):
    """Metres along the axis to the box, the ball or the floor."""
    dx, dy = seen_at(x, y, eye, center)
    nearest = eye[2]  # the floor, z = 0
    top = eye[2] - 0.5
    if abs(eye[0] + dx * top + 0.2) < 0.5 and abs(eye[1] + dy * top) < 0.25:
        return top
    a, b, c = eye[0] - 0.7, eye[1] - 0.3, eye[2] - 0.2
    square, half, rest = dx * dx + dy * dy + 1, dx * a + dy * b - c, a * a + b * b + c * c - 0.04
    if half * half >= square * rest:
        return (-half - math.sqrt(half * half - square * rest)) / square
    for side in (-0.7, 0.3):  # the box seen from the side
        if dx != 0 and 0 < (t := (side - eye[0]) / dx) < nearest and 0 < eye[2] - t < 0.5 and abs(eye[1] + dy * t) < 0.25:
            nearest = t
    for side in (-0.25, 0.25):
        if dy != 0 and 0 < (t := (side - eye[1]) / dy) < nearest and 0 < eye[2] - t < 0.5 and abs(eye[0] + dx * t + 0.2) < 0.5:
            nearest = t
    return nearest


class Pictures(ServerTest):
    flags = ("--device", "cpu", "--workers", "1")

    def depth(self, gltf, **changes):
        reply = post(self.server, gltf, fields(gltf, "depth", **changes))
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/tiff"), reply.body[:500])
        return depth_of(reply.body)

    def label(self, gltf, **changes):
        reply = post(self.server, gltf, fields(gltf, "label", **changes))
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"), reply.body[:500])
        return rgb_of(reply.body)

    def color(self, gltf, **changes):
        reply = post(self.server, gltf, fields(gltf, "color", **changes))
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"), reply.body[:500])
        return rgb_of(reply.body)

    def check_depths(self, depths, eye=EYE, center=None):
        """Every pixel, but those next to an edge, and the ball's facets within what they lie inside of it."""
        wrong = []
        for y in range(1, HEIGHT - 1):
            for x in range(1, WIDTH - 1):
                around = [expected_depth(x + i, y + j, eye, center) for j in (-1, 0, 1) for i in (-1, 0, 1)]
                if max(around) - min(around) > 0.05:
                    continue
                dx, dy = seen_at(x, y, eye, center)
                z = eye[2] - depths[y][x]
                is_flat = min(abs(around[4] - eye[2] + 0.5), abs(around[4] - eye[2])) < 1e-9
                if abs(depths[y][x] - around[4]) > (1e-5 if is_flat else 5e-3) * around[4]:
                    wrong.append((x, y, depths[y][x], around[4], z, dx, dy))
        self.assertEqual(wrong[:3], [])

    def test_depths_are_those_of_the_pinhole_camera(self):
        self.check_depths(self.depth(scene(ROOM, above(*EYE))))

    def test_a_lens_off_the_middle_sees_what_is_there(self):
        center = (30.25, 91.5)
        depths = self.depth(scene(ROOM, above(*EYE)), center_x=center[0], center_y=center[1])
        self.check_depths(depths, center=center)

    def test_what_is_beyond_the_sensor_is_too_close_or_too_far(self):
        objects = [(BOX, (1, 0, 0), moved(0, 0, 0.25))]
        eye = (0, 0, 3.0)
        gltf = scene(objects, above(*eye))
        middle = (HEIGHT // 2, WIDTH // 2)
        for low, high, expected in ((0.1, 50.0, 2.5), (2.6, 50.0, 0.0), (0.1, 2.4, TOO_FAR)):
            depths = self.depth(gltf, min_depth=low, max_depth=high)
            self.assertAlmostEqual(depths[middle[0]][middle[1]], expected, delta=2.5e-5)
            self.assertEqual(depths[0][0], TOO_FAR)

    def test_depths_in_millimetres_for_those_who_want_a_png(self):
        gltf = scene([(BOX, (1, 0, 0), moved(0, 0, 0.25))], above(0, 0, 3))
        reply = post(self.server, gltf, fields(gltf, "depth"), accept="image/png")
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (200, "image/png"), reply.body[:500])
        self.assertEqual(reply.body[24:26], b"\x10\0", "16 bits, grey")
        digest = base64.b64encode(hashlib.sha256(reply.body).digest()).decode()
        self.assertEqual(reply.headers["Repr-Digest"], f"sha-256=:{digest}:")

    def test_labels_are_the_colors_that_drake_paints_to_the_pixel(self):
        labels = [(0, 0), (1, 0), (2, 0), (253, 127), (254, 1), (17, 34), (128, 64)]
        half = (0.08, 0.2, 0.05)
        places = [(-0.9 + 0.3 * i, 0.0, 0.05) for i in range(len(labels))]
        objects = [(box(half), (r / 255, g / 255, 0), moved(*place)) for (r, g), place in zip(labels, places)]
        eye = (0, 0, 2.0)
        rows = self.label(scene(objects, above(*eye)))
        seen = {color for row in rows for color in row}
        self.assertEqual(seen, {(r, g, 0) for r, g in labels} | {(255, 255, 255)})
        for (r, g), (px, py, _) in zip(labels, places):
            inside = []
            for y, row in enumerate(rows):
                inside += [(x, y) for x, color in enumerate(row) if color == (r, g, 0)]
            top = eye[2] - 0.1  # what is seen of the upper face is exact; the sides add to one edge
            left = FOCAL * (px - half[0]) / top + WIDTH / 2 - 0.5
            right = FOCAL * (px + half[0]) / top + WIDTH / 2 - 0.5
            for x in range(math.ceil(left + 1e-3), math.floor(right - 1e-3) + 1):
                self.assertIn((x, HEIGHT // 2), inside)
            upper = min(y for _, y in inside)
            self.assertAlmostEqual(upper, HEIGHT / 2 - 0.5 - FOCAL * half[1] / top, delta=1)

    def test_colors_are_lit_and_shadowed(self):
        rows = self.color(scene(ROOM, above(*EYE)))
        lit = rows[20][20]
        # The sun travels along (-0.4, 0.3, -1): the box's shadow reaches the floor above it in the picture, at (-0.29, 0.36).
        dark = rows[44][60]
        self.assertGreater(sum(lit), 1.5 * sum(dark), (lit, dark))
        red = rows[HEIGHT // 2][round(FOCAL * (-0.2 - EYE[0]) / 2.5 + WIDTH / 2)]
        self.assertGreater(red[0], 2 * red[1])

    def test_the_far_plane_and_nothing_are_background(self):
        gltf = scene([(BOX, (1, 0, 0), moved(0, 0, 0.25))], above(0, 0, 3))
        self.assertEqual(self.color(gltf)[0][0], (204, 229, 255))
        self.assertEqual(self.label(gltf)[0][0], (255, 255, 255))
        self.assertEqual(self.label(gltf, far=2.0)[HEIGHT // 2][WIDTH // 2], (255, 255, 255))


class Reuse(unittest.TestCase):
    def test_frames_of_a_moving_camera_load_no_mesh_again(self):
        frames = 5
        with Server("--device", "cpu", "--workers", "1") as server:
            first = scene(ROOM, above(*EYE))
            before = post(server, first, fields(first, "color"))
            self.assertEqual(before.status, 200, before.body)
            for i in range(1, frames):
                later = scene(ROOM, above(EYE[0] + 0.1 * i, *EYE[1:]))
                self.assertNotEqual(post(server, later, fields(later, "color")).body, before.body)
            until(lambda: metrics_of(server).value("gnomon_reused_meshes_total") == len(ROOM) * (frames - 1))

    def test_a_frame_with_reused_meshes_is_the_one_without(self):
        moved_room = [(mesh, color, moved(*(0.1 + x for x in matrix[12:15]))) for mesh, color, matrix in ROOM]
        pictures = []
        for others in ([], [scene(ROOM, above(*EYE)), scene(ROOM[::-1], above(*EYE))]):
            with Server("--device", "cpu", "--workers", "1") as server:
                for gltf in [*others, scene(moved_room, above(*EYE))]:
                    reply = post(server, gltf, fields(gltf, "color"))
                    self.assertEqual(reply.status, 200, reply.body)
                pictures.append(reply.body)
        self.assertEqual(pictures[0], pictures[1])


class OperatorsSpec(unittest.TestCase):
    """--drake-spec: how color pictures are drawn."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "colors.json"

    def pictures(self, *flags):
        """Color, depth and label of one scene."""
        gltf = scene([(BOX, (1, 0, 0), moved(0, 0, 0.25))], above(0, 0, 3))
        with Server("--device", "cpu", "--workers", "1", *flags) as server:
            replies = [post(server, gltf, fields(gltf, kind)) for kind in ("color", "depth", "label")]
        self.assertEqual([reply.status for reply in replies], [200] * 3, replies[0].body[:500])
        return [reply.body for reply in replies]

    def test_colors_alone_are_drawn_as_it_says(self):
        spec = {"background": {"color": [0, 1, 0]}, "lights": [], "ambient": {"color": [0, 0, 0]}, "toneMapping": "none"}
        self.file.write_text(json.dumps(spec))
        color, depth, label = self.pictures("--drake-spec", str(self.file))
        usual_color, usual_depth, usual_label = self.pictures()
        rows, usual = rgb_of(color), rgb_of(usual_color)
        self.assertEqual((rows[0][0], rows[HEIGHT // 2][WIDTH // 2]), ((0, 255, 0), (0, 0, 0)))
        self.assertEqual(usual[0][0], (204, 229, 255))
        self.assertGreater(usual[HEIGHT // 2][WIDTH // 2][0], 100, "a lit red box")
        self.assertEqual((depth, label), (usual_depth, usual_label))

    def test_a_file_that_is_no_such_spec_stops_the_start_and_is_told(self):
        wrong = [("{", "JSON"), ('{"width": 64}', "/width"), ('{"lihgts": []}', "/lihgts"), ("", "empty"),
                 ('{"background": {"alpha": 0}}', "/background/alpha"), (" " * (2 << 20), "larger")]  # fmt: skip
        for text, word in wrong:
            with self.subTest(text[:40]):
                self.file.write_text(text)
                self.assert_no_start(self.file, word)
        self.assert_no_start(self.file.with_name("nothing.json"), "nothing.json")

    def assert_no_start(self, file, word):
        command = [BINARY, "serve", "--port", "0", "--drake-spec", str(file)]
        done = subprocess.run(command, capture_output=True, text=True, env=environment(), timeout=TIMEOUT)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("--drake-spec", done.stderr)
        self.assertIn(word, done.stderr)


class Refusals(ServerTest):
    flags = ("--device", "cpu", "--workers", "1")

    def setUp(self):
        self.gltf = scene([(BOX, (1, 0, 0), moved(0, 0, 0))], above(0, 0, 3))

    def assert_refused(self, reply, status, *words):
        text = reply.body.decode()
        self.assertEqual((reply.status, reply.headers["Content-Type"]), (status, "text/plain; charset=utf-8"), text)
        for word in words:
            self.assertIn(word, text)

    def test_each_wrong_field_is_named_with_its_limit(self):
        wrong = {
            "width": (0, 16385, "1.5", "x", "", "1e400", None),
            "height": (-1, None),
            "near": (0.0, -1.0, "nan", "inf", 101.0, None),
            "far": (-1.0, None),
            "focal_x": (0.0, 200.0, None),
            "focal_y": (1e12, 149.0, None),
            "fov_x": (4.0, 1.0, None),
            "fov_y": (0.0, 1.0, None),
            "center_x": (-1.0, 160.0, None),
            "center_y": (120.0, None),
            "scene_sha256": ("0" * 64, "x", None),
            "image_type": ("colour", "", None),
        }
        for name, values in wrong.items():
            for value in values:
                with self.subTest(name=name, value=value):
                    reply = post(self.server, self.gltf, fields(self.gltf, "color", **{name: value}))
                    told = {"focal_x": "fov_x", "focal_y": "fov_y"}.get(name, name) if isinstance(value, float) else name
                    self.assertRegex(reply.body.decode(), rf"(?m)^({name}|{told}): ")
                    self.assertEqual(reply.status, 422 if name == "scene_sha256" and value else 400)

    def test_every_problem_has_its_line(self):
        sent = fields(self.gltf, "depth", width=0, near=None, min_depth=None)
        reply = post(self.server, self.gltf, sent)
        self.assert_refused(reply, 400, "width: ", "near: ", "min_depth: ")
        self.assertEqual(len(reply.body.splitlines()), 3)

    def test_depth_has_a_range_and_nothing_else_has_one(self):
        self.assert_refused(post(self.server, self.gltf, fields(self.gltf, "depth", max_depth=None)), 400, "max_depth: ")
        self.assert_refused(post(self.server, self.gltf, fields(self.gltf, "label", max_depth=1.0)), 400, "max_depth: ")
        wide = fields(self.gltf, "depth", min_depth=2.0, max_depth=2.0)
        self.assert_refused(post(self.server, self.gltf, wide), 400, "min_depth: ")

    def test_fields_are_known_and_come_once(self):
        sent = fields(self.gltf, "color")
        self.assert_refused(post(self.server, self.gltf, sent | {"samples": "4"}), 400, "samples: ")
        self.assert_refused(post(self.server, self.gltf, sent, more=[("near", "0.1")]), 400, "near: ")
        self.assert_refused(post(self.server, None, sent), 400, "scene: ")

    def test_the_scene_is_told_what_is_wrong_with_it(self):
        broken = self.gltf.replace(b'"componentType": 5126', b'"componentType": 1')
        self.assert_refused(post(self.server, broken, fields(broken, "color")), 422, "/accessors/0/componentType")
        blind = self.gltf.replace(b"Camera Node", b"Another Node")
        self.assert_refused(post(self.server, blind, fields(blind, "color")), 400, "/camera/node", "Another Node")
        outside = re.sub(rb"data:application/octet-stream;base64,[^\"]*", b"box.bin", self.gltf)
        self.assert_refused(post(self.server, outside, fields(outside, "color")), 422, "box.bin")

    def test_a_picture_that_the_client_can_read(self):
        reply = post(self.server, self.gltf, fields(self.gltf, "color"), accept="image/webp")
        self.assert_refused(reply, 406, "image/png")

    def test_too_much_work_is_refused_before_it_is_begun(self):
        huge = fields(self.gltf, "color", width=16384, height=16384, fov_x=None, fov_y=None)
        huge |= {"fov_x": f"{2 * math.atan(8192 / FOCAL):.6f}", "fov_y": f"{2 * math.atan(8192 / FOCAL):.6f}"}
        self.assert_refused(post(self.server, self.gltf, huge), 413, "pixels")


if __name__ == "__main__":
    unittest.main()

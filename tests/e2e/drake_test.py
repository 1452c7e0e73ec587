"""POST /render as Drake's RenderEngineGltfClient sends it: forms built by hand, pictures against closed forms."""

import base64
import hashlib
import json
import math
import re
import struct
import unittest
import zlib

from metrics_test import metrics_of, until
from shipped_server import Server, ServerTest, png_size

WIDTH, HEIGHT = 160, 120
FOCAL = 150.0
TOO_FAR = math.inf


def data_uri(content):
    return "data:application/octet-stream;base64," + base64.b64encode(content).decode()


def flat(vectors):
    return [number for vector in vectors for number in vector]


def box(half):
    """(positions, normals, indices) of a box around the origin, four vertices a face."""
    positions, normals, indices = [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[u], corner[v] = sign * half[axis], a * half[u], b * half[v]
                positions.append(corner)
                normals.append([sign if i == axis else 0 for i in range(3)])
            turn = (0, 1, 2, 0, 2, 3) if sign > 0 else (0, 2, 1, 0, 3, 2)
            indices += [first + i for i in turn]
    return positions, normals, indices


def ball(radius, rings=48):
    """Alike: a sphere around the origin, its poles on z."""
    positions, indices = [], []
    for i in range(rings + 1):
        for j in range(2 * rings + 1):
            polar, turn = math.pi * i / rings, math.pi * j / rings
            positions.append([math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar)])
    for i in range(rings):
        for j in range(2 * rings):
            a = i * (2 * rings + 1) + j
            b = a + 2 * rings + 1
            indices += [a, b, a + 1, a + 1, b, b + 1]
    return [[radius * x for x in p] for p in positions], positions, indices


def moved(x, y, z):
    return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1]


def above(x, y, z):
    """A camera that looks down -z from there: the x axis to the right, the y axis up."""
    return moved(x, y, z)


def scene(objects, camera):
    """glTF as VTK's exporter writes it for Drake: a buffer for each view, everything below "Renderer Node". `objects`:
    (mesh, color, matrix)."""
    gltf = {"asset": {"generator": "VTK", "version": "2.0"}, "accessors": [], "buffers": [], "bufferViews": [],
            "materials": [], "meshes": [], "nodes": [], "scene": 0}  # fmt: skip
    def accessor(numbers, kind, code, bounds=None):
        content = struct.pack(f"<{len(numbers)}{'f' if code == 5126 else 'I'}", *numbers)
        view = len(gltf["buffers"])
        gltf["buffers"].append({"byteLength": len(content), "uri": data_uri(content)})
        gltf["bufferViews"].append({"buffer": view, "byteLength": len(content), "byteOffset": 0})
        count = len(numbers) // (3 if kind == "VEC3" else 1)
        entry = {"bufferView": view, "byteOffset": 0, "componentType": code, "count": count, "type": kind}
        gltf["accessors"].append(entry | (bounds or {}))
        return view
    for (positions, normals, indices), color, matrix in objects:
        bounds = {"min": [min(p[i] for p in positions) for i in range(3)],
                  "max": [max(p[i] for p in positions) for i in range(3)]}  # fmt: skip
        primitive = {
            "attributes": {"POSITION": accessor(flat(positions), "VEC3", 5126, bounds),
                           "NORMAL": accessor(flat(normals), "VEC3", 5126)},
            "indices": accessor(indices, "SCALAR", 5125),
            "material": len(gltf["materials"]),
            "mode": 4,
        }  # fmt: skip
        pbr = {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1}
        gltf["materials"].append({"pbrMetallicRoughness": pbr})
        gltf["meshes"].append({"name": f"mesh{len(gltf['meshes'])}", "primitives": [primitive]})
        gltf["nodes"].append({"mesh": len(gltf["nodes"]), "matrix": matrix, "name": f"mesh{len(gltf['nodes'])}",
                              "extras": {"from_drake": True}})  # fmt: skip
    lens = {"aspectRatio": WIDTH / HEIGHT, "yfov": 2 * math.atan(HEIGHT / 2 / FOCAL), "znear": 0.01, "zfar": 100}
    gltf["cameras"] = [{"type": "perspective", "perspective": lens}]
    gltf["nodes"].append({"camera": 0, "matrix": camera, "name": "Camera Node"})
    children = list(range(len(gltf["nodes"])))
    gltf["nodes"].append({"children": children, "name": "Renderer Node"})
    gltf["scenes"] = [{"nodes": [len(children)]}]
    return json.dumps(gltf).encode()


def fields(gltf, kind, **changes):
    """The form's fields as Drake writes them: six digits after the point."""
    sent = {"scene_sha256": hashlib.sha256(gltf).hexdigest(), "image_type": kind, "width": WIDTH, "height": HEIGHT,
            "near": 0.01, "far": 100.0, "focal_x": FOCAL, "focal_y": FOCAL,
            "fov_x": 2 * math.atan(WIDTH / 2 / FOCAL), "fov_y": 2 * math.atan(HEIGHT / 2 / FOCAL),
            "center_x": WIDTH / 2 - 0.5, "center_y": HEIGHT / 2 - 0.5, "submit": "Render"}  # fmt: skip
    if kind == "depth":
        sent |= {"min_depth": 0.1, "max_depth": 50.0}
    sent |= changes
    return {name: f"{value:.6f}" if isinstance(value, float) else str(value)
            for name, value in sent.items() if value is not None}  # fmt: skip


def form(gltf, sent, more=()):
    boundary = "------------------------0f2b5c9d"
    body = b""
    for name, value in [*sorted(sent.items()), *more]:
        body += f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n{value}\r\n'.encode()
    if gltf is not None:
        head = 'Content-Disposition: form-data; name="scene"; filename="0000000000000000001-color.gltf"'
        body += f"--{boundary}\r\n{head}\r\nContent-Type: model/gltf+json\r\n\r\n".encode() + gltf + b"\r\n"
    return body + f"--{boundary}--\r\n".encode(), f"multipart/form-data; boundary={boundary}"


def post(server, gltf, sent, accept="*/*", more=()):
    body, kind = form(gltf, sent, more)
    return server.ask("POST", "/render", body, {"Content-Type": kind, "Accept": accept})


def depth_of(tiff):
    """Rows of the numbers of a TIFF of one 32-bit float a pixel, little endian, in strips, deflated or not."""
    assert tiff[:4] == b"II*\0", tiff[:8]
    at = struct.unpack_from("<I", tiff, 4)[0]
    tags = {}
    for i in range(struct.unpack_from("<H", tiff, at)[0]):
        tag, kind, count, value = struct.unpack_from("<HHI4s", tiff, at + 2 + 12 * i)
        size, code = {3: (2, "H"), 4: (4, "I")}.get(kind, (1, "B"))
        place = value if size * count <= 4 else tiff[struct.unpack("<I", value)[0] :]
        tags[tag] = struct.unpack_from(f"<{count}{code}", place)
    assert tags[258] == (32,) and tags[339] == (3,) and tags.get(277, (1,)) == (1,), tags
    content = b""
    for offset, size in zip(tags[273], tags[279]):
        strip = tiff[offset : offset + size]
        content += zlib.decompress(strip) if tags[259] == (8,) else strip
    width, height = tags[256][0], tags[257][0]
    numbers = struct.unpack(f"<{width * height}f", content)
    return [numbers[row * width : (row + 1) * width] for row in range(height)]


def rgb_of(png):
    """Rows of (r, g, b) of an 8-bit PNG of three channels."""
    width, height = png_size(png)
    assert png[24:26] == b"\x08\x02", "8 bits, RGB"
    packed, at = b"", 8
    while at < len(png):
        size = int.from_bytes(png[at : at + 4])
        if png[at + 4 : at + 8] == b"IDAT":
            packed += png[at + 8 : at + 8 + size]
        at += size + 12
    raw, row = zlib.decompress(packed), bytes(3 * width)
    rows = []
    for y in range(height):
        line = bytearray(raw[y * (3 * width + 1) : (y + 1) * (3 * width + 1)])
        kind = line.pop(0)
        for i in range(3 * width):
            left, up = (line[i - 3] if i >= 3 else 0), row[i]
            corner = row[i - 3] if i >= 3 else 0
            if kind == 4:
                p = left + up - corner
                best = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            else:
                best = (0, left, up, (left + up) // 2)[kind]
            line[i] = (line[i] + best) & 255
        row = bytes(line)
        rows.append([tuple(row[3 * x : 3 * x + 3]) for x in range(width)])
    return rows


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

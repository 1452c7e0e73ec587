"""A client of POST /render like Drake's RenderEngineGltfClient: scenes as VTK writes them, its form, and its readers of
pictures. Built by hand, so that tests need none of either."""

import base64
import hashlib
import json
import math
import struct
import zlib

from shipped_server import png_size

WIDTH, HEIGHT = 160, 120
FOCAL = 150.0


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

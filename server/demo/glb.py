"""Writes GLB files: meshes, materials, textures, cameras and lights, in the order in which they are added.

The bytes depend on nothing but the calls. Standard library only.
"""

import json
import math
import struct
import sys
import zlib
from array import array

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
VERTEX_DATA, INDEX_DATA = 34962, 34963


def png(width, height, channels, pixels):
    """An 8-bit PNG of 3 (RGB) or 4 (RGBA) channels; `pixels` are interleaved rows, the top one first."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    stride = width * channels
    rows = b"".join(b"\0" + bytes(pixels[y * stride:(y + 1) * stride]) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def look_along(direction, up=(0.0, 1.0, 0.0)):
    """The rotation, as a glTF quaternion x y z w, of a node whose -Z looks along `direction`."""
    z = _unit([-c for c in direction])
    x = _unit(_cross(up, z))
    y = _cross(z, x)
    m00, m10, m20 = x
    m01, m11, m21 = y
    m02, m12, m22 = z
    # Shepperd, "Quaternion from Rotation Matrix", 1978: divide by the largest of the four.
    trace = m00 + m11 + m22
    if trace > 0:
        s = 2 * math.sqrt(1 + trace)
        q = [(m21 - m12) / s, (m02 - m20) / s, (m10 - m01) / s, s / 4]
    elif m00 > m11 and m00 > m22:
        s = 2 * math.sqrt(1 + m00 - m11 - m22)
        q = [s / 4, (m01 + m10) / s, (m02 + m20) / s, (m21 - m12) / s]
    elif m11 > m22:
        s = 2 * math.sqrt(1 + m11 - m00 - m22)
        q = [(m01 + m10) / s, s / 4, (m12 + m21) / s, (m02 - m20) / s]
    else:
        s = 2 * math.sqrt(1 + m22 - m00 - m11)
        q = [(m02 + m20) / s, (m12 + m21) / s, s / 4, (m10 - m01) / s]
    return q


def sun_direction(azimuth, elevation):
    """Where the light of a sun at these degrees travels; azimuth clockwise from north (-Z) seen from above."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return [-math.sin(a) * math.cos(e), -math.sin(e), math.cos(a) * math.cos(e)]


def turn(degrees):
    """A rotation about +Y, counter-clockwise seen from above."""
    half = math.radians(degrees) / 2
    return [0.0, math.sin(half), 0.0, math.cos(half)]


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


class Glb:
    """One glTF asset. Every adding method gives the index of what it added."""

    def __init__(self):
        self._binary = bytearray()
        self._json = {"asset": {"version": "2.0", "generator": "Gnomon scene generator"}, "scene": 0}
        self._extensions = []

    def _add(self, kind, value):
        items = self._json.setdefault(kind, [])
        items.append(value)
        return len(items) - 1

    def _view(self, data, target=None):
        while len(self._binary) % 4:
            self._binary.append(0)
        view = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self._binary += data
        return self._add("bufferViews", view)

    def _accessor(self, values, component, kind, count, bounds=None):
        if sys.byteorder == "big":
            values = array(values.typecode, values)
            values.byteswap()
        target = INDEX_DATA if kind == "SCALAR" else VERTEX_DATA
        accessor = {"bufferView": self._view(values.tobytes(), target), "componentType": component, "count": count,
                    "type": kind}
        if bounds:
            accessor["min"], accessor["max"] = bounds
        return self._add("accessors", accessor)

    def texture(self, encoded, name):
        """A repeating texture from the bytes of a PNG."""
        image = self._add("images", {"name": name, "bufferView": self._view(encoded), "mimeType": "image/png"})
        if "samplers" not in self._json:
            self._add("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
        return self._add("textures", {"source": image, "sampler": 0})

    def material(self, name, color=(1, 1, 1, 1), metallic=0.0, roughness=0.9, texture=None, normal=None, mask=None,
                 double_sided=False, emissive=None, blend=False):
        """`color` is linear; `texture` and `normal` are indices of textures; `mask` is an alpha cutoff, `blend` lets the
        alpha mix what is seen with what is behind."""
        surface = {"baseColorFactor": list(color), "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            surface["baseColorTexture"] = {"index": texture}
        material = {"name": name, "pbrMetallicRoughness": surface}
        if normal is not None:
            material["normalTexture"] = {"index": normal}
        if mask is not None:
            material["alphaMode"], material["alphaCutoff"] = "MASK", mask
        if blend:
            material["alphaMode"] = "BLEND"
        if double_sided:
            material["doubleSided"] = True
        if emissive is not None:
            material["emissiveFactor"] = list(emissive)
        return self._add("materials", material)

    def _primitive(self, mesh, material):
        count = len(mesh.positions) // 3
        bounds = ([min(mesh.positions[i::3]) for i in range(3)], [max(mesh.positions[i::3]) for i in range(3)])
        attributes = {"POSITION": self._accessor(mesh.positions, FLOAT, "VEC3", count, bounds)}
        for name, values, kind, size in (("NORMAL", mesh.normals, "VEC3", 3), ("TANGENT", mesh.tangents, "VEC4", 4),
                                         ("TEXCOORD_0", mesh.uvs, "VEC2", 2), ("COLOR_0", mesh.colors, "VEC3", 3)):
            if values:
                assert len(values) == count * size, f"{name} of {len(values) // size} of {count} vertices"
                attributes[name] = self._accessor(values, FLOAT, kind, count)
        assert max(mesh.indices) < count
        if count <= 65535:
            indices = self._accessor(array("H", mesh.indices), UNSIGNED_SHORT, "SCALAR", len(mesh.indices))
        else:
            indices = self._accessor(mesh.indices, UNSIGNED_INT, "SCALAR", len(mesh.indices))
        primitive = {"attributes": attributes, "indices": indices}
        if material is not None:
            primitive["material"] = material
        return primitive

    def mesh(self, name, *parts):
        """`parts` are pairs of a shapes.Mesh and a material index (or None)."""
        return self._add("meshes", {"name": name, "primitives": [self._primitive(*part) for part in parts]})

    def perspective(self, fov_y, near=0.1, far=None):
        lens = {"yfov": math.radians(fov_y), "znear": near}
        if far is not None:
            lens["zfar"] = far
        return self._add("cameras", {"type": "perspective", "perspective": lens})

    def orthographic(self, half_width, half_height, near, far):
        lens = {"xmag": half_width, "ymag": half_height, "znear": near, "zfar": far}
        return self._add("cameras", {"type": "orthographic", "orthographic": lens})

    def light(self, kind, **properties):
        """A light of KHR_lights_punctual; gives the extension object of its node."""
        if "KHR_lights_punctual" not in self._extensions:
            self._extensions.append("KHR_lights_punctual")
            self._json["extensionsUsed"] = self._extensions
        lights = self._json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"type": kind, **properties})
        return {"KHR_lights_punctual": {"light": len(lights) - 1}}

    def node(self, name=None, **properties):
        """Properties are glTF's: mesh, camera, translation, rotation, scale, matrix, children, extensions."""
        node = {"name": name} if name else {}
        node.update({key: list(value) if isinstance(value, tuple) else value for key, value in properties.items()})
        return self._add("nodes", node)

    def camera_node(self, name, camera, eye, target):
        direction = [t - e for t, e in zip(target, eye)]
        return self.node(name, camera=camera, translation=list(eye), rotation=look_along(direction))

    def scene(self, nodes, name=None):
        scene = {"name": name} if name else {}
        if nodes:
            scene["nodes"] = list(nodes)
        return self._add("scenes", scene)

    def triangles(self, scene=0):
        """Of the scene, with node reuse counted."""

        def count(node):
            total = 0
            if "mesh" in node:
                for primitive in self._json["meshes"][node["mesh"]]["primitives"]:
                    total += self._json["accessors"][primitive["indices"]]["count"] // 3
            return total + sum(count(self._json["nodes"][child]) for child in node.get("children", []))

        return sum(count(self._json["nodes"][node]) for node in self._json["scenes"][scene].get("nodes", []))

    def to_bytes(self):
        while len(self._binary) % 4:
            self._binary.append(0)
        asset = dict(self._json)
        if self._binary:
            asset["buffers"] = [{"byteLength": len(self._binary)}]
        text = json.dumps(asset, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        if self._binary:
            chunks += struct.pack("<I4s", len(self._binary), b"BIN\0") + bytes(self._binary)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def write(self, path):
        with open(path, "wb") as file:
            file.write(self.to_bytes())

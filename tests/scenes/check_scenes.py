#!/usr/bin/env python3
"""Holds GLB files to what the generators promise: sound buffers and indices, true bounds, unit normals that agree with
counter-clockwise fronts, and the number of triangles. Meshes called "faulty ..." may hold triangles without an area or
without places. Exit status 1 tells what is wrong.

usage: check_scenes.py FILE.glb[=TRIANGLES]...      TRIANGLES is of the default scene: a number, or FROM-TO
"""

import json
import math
import struct
import sys
from array import array

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TYPECODES = {5123: "H", 5125: "I", 5126: "f"}


def read_glb(path):
    with open(path, "rb") as file:
        data = file.read()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert magic == b"glTF" and version == 2 and length == len(data), "GLB header"
    chunks, at = {}, 12
    while at < length:
        size, kind = struct.unpack_from("<I4s", data, at)
        assert size % 4 == 0, "chunk not padded"
        chunks[kind] = data[at + 8:at + 8 + size]
        at += 8 + size
    return json.loads(chunks[b"JSON"]), chunks.get(b"BIN\0", b"")


def accessor_values(asset, binary, index):
    accessor = asset["accessors"][index]
    view = asset["bufferViews"][accessor["bufferView"]]
    count = accessor["count"] * WIDTHS[accessor["type"]]
    values = array(TYPECODES[accessor["componentType"]])
    assert view["byteOffset"] % values.itemsize == 0, "misaligned accessor"
    assert view["byteOffset"] + view["byteLength"] <= len(binary), "view outside of the buffer"
    assert count * values.itemsize == view["byteLength"], "accessor and view differ in size"
    values.frombytes(binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])
    if sys.byteorder == "big":
        values.byteswap()
    return accessor, values


def check_primitive(asset, binary, primitive, may_be_faulty):
    accessor, p = accessor_values(asset, binary, primitive["attributes"]["POSITION"])
    for i in range(3):
        assert min(p[i::3]) == accessor["min"][i] and max(p[i::3]) == accessor["max"][i], "bounds of POSITION"
    _, n = accessor_values(asset, binary, primitive["attributes"]["NORMAL"])
    assert len(n) == len(p), "a normal for each vertex"
    for i in range(0, len(n), 3):
        assert abs(math.sqrt(n[i] ** 2 + n[i + 1] ** 2 + n[i + 2] ** 2) - 1) < 1e-4, "normals of unit length"
    _, indices = accessor_values(asset, binary, primitive["indices"])
    assert len(indices) % 3 == 0 and max(indices) < accessor["count"], "indices in range"
    if may_be_faulty:
        return
    for t in range(0, len(indices), 3):
        a, b, c = indices[t] * 3, indices[t + 1] * 3, indices[t + 2] * 3
        ux, uy, uz = p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]
        vx, vy, vz = p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]
        x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        for k in (a, b, c):
            assert x * n[k] + y * n[k + 1] + z * n[k + 2] > 0, f"triangle {t // 3} faces away from its normals"


def triangles_of(asset, node_index):
    node = asset["nodes"][node_index]
    own = sum(asset["accessors"][primitive["indices"]]["count"] // 3
              for primitive in (asset["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []))
    return own + sum(triangles_of(asset, child) for child in node.get("children", []))


def check(argument):
    path, _, expected = argument.partition("=")
    asset, binary = read_glb(path)
    for mesh in asset.get("meshes", []):
        for primitive in mesh["primitives"]:
            try:
                check_primitive(asset, binary, primitive, mesh["name"].startswith("faulty"))
            except AssertionError as error:
                raise AssertionError(f"mesh {mesh['name']}: {error}") from None
    triangles = sum(triangles_of(asset, node) for node in asset["scenes"][asset["scene"]].get("nodes", []))
    if expected:
        low, _, high = expected.partition("-")
        assert int(low) <= triangles <= int(high or low), f"{triangles} triangles, not {expected}"


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for scene in sys.argv[1:]:
        try:
            check(scene)
        except AssertionError as failure:
            sys.exit(f"{scene}: {failure}")

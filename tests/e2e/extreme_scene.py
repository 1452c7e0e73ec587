"""The demo scene with numbers in it that no one would expect."""

import json
import os
import struct
from pathlib import Path

DEMO = Path(os.environ["GNOMON_BINARY"]).parent.parent / "share/gnomon/demo.glb"


def demo_with(mesh, value, change=lambda gltf: None):
    """The scene as a GLB. `mesh`: the name of one, the x of whose sixth vertex becomes `value`; None = of none.
    `change`: called with the JSON."""
    glb = DEMO.read_bytes()
    (length,) = struct.unpack_from("<I", glb, 12)
    gltf = json.loads(glb[20 : 20 + length])
    binary = bytearray(glb[28 + length :])
    if mesh is not None:
        (source,) = (each for each in gltf["meshes"] if each.get("name") == mesh)
        accessor = gltf["accessors"][source["primitives"][0]["attributes"]["POSITION"]]
        view = gltf["bufferViews"][accessor["bufferView"]]
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0) + 5 * view.get("byteStride", 12)
        struct.pack_into("<f", binary, at, value)
    change(gltf)
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

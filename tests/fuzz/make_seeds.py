"""Writes what each fuzz target starts from: FOLDER/TARGET/NAME. Nothing of it is kept in the repository.

usage: make_seeds.py FOLDER SCENES [ASSETS]     SCENES: the generated test scenes; ASSETS: gathered glTF files, if any
"""

import base64
import json
import random
import shutil
import struct
import sys
import urllib.parse
import zlib
from pathlib import Path

TESTS = Path(__file__).resolve().parent.parent
MOST = 64 * 1024  # bytes of a seed: larger ones only make a run slow
BOUNDARY = "a-boundary"
# Four pixels with alpha each, as Python has no encoder for them.
WEBP = {
    "lossless": "UklGRigAAABXRUJQVlA4TBwAAAAvAUAAEDUISIj8P+WLUyrDr/8Fssnumr9CcSgO",
    "lossy": "UklGRmAAAABXRUJQVlA4WAoAAAAQAAAAAQAAAQAAQUxQSAUAAAAAAAFk/wBWUDggNAAAALABAJ0BKgIAAgACgEIliAJ0AQ72o4AA/ub5et3n"
    "7Dy1SW2wA+HqaL1f6+8odiY6yd4gAAA=",
}

# A float grid of two voxels as OpenVDB writes it, deflated.
VDB = (
    "eNrt2stKw0AUBuCkeCnipS4KLrOXQDVJ0Y0VcevKy3aYyUxkIJeSpKHd9RF8Fd+oj9AX0DjTJjWl4Ebqxv+DwwyHc5KTSekq1t39i6HMVBwYFe"
    "pfu/yKU9v1KLNd1+E2417PDnj/ohd4zL9kjq4zVeyr4CLOZD7pqO1TKgQJwoTmxCMucYwf7FXtRyoCGQrCWDImER3vqkQhfEceqs1nWZY6ITYr"
    "ZbxW+VFVchWdutJPomEqskwmsb5flqcyfu2qHQuTzLfOLernshBWQcORyE7rNi5COhGcqCfh+q6kzuhEt3r2Fataj+v2SESETXKR6XlknPfdtt"
    "q8ve8sylbDFclYhGrEUZyvFbaq6+nymEbie/LGcZ+o7XMsgySNHn0aigc6XHbNB9tdZxvr8jCmN/WPwpiXpQEAAAAAAAAAf8bEEQAAAAAAAADA"
    "tnWqtWU6i88fzEYO/sGLB9jaH0PdYP1yiGb/WWMw/TlWe5WbDlTl7ReJLYBe"
)


def write(folder, name, content):
    if 0 < len(content) <= MOST:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)


def inlined(path):
    """A .gltf with the files that it names as data URIs, or as it is where it can't be read."""
    content = path.read_bytes()
    try:
        document = json.loads(content)
        for element in document.get("buffers", []) + document.get("images", []):
            file = path.parent / urllib.parse.unquote(element.get("uri", "data:"))
            if not element.get("uri", "data:").startswith("data:") and file.is_file():
                data = base64.b64encode(file.read_bytes()).decode()
                element["uri"] = "data:application/octet-stream;base64," + data
        return json.dumps(document).encode()
    except (ValueError, AttributeError, TypeError, OSError):
        return content


def glb_of(gltf):
    text = gltf + b" " * (-len(gltf) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


def models(folder, scenes, assets):
    sources = sorted(scenes.glob("*.glb"))
    if assets:
        sources += sorted(path for path in assets.rglob("*") if path.suffix in (".glb", ".gltf"))
    for number, path in enumerate(sources):
        content = path.read_bytes() if path.suffix == ".glb" else inlined(path)
        for target in ("loader", "container"):
            write(folder / target, f"{number:03}_{path.name}", content)
        if path.suffix == ".gltf":
            write(folder / "loader", f"{number:03}_{path.stem}.glb", glb_of(content))


def images(folder, assets):
    sources = sorted((TESTS / "golden").glob("*.png")) + sorted((TESTS / "gallery").glob("*.png"))
    if assets:
        sources += sorted(path for path in assets.rglob("*") if path.suffix in (".png", ".jpg", ".jpeg", ".webp"))
    for number, path in enumerate(sources):
        write(folder / "image", f"{number:03}_{path.name}", path.read_bytes())
    for name, text in WEBP.items():
        write(folder / "image", f"{name}.webp", base64.b64decode(text))


def text_of(body):
    """A body is text, or a list of text and [text, how often]."""
    pieces = [body] if isinstance(body, str) else body
    return "".join(piece if isinstance(piece, str) else piece[0] * min(piece[1], 200) for piece in pieces)


def requests(folder):
    for path in sorted((TESTS / "bad_requests").glob("*.json")):
        request = json.loads(path.read_text())["request"]
        write(folder / "json", path.name, text_of(request.get("body", "")).encode("utf-8", "surrogateescape"))
        write(folder / "query", path.name, request.get("path", "/").encode())
    for path in sorted((TESTS / "golden").glob("*.json")) + sorted((TESTS / "hard_cases").glob("*.json")):
        document = json.loads(path.read_text())
        for key in ("spec", "request", "frame"):
            if isinstance(document.get(key), dict):
                write(folder / "json", f"{key}_{path.name}", json.dumps(document[key]).encode())
    for number, query in enumerate(("width=64&height=48&sun=30,45&view=shadow&format=exr", "camera.orbit.azimuthDegrees=30",
                                    "lights=[]&views=[%22color%22]", "camera.near=0.1&quality=high")):
        write(folder / "query", f"good_{number}", f"/v1/scenes/abc/frame?{query}".encode())


def heads(folder):
    trace = "traceparent: 00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01"
    for number, lines in enumerate((
        ("GET / HTTP/1.1", "Host: a", "X-Forwarded-For: 203.0.113.9, [2001:db8::1]:80, 10.0.0.7", trace),
        ("POST http://a:1/v1/scenes HTTP/1.1", "Host: b", "Transfer-Encoding: chunked", "Expect: 100-continue"),
        ("GET /x?y=%20 HTTP/1.0", "Connection: keep-alive", "Content-Length: 3", "X-Request-ID: a-b.c"),
        ("GET / HTTP/1.1", "Host: a", 'Forwarded: for=192.0.2.1;proto=https, For="[fd00::1]:9";by=_x, for="10.0.0.1"'),
    )):  # fmt: skip
        write(folder / "head", f"good_{number}", ("\r\n".join(lines) + "\r\n\r\n").encode())


def forms(folder, scenes):
    model = (scenes / "single_triangle.glb").read_bytes()
    for name, parts in {
        "scene": [("scene", None, model)],
        "files": [("scene", "a.gltf", b"{}"), ("file", "b.bin", b"1234"), ("textures/c.png", None, b"\x89PNG")],
        "spec": [("spec", None, b"{}"), ("scene", "a b\".glb", b"glTF")],
    }.items():
        body = f"multipart/form-data; boundary={BOUNDARY}\n".encode()
        for part, file_name, content in parts:
            body += f'--{BOUNDARY}\r\nContent-Disposition: form-data; name="{part}"'.encode()
            if file_name is not None:
                body += f'; filename="{file_name}"'.encode()
            body += b"\r\nContent-Type: application/octet-stream\r\n\r\n" + content + b"\r\n"
        write(folder / "multipart", name, body + f"--{BOUNDARY}--\r\n".encode())
    entries = [("", b"{}"), ("b.bin", b"1234")]
    stored = b"gnomon bundle 1\n" + b"".join(
        struct.pack("<IQ", len(name), len(content)) + name.encode() + content for name, content in entries
    )
    write(folder / "multipart", "stored", stored)


def bodies(folder):
    chunks = b"5\r\nhello\r\n1 ;ext=\"1\"\r\n,\r\n00A\r\n0123456789\r\n0\r\nTrailer: x\r\n\r\nGET / HTTP/1.1\r\n"
    for first in (0, 6, 2, 9):
        write(folder / "body", f"chunks_{first}", bytes([first]) + chunks)
    write(folder / "body", "length", bytes([1]) + b"sixteen bytes ..GET / HTTP/1.1\r\n")


def grids(folder):
    shape = "'shape': (2, 1, 3), }\n"
    for name, descr, numbers in (("float32", "<f4", struct.pack("<6f", 0, 1, -2, 0.5, 1e9, 3)),
                                 ("float16", "<f2", struct.pack("<6e", 0, 1, -2, 0.5, 1000, 3)), ("uint8", "|u1", bytes(range(6)))):
        header = f"{{'descr': '{descr}', 'fortran_order': False, {shape}".encode()
        write(folder / "npy", name, b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header + numbers)
        write(folder / "npy", f"{name}_2", b"\x93NUMPY\2\0" + struct.pack("<I", len(header)) + header + numbers)
    vdb = zlib.decompress(base64.b64decode(VDB))
    write(folder / "vdb", "grid", vdb)
    write(folder / "vdb", "cut", vdb[:4000])


def environments(folder):
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 4 +X 8\n"
    dim, sun = b"\x80\x40\x20\x78", b"\x80\x80\x80\x90"
    write(folder / "environment", "flat", head + dim * 9 + sun + dim * 22)
    write(folder / "environment", "runs", head + (dim + b"\1\1\1\7") * 4)
    row = b"\2\2\0\x08" + b"\x88\x80" + b"\x08" + bytes(range(8)) + b"\x84\x20\4    " + b"\x88\x81"
    write(folder / "environment", "planes", head.replace(b"RADIANCE", b"RGBE") + row * 4)
    write(folder / "environment", "cut", head + row)


def messages(folder):
    """What the front and a worker tell each other."""
    texts = (
        {"order": {"number": 1, "kind": "frame", "scene": "ab" * 32, "isStored": True, "milliseconds": 60000.5,
                   "mediaType": "image/png", "boundary": "gnomon-1", "light": 0}},
        {"start": {"device": "cpu", "backend": "auto", "sceneMemoryBytes": 1 << 30, "keepsLightMaps": True}},
        {"cancel": {"number": 1}},
        {"forget": {"scene": "ab" * 32}},
        {"lightMap": {"number": 1}},
        {"outcome": {"number": 1, "problems": [{"code": "tooLarge", "pointer": "/views", "detail": "No."}],
                     "stages": {"load": 1.5, "shade": 2}}},
        {"event": {"number": 1, "name": "progress", "data": "{}"}},
        {"beat": {"scenes": 1, "sceneBytes": 100, "costFactors": [1e-6] * 11}},
        {"ready": {"backend": "cpu", "software": True, "device": "cpu"}},
        {"refusal": {"problems": [{"code": "backend", "pointer": "", "detail": "No."}]}},
        {"request": {"number": 1, "key": "ab" * 32 + "-" + "cd" * 32}},
        {"made": {"key": "ab" * 32 + "-" + "cd" * 32}},
    )
    for text in texts:
        write(folder / "messages", next(iter(text)), json.dumps(text).encode())


def answers(folder):
    """What workers say to an order, line by line, and notes of frames: behind a byte that chooses the order."""
    picture = {"view": "color", "contentType": "image/png", "bytes": 5, "width": 0, "height": 0}
    news = [{"drawn": {"carried": {"depthRanges": []}, "warnings": ["None."]}, "pictures": []},
            {"pictures": [picture, {**picture, "view": "depth"}]}]  # fmt: skip
    events = [{"event": {"number": 1, "name": "news", "data": json.dumps(each)}} for each in news]
    stages = {"queue": 1, "shade": 2.5}
    outcome = {"number": 1, "contentType": "application/octet-stream", "stages": stages, "warnings": ["None."]}
    frame = [*events, {"outcome": outcome}]
    problem = [{"outcome": {"number": 1, "problems": [{"code": "busy", "pointer": "", "detail": "No."}]}}]
    row = {"event": {"number": 1, "name": "row", "data": "{}"}}
    kinds = 9  # as the target has them, in each of its media types
    for name, choice, messages_sent in (("frame", 7, frame), ("problem", 1, problem), ("row", 3 + 3 * kinds, [row])):
        text = "\n".join(json.dumps(message) for message in messages_sent) + "\nbody"
        write(folder / "replies", name, bytes([2 * choice]) + text.encode())
    png = [{"outcome": {**outcome, "contentType": "image/png"}}]
    write(folder / "replies", "png", bytes([2]) + json.dumps(png[0]).encode() + b"\nbody")
    note = {"contentKey": "ab" * 32, "carried": {"depthRanges": []}, "warnings": [], "stages": stages,
            "milliseconds": 3, "pictures": [picture]}  # fmt: skip
    for more in (0, 1):
        write(folder / "replies", f"note_{more}", bytes([1 + 2 * more]) + json.dumps(note).encode())


def replies(folder):
    """What Redis answers (RESP2), behind the size of the pieces that it comes in."""
    texts = {"status": b"+OK\r\n+PONG\r\n", "error": b"-NOSCRIPT No matching script.\r\n", "integer": b":-12\r\n",
             "bytes": b"$5\r\na\0b\r\n\r\n$0\r\n\r\n", "nothing": b"$-1\r\n*-1\r\n",
             "list": b"*3\r\n$1\r\na\r\n:7\r\n*2\r\n$-1\r\n*0\r\n",
             "message": b"*3\r\n$7\r\nmessage\r\n$4\r\ngone\r\n$2\r\nid\r\n"}  # fmt: skip
    for name, text in texts.items():
        for piece in (0, 6, 254):
            write(folder / "redis", f"{name}_{piece}", bytes([piece]) + text)


def choices(folder):
    """Scenes and specs, for both devices and with extreme numbers: any bytes are some."""
    for number in range(24):
        write(folder / "devices", f"{number:03}", random.Random(number).randbytes(200 + 50 * number))
        write(folder / "extremes", f"{number:03}", random.Random(number).randbytes(600 + 50 * number))


def main(folder, scenes, assets=None):
    folder, scenes = Path(folder), Path(scenes)
    shutil.rmtree(folder, ignore_errors=True)
    assets = Path(assets) if assets and Path(assets).is_dir() else None
    models(folder, scenes, assets)
    images(folder, assets)
    requests(folder)
    heads(folder)
    forms(folder, scenes)
    bodies(folder)
    messages(folder)
    answers(folder)
    replies(folder)
    grids(folder)
    environments(folder)
    choices(folder)
    for target in sorted(folder.iterdir()):
        print(f"{target.name}: {len(list(target.iterdir()))} seeds")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Draws every model of a folder, each with its name, onto one PNG to be looked at.

usage: contact_sheet.py [--build FOLDER] [--server ADDRESS] [--models FOLDER] [--spec JSON] [NAME...] PNG

  --build FOLDER    where the program was built (default: build/release beside the sources)
  --server ADDRESS  HOST:PORT of a running server; without it, one is started on a free port
  --models FOLDER   the models (default: ../shared/assets/models beside the sources)
  --spec JSON       a JSON merge patch (RFC 7396) on the request of each
  NAME...           only models whose path holds one of these

Each is seen as the server frames a scene when nothing is asked, in one sun before a light background. A model that
cannot be drawn has its problem in the place of a picture. Exit status 1 where there is one.
"""

import argparse
import json
import os
import sys
import textwrap
from pathlib import Path
from urllib.parse import unquote

import small_png
from make_gallery import HERE, Server, merged
from small_text import LINE_HEIGHT, draw_text

WIDTH, HEIGHT, COLUMNS = 240, 180, 8
PAPER = b"\xff\xff\xff"
SPEC = {
    "width": WIDTH,
    "height": HEIGHT,
    "antialiasing": "msaa4x",
    "lights": [{"sun": {"azimuthDegrees": 225, "elevationDegrees": 45}, "intensity": 3}],
    "background": {"color": [0.8, 0.8, 0.8]},
    "output": {"format": "png"},
}


def files_of(model):
    """(name, bytes) of the model and of every file that it names, the model first."""
    data = model.read_bytes()
    named = []
    if model.suffix == ".gltf":
        document = json.loads(data)
        uris = [item.get("uri", "") for key in ("buffers", "images") for item in document.get(key, [])]
        named = sorted({unquote(uri) for uri in uris if uri and not uri.startswith("data:")})
    there = [(name, model.parent / name) for name in named if (model.parent / name).is_file()]
    return [(model.name, data)] + [(name, path.read_bytes()) for name, path in there]


def form(files, spec):
    """(body, content type) of POST /v1/render."""
    line = "a-line-between-the-parts-of-a-sheet"
    parts = [("scene", *files[0])] + [("file", *file) for file in files[1:]]
    body = b"".join(
        f'--{line}\r\nContent-Disposition: form-data; name="{field}"; filename="{name}"\r\n\r\n'.encode() + data + b"\r\n"
        for field, name, data in parts
    )
    body += f'--{line}\r\nContent-Disposition: form-data; name="spec"\r\n\r\n{json.dumps(spec)}\r\n--{line}--\r\n'.encode()
    return body, f"multipart/form-data; boundary={line}"


def said(reply):
    """What a refusal says, short."""
    try:
        problems = json.loads(reply)["problems"]
        return "; ".join(problem["detail"] for problem in problems)
    except (ValueError, KeyError):
        return reply[:200].decode(errors="replace")


def cell(name, picture, text):
    """The picture with its name below, or with a text in its place."""
    rows = [bytearray(row) for row in picture.rows] if picture else [bytearray(PAPER * WIDTH) for _ in range(HEIGHT)]
    for i, line in enumerate(textwrap.wrap(text, 26)):
        draw_text(rows, 4, 4 + i * LINE_HEIGHT, line, b"\xc0\x00\x00")
    label = [bytearray(PAPER * WIDTH) for _ in range(LINE_HEIGHT + 3)]
    draw_text(label, 2, 2, name, b"\x20\x20\x20")
    return small_png.Picture(WIDTH, HEIGHT + len(label), [bytes(row) for row in rows + label])


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1].removeprefix("usage: "))
    parser.add_argument("--build", type=Path, default=HERE.parents[1] / "build" / "release")
    parser.add_argument("--server")
    parser.add_argument("--models", type=Path, default=HERE.parents[2] / "shared" / "assets" / "models")
    parser.add_argument("--spec", type=json.loads, default={})
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("png", type=Path)
    options = parser.parse_args()
    models = sorted(path for path in options.models.rglob("*") if path.suffix in (".glb", ".gltf"))
    models = [m for m in models if not options.names or any(name in str(m) for name in options.names)]
    if not models:
        sys.exit(f"there are no models in {options.models}")
    spec, cells, failed = merged(SPEC, options.spec), [], 0
    with Server(options.server, options.build / "bin" / "gnomon") as server:
        for model in models:
            name = str(model.relative_to(options.models).parent).replace("glTF-", "").replace(os.sep, " ")
            status, reply = server.ask("/v1/render", *form(files_of(model), spec), "image/png")
            picture = small_png.read(reply) if status == 200 else None
            cells.append(cell(name, picture, "" if picture else said(reply)))
            failed += picture is None
    options.png.write_bytes(small_png.write_whole(small_png.sheet(cells, COLUMNS)))
    print(f"{len(models)} models, {failed} of them not drawn: {options.png}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

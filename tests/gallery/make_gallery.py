#!/usr/bin/env python3
"""Asks a server for every picture of pictures.json, and writes them as small PNGs, with README.md that shows them.

usage: make_gallery.py [--build FOLDER] [--server ADDRESS] [NAME...]

  --build FOLDER    where the program and the scenes were built (default: build/release beside the sources)
  --server ADDRESS  HOST:PORT of a running server; without it, one is started on a free port
  NAME...           only these pictures; the page still shows all that are there

An entry of pictures.json: name, title, caption, scene, files beside it (of tests/scenes), request (a FrameSpec), and for
several pictures side by side variants (what each changes in the request, as JSON merge patches, RFC 7396) and columns.
"""

import argparse
import copy
import http.client
import json
import subprocess
import sys
from pathlib import Path

import small_png

HERE = Path(__file__).resolve().parent
WIDTH, HEIGHT = 480, 270  # of a single picture; a variant is as wide as its column

HEAD = """# Gallery

One picture for each feature, each made by the request under it, sent to `POST /v1/scenes/{id}/frames`. Scenes are those
of `server/demo` and `tests/scenes`. `make_gallery.py` makes the pictures and this page from `pictures.json`.
"""


class Server:
    """A running server, or one that is started and ended here."""

    def __init__(self, address, binary):
        self.process = None
        if address is None:
            self.process = subprocess.Popen([binary, "serve", "--until-stdin-closes", "--port", "0"],
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL, text=True)
            line = self.process.stdout.readline()
            if not line.startswith("listening on http://"):
                sys.exit(f"the server did not start: {line}")
            address = line.removeprefix("listening on http://").strip()
        self.address = address
        self.scenes = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process is not None:
            self.process.terminate()
            self.process.wait()

    def ask(self, path, body, kind, accept="*/*"):
        connection = http.client.HTTPConnection(self.address, timeout=600)
        try:
            connection.request("POST", path, body, {"Content-Type": kind, "Accept": accept})
            reply = connection.getresponse()
            return reply.status, reply.read()
        finally:
            connection.close()

    def scene(self, file, others):
        if (file, *others) not in self.scenes:
            if others:
                kind, body = form({"scene": file, **{other.name: other for other in others}})
            else:
                kind, body = "model/gltf-binary", file.read_bytes()
            status, reply = self.ask("/v1/scenes", body, kind)
            if status not in (200, 201):
                sys.exit(f"{file}: {reply.decode()}")
            self.scenes[(file, *others)] = json.loads(reply)["id"]
        return self.scenes[(file, *others)]

    def picture(self, scene, others, request):
        """A Picture, or the problems as a text."""
        status, body = self.ask(f"/v1/scenes/{self.scene(scene, others)}/frames", json.dumps(request),
                                "application/json", "image/png")
        return small_png.read(body) if status == 200 else body.decode()


def form(files):
    """Content-Type and body of a form whose parts are files."""
    boundary = "gallery-of-gnomon"
    body = b"".join(f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n'.encode() +
                    file.read_bytes() + b"\r\n" for name, file in files.items())
    return f"multipart/form-data; boundary={boundary}", body + f"--{boundary}--\r\n".encode()


def merged(target, patch):
    """RFC 7396."""
    if not isinstance(patch, dict):
        return copy.deepcopy(patch)
    result = copy.deepcopy(target) if isinstance(target, dict) else {}
    for key, value in patch.items():
        if value is None:
            result.pop(key, None)
        else:
            result[key] = merged(result.get(key), value)
    return result


def requests_of(entry):
    """What is asked for, with a size where the entry names none."""
    columns = entry.get("columns", 1)
    size = {"width": (2 * WIDTH if columns > 1 else WIDTH) // columns}
    size["height"] = size["width"] * HEIGHT // WIDTH
    base = merged(size, entry["request"])
    return [merged(base, patch) for patch in entry.get("variants", [{}])]


def scene_file(build, name):
    return build / "share/gnomon/demo.glb" if name == "demo" else build / f"tests/scenes/{name}.glb"


def make(server, build, entry):
    """True where the picture was made."""
    scene = scene_file(build, entry["scene"])
    if not scene.exists():
        print(f"{entry['name']}: there is no scene {scene}")
        return False
    others = [build / "tests/scenes" / name for name in entry.get("files", [])]
    pictures = []
    for request in requests_of(entry):
        made = server.picture(scene, others, request)
        if isinstance(made, str):
            print(f"{entry['name']}: {made}")
            return False
        pictures.append(made)
    data = small_png.write(small_png.sheet(pictures, entry.get("columns", 1)))
    (HERE / f"{entry['name']}.png").write_bytes(data)
    print(f"{entry['name']}: {len(data) // 1024} KiB")
    return True


def section(entry):
    request = {"scene": entry["scene"], "request": entry["request"]}
    if "variants" in entry:
        request["variants"] = entry["variants"]
    text = json.dumps(request["request"], indent=None)
    scene = " and ".join(f"<code>{name}</code>" for name in [entry["scene"], *entry.get("files", [])])
    lines = [f"\n## {entry['title']}\n", f"![{entry['title']}]({entry['name']}.png)\n", entry["caption"] + "\n",
             f"<details>\n<summary>Request, scene {scene}</summary>\n", f"```json\n{text}\n```\n"]
    if "variants" in entry:
        lines.append("and for each picture, changed by\n")
        lines.append("```json\n" + "\n".join(json.dumps(patch) for patch in entry["variants"]) + "\n```\n")
    return "\n".join(lines + ["</details>\n"])


def page(entries):
    return HEAD + "".join(section(entry) for entry in entries if (HERE / f"{entry['name']}.png").exists())


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1].removeprefix("usage: "))
    parser.add_argument("--build", type=Path, default=HERE.parent.parent / "build/release")
    parser.add_argument("--server")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    entries = json.loads((HERE / "pictures.json").read_text(encoding="utf-8"))
    unknown = set(arguments.names) - {entry["name"] for entry in entries}
    if unknown:
        sys.exit(f"no picture is called {', '.join(sorted(unknown))}")
    with Server(arguments.server, arguments.build / "bin/gnomon") as server:
        wanted = [entry for entry in entries if not arguments.names or entry["name"] in arguments.names]
        made = [make(server, arguments.build, entry) for entry in wanted]
    (HERE / "README.md").write_text(page(entries), encoding="utf-8")
    return 0 if all(made) else 1


if __name__ == "__main__":
    sys.exit(main())

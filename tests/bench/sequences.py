#!/usr/bin/python3
"""A sequence beside the same frames asked for one by one over a kept connection, and drawn one after the other as a client
would that waits for each: the two take turns, and the picture bytes are compared. Prints milliseconds a frame and their
ratio.

usage: tests/bench/sequences.py BINARY SCENE.glb [--frames N] [--rounds N] [--size WxH]
"""

import argparse
import http.client
import json
import math
import statistics
import subprocess
import time
import zipfile
from io import BytesIO
from pathlib import Path


def path_of(frames, eye, target):
    """Patches of a camera that goes around its target by a degree a frame."""
    x, y, z = (e - t for e, t in zip(eye, target))
    patches = []
    for i in range(frames):
        c, s = math.cos(math.radians(i)), math.sin(math.radians(i))
        patches.append({"camera": {"eye": [target[0] + c * x + s * z, target[1] + y, target[2] - s * x + c * z]}})
    return patches


def ask(connection, path, body, accept):
    connection.request("POST", path, json.dumps(body), {"Content-Type": "application/json", "Accept": accept})
    reply = connection.getresponse()
    content = reply.read()
    if reply.status != 200:
        raise SystemExit(f"{path}: {reply.status} {content[:500].decode()}")
    return content


def one_by_one(address, scene, spec, patches):
    """What a client does today for stable shadows: it passes each report's depth range on."""
    connection = http.client.HTTPConnection(*address)
    pictures, previous = [], {"near": 1e-3, "far": 1e6}
    start = time.perf_counter()
    for patch in patches:
        shadow = {"technique": "shadowMap", "stabilization": "projectionSnapping", "depthRange": {"previous": previous}}
        body = spec | {"camera": spec["camera"] | patch["camera"], "shadow": shadow}
        content = ask(connection, f"/v1/scenes/{scene}/frames", body, "multipart/mixed")
        report, picture = content.split(b"\r\n\r\n", 2)[1:]
        ranges = [light.get("depthRange") for light in json.loads(report.split(b"\r\n--")[0])["lights"]]
        previous = next((known for known in ranges if known), previous)
        pictures.append(picture.rsplit(b"\r\n--", 1)[0])
    return time.perf_counter() - start, pictures


def as_sequence(address, scene, spec, patches):
    connection = http.client.HTTPConnection(*address)
    start = time.perf_counter()
    content = ask(connection, f"/v1/scenes/{scene}/sequences", {"spec": spec, "frames": patches}, "application/zip")
    took = time.perf_counter() - start
    with zipfile.ZipFile(BytesIO(content)) as archive:
        return took, [archive.read(name) for name in archive.namelist() if name.startswith("frame-")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--frames", type=int, default=40)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--eye", type=float, nargs=3, default=[6, 4, 6])
    parser.add_argument("--target", type=float, nargs=3, default=[0, 0.5, 0])
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    spec = {"width": width, "height": height, "camera": {"eye": options.eye, "target": options.target}}
    patches = path_of(options.frames, options.eye, options.target)
    server = subprocess.Popen([options.binary, "serve", "--until-stdin-closes", "--port", "0"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True)
    try:
        host, port = server.stdout.readline().removeprefix("listening on http://").strip().rsplit(":", 1)
        address = (host, int(port))
        connection = http.client.HTTPConnection(*address)
        connection.request("POST", "/v1/scenes", options.scene.read_bytes(), {"Content-Type": "model/gltf-binary"})
        scene = json.loads(connection.getresponse().read())["id"]
        as_sequence(address, scene, spec, patches[:2])  # loads the scene
        singles, sequences = [], []
        for _ in range(options.rounds):
            took, expected = one_by_one(address, scene, spec, patches)
            singles.append(took)
            took, pictures = as_sequence(address, scene, spec, patches)
            sequences.append(took)
            if pictures != expected:
                raise SystemExit("the pictures differ")
    finally:
        server.kill()
        server.wait()
    single, sequence = (1000 * statistics.median(times) / options.frames for times in (singles, sequences))
    print(f"{options.scene.name} {options.size}, {options.frames} frames, median of {options.rounds}: one by one "
          f"{single:.1f} ms a frame, as a sequence {sequence:.1f} ms, ratio {sequence / single:.2f}")


if __name__ == "__main__":
    main()

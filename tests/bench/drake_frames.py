"""What a frame of POST /render costs while the camera moves. It stands inside the model there, so that every upload is a
file never seen before. Tells the ratio of such frames to the first one, and to frames of the stored scene.

usage: drake_frames.py GNOMON MODEL.glb [FRAMES]
"""

import base64
import hashlib
import http.client
import json
import math
import statistics
import struct
import subprocess
import sys
import time
from pathlib import Path

WIDTH, HEIGHT = 640, 480
FOCAL = 580.0
NEAR, FAR = 0.1, 1e6
# What /render draws with, for the stored scene.
DRAWN = {"width": WIDTH, "height": HEIGHT, "lights": [{"direction": [-0.4, 0.3, -1]}], "toneMapping": "none"}


def embedded(glb):
    """The glTF of a GLB as a client without files sends it: buffers and images as data: URIs."""
    length = struct.unpack_from("<I", glb, 12)[0]
    gltf = json.loads(glb[20 : 20 + length])
    binary = glb[20 + length + 8 :]
    for image in gltf.get("images", []):
        view = gltf["bufferViews"][image.pop("bufferView")]
        start = view.get("byteOffset", 0)
        content = base64.b64encode(binary[start : start + view["byteLength"]]).decode()
        image["uri"] = f"data:{image.pop('mimeType')};base64,{content}"
    gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    return gltf


def with_camera(gltf, place):
    """The same model with a camera of this place."""
    moved = dict(gltf)
    cameras = gltf.get("cameras", [])
    moved["cameras"] = [*cameras, {"type": "perspective", "perspective": {"yfov": 0.8, "znear": NEAR, "zfar": FAR}}]
    moved["nodes"] = gltf["nodes"] + [{"name": "Camera Node", "camera": len(cameras), "matrix": place}]
    moved["scenes"] = [dict(gltf["scenes"][0], nodes=gltf["scenes"][0]["nodes"] + [len(gltf["nodes"])])]
    moved["scene"] = 0
    return json.dumps(moved).encode()


def around(angle, center, distance):
    """Column by column: on a circle, looking at its middle."""
    sine, cosine = math.sin(angle), math.cos(angle)
    eye = [center[0] + distance * sine, center[1] + 0.3 * distance, center[2] + distance * cosine]
    back = [sine, 0.3, cosine]
    back = [x / math.hypot(*back) for x in back]
    right = [cosine, 0, -sine]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
          back[0] * right[1] - back[1] * right[0]]
    return [*right, 0, *up, 0, *back, 0, *eye, 1]


def form(parts):
    boundary = "drake-frames"
    body = b""
    for name, content in parts:
        head = f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n'
        body += head.encode() + (content if isinstance(content, bytes) else content.encode()) + b"\r\n"
    return body + f"--{boundary}--\r\n".encode(), {"Content-Type": f"multipart/form-data; boundary={boundary}"}


def fields(scene):
    """A form as Drake sends it for a color picture."""
    numbers = {"width": WIDTH, "height": HEIGHT, "near": NEAR, "far": FAR, "focal_x": FOCAL, "focal_y": FOCAL,
               "fov_x": 2 * math.atan(WIDTH / 2 / FOCAL), "fov_y": 2 * math.atan(HEIGHT / 2 / FOCAL),
               "center_x": WIDTH / 2 - 0.5, "center_y": HEIGHT / 2 - 0.5}  # fmt: skip
    digest = hashlib.sha256(scene).hexdigest()
    return [("image_type", "color"), ("scene_sha256", digest), ("scene", scene),
            *((name, str(value)) for name, value in numbers.items())]  # fmt: skip


def ask(connection, method, path, body=None, headers={}):
    start = time.perf_counter()
    connection.request(method, path, body, headers)
    reply = connection.getresponse()
    content = reply.read()
    if reply.status not in (200, 201, 204):
        sys.exit(content.decode())
    return (time.perf_counter() - start) * 1000, reply, content


def stages(replies):
    times = {}
    for reply in replies:
        for entry in (reply.getheader("Server-Timing") or "").split(", "):
            name, _, duration = entry.partition(";dur=")
            times.setdefault(name, []).append(float(duration or 0))
    return ", ".join(f"{name} {statistics.median(values):.1f}" for name, values in times.items())


def main():
    binary, model, frames = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 50
    gltf = embedded(model.read_bytes())
    server = subprocess.Popen([binary, "serve", "--until-stdin-closes", "--port", "0", "--device", "cpu"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.DEVNULL)
    try:
        host = server.stdout.readline().removeprefix("listening on http://").strip()
        connection = http.client.HTTPConnection(host)
        _, _, summary = ask(connection, "POST", "/v1/scenes", with_camera(gltf, around(0, (0, 0, 0), 1)),
                            {"Content-Type": "model/gltf+json"})
        summary = json.loads(summary)
        low, high = summary["boundsMin"], summary["boundsMax"]
        center = [(a + b) / 2 for a, b in zip(low, high)]
        distance = math.dist(low, high)
        ask(connection, "DELETE", "/v1/scenes/" + summary["id"])
        times, replies = [], []
        for frame in range(frames):
            body, headers = form(fields(with_camera(gltf, around(0.02 * frame, center, distance))))
            spent, reply, _ = ask(connection, "POST", "/render", body, headers)
            times.append(spent)
            replies.append(reply)
        _, _, stored = ask(connection, "POST", "/v1/scenes", with_camera(gltf, around(0, center, distance)),
                           {"Content-Type": "model/gltf+json"})
        path = "/v1/scenes/" + json.loads(stored)["id"] + "/frames"
        stored_times, stored_replies = [], []
        for frame in range(frames):
            matrix = around(0.02 * frame, center, distance)
            rows = [[matrix[4 * column + row] for column in range(4)] for row in range(4)]
            camera = {"pose": {"worldFromCamera": rows},
                      "intrinsics": {"fx": FOCAL, "fy": FOCAL, "near": NEAR, "far": FAR}}  # fmt: skip
            spec = json.dumps(DRAWN | {"camera": camera})
            spent, reply, _ = ask(connection, "POST", path, spec, {"Content-Type": "application/json"})
            stored_times.append(spent)
            stored_replies.append(reply)
    finally:
        server.kill()
        server.wait()
    later, kept = statistics.median(times[1:]), statistics.median(stored_times[1:])
    print(f"{model.name}: first {times[0]:.0f} ms; later {later:.1f} ms, {later / times[0]:.2f} of the first; "
          f"stored {kept:.1f} ms, of which later are {later / kept:.2f} times")
    print("  later: ", stages(replies[1:]))
    print("  stored:", stages(stored_replies[1:]))
    print("  first: ", stages(replies[:1]))


if __name__ == "__main__":
    main()

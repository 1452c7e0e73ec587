"""What the measurements of many replicas share: scenes that differ, a Zipf mix of them, and clients that ask for frames."""

import http.client
import json
import os
import re
import statistics
import struct
import sys
import threading
import time
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "e2e"))


def use_binary(binary):
    """Has the support of the end-to-end tests start this program."""
    os.environ["GNOMON_BINARY"] = str(Path(binary).resolve())
    os.environ.setdefault("GNOMON_TEST_SCENES", "")


def terrain(seed, side):
    """A GLB of hills under a sun, another one for each seed: side x side quads."""
    random = numpy.random.default_rng(seed)
    along = numpy.linspace(-10, 10, side + 1, dtype=numpy.float32)
    x, z = numpy.meshgrid(along, along)
    y = sum(random.uniform(0.1, 0.5) * numpy.sin(random.uniform(0.3, 2) * x + random.uniform(0.3, 2) * z + random.uniform(0, 6))
            for _ in range(6)).astype(numpy.float32)  # fmt: skip
    points = numpy.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (numpy.arange(side)[:, None] * (side + 1) + numpy.arange(side)[None, :]).ravel()
    quads = numpy.stack([corner, corner + side + 1, corner + 1, corner + 1, corner + side + 1, corner + side + 2], axis=-1)
    indices = quads.astype(numpy.uint32).tobytes()
    content = points.tobytes() + indices
    description = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3}]}},
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"rotation": [-0.38, 0.2, 0, 0.9], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
             "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()},
            {"bufferView": 1, "componentType": 5125, "count": quads.size, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": points.nbytes},
                        {"buffer": 0, "byteOffset": points.nbytes, "byteLength": len(indices)}],
        "buffers": [{"byteLength": len(content)}],
    }  # fmt: skip
    text = json.dumps(description).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(content), 0x004E4942) + content
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def zipf_mix(count, requests, exponent, seed):
    """Which of `count` scenes each request is for: the k-th most popular with a probability as 1 / k ** exponent."""
    weights = 1 / numpy.arange(1, count + 1) ** exponent
    return numpy.random.default_rng(seed).choice(count, requests, p=weights / weights.sum()).tolist()


@dataclass
class Sample:
    """One frame as its client saw it."""

    begun: float  # seconds, of the monotonic clock
    seconds: float
    status: int  # 0 = the reply was cut off, or there was none
    replica: str
    load_ms: float  # the stage `load`
    work_ms: float  # all other stages but waiting
    queue_ms: float  # waiting
    scene: int


def drive(connect, scenes, mix, clients, spec, start=0, seconds=None):
    """Frames of `mix`, which names one of `scenes` for each, asked for by some clients, each on a kept connection, as soon as
    one of them is free, or at `seconds` from now; every frame has an exposure of its own, so that no picture is kept for
    it."""
    zero = time.monotonic()
    samples, lock, numbers = [], threading.Lock(), iter(enumerate(mix, start))

    def client():
        connection = connect()
        while True:
            with lock:
                number, index = next(numbers, (None, None))
            if number is None:
                return connection.close()
            body = json.dumps(spec | {"exposure": 1 + number / 1e6})
            if seconds:
                time.sleep(max(0.0, zero + seconds[number - start] - time.monotonic()))
            begun, status, replica, stages = time.monotonic(), 0, "", {}
            try:
                connection.request("POST", f"/v1/scenes/{scenes[index]}/frames", body, {"Content-Type": "application/json"})
                reply = connection.getresponse()
                reply.read()
                status, replica = reply.status, reply.headers.get("X-Served-By", "")
                stages = dict(re.findall(r"(\w+);dur=([\d.]+)", reply.headers.get("Server-Timing", "")))
            except (OSError, http.client.HTTPException):
                connection.close()
            stages = {name: float(each) for name, each in stages.items()}
            samples.append(Sample(begun, time.monotonic() - begun, status, replica, stages.pop("load", 0),
                                  queue_ms=stages.pop("queue", 0), work_ms=sum(stages.values()), scene=index))  # fmt: skip

    threads = [threading.Thread(target=client) for _ in range(clients)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return samples


def put_all(ask, bodies):
    """The ids of scenes that are now stored."""
    ids = []
    for body in bodies:
        ids.append(sha256(body).hexdigest())
        reply = ask("PUT", f"/v1/scenes/{ids[-1]}", body, {"Content-Type": "model/gltf-binary"})
        if reply.status not in (200, 201):
            sys.exit(f"a scene was refused: {reply.status} {reply.body[:500].decode()}")
    return ids


def load_counts(servers):
    """(frames whose scene was in memory, frames) of all servers, by their metrics: what is found in memory takes some
    microseconds, and no load of a file is done within a millisecond."""
    found = frames = 0
    for server in servers:
        text = server.get("/metrics").body.decode()
        found += float(re.search(r'^gnomon_stage_duration_seconds_bucket\{stage="load",le="0.001"\} (\S+)', text, re.M)[1])
        frames += float(re.search(r'^gnomon_stage_duration_seconds_count\{stage="load"\} (\S+)', text, re.M)[1])
    return numpy.array([found, frames])


def median(values):
    return statistics.median(values) if values else float("nan")

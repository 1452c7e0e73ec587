#!/usr/bin/python3
"""Jobs on replicas that die: N small frames as two jobs, one whose frames are drawn in any order and one whose frames each take
what the one before left, on three replicas with one Redis (append-only file) and one store. Each replica is killed (SIGKILL)
twice and started again, and Redis once, after random numbers of frames. Then every frame has to be there, once, with the bytes
of a quiet run: the same sequences from one server that nobody disturbs. Needs redis-server.

usage: tests/bench/jobs.py BINARY SCENE.glb [--frames N] [--seed N] [--json FILE]
"""

import argparse
import contextlib
import http.client
import io
import json
import os
import random
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import zipfile
from hashlib import sha256
from pathlib import Path

REPLICAS = 3
DEATHS = 2  # of each replica
SPEC = {"width": 64, "height": 36, "camera": {"eye": [6, 4, 6], "target": [0, 0.5, 0]}}
JSON = {"Content-Type": "application/json"}


class Redis:
    def __init__(self, folder):
        self.folder = folder
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            ["redis-server", "--port", str(self.port), "--bind", "127.0.0.1", "--dir", self.folder, "--appendonly", "yes",
             "--save", ""], stdout=subprocess.DEVNULL)
        while True:
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 1):
                return
            time.sleep(0.02)

    def kill(self):
        self.process.kill()
        self.process.wait()


class Fleet:
    """The replicas, and requests to whichever of them lives."""

    def __init__(self, server, flags):
        self.server, self.flags = server, flags
        self.replicas = [server(*flags) for _ in range(REPLICAS)]
        self.refused = 0  # requests that were answered 503, or not at all

    def kill(self, index):
        self.replicas[index].process.kill()
        self.replicas[index].process.wait()

    def start(self, index):
        self.replicas[index].__exit__()
        self.replicas[index] = self.server(*self.flags)

    def ask(self, method, path, body=None, headers=None):
        while True:
            for replica in random.sample(self.replicas, len(self.replicas)):
                with contextlib.suppress(OSError, http.client.HTTPException):
                    reply = replica.ask(method, path, body, headers)
                    if reply.status < 400:
                        return reply
                    if reply.status != 503:
                        raise SystemExit(f"{method} {path}: {reply.status} {reply.body[:500]}")
                self.refused += 1
            time.sleep(0.1)

    def close(self):
        for replica in self.replicas:
            replica.__exit__()


def azimuths(count):
    return [{"camera": {"orbit": {"azimuthDegrees": 360 * i / count - 180, "elevationDegrees": 20 + 30 * i / count,
                                  "distance": 12, "target": [0, 0.5, 0]}, "eye": None, "target": None}} for i in range(count)]


def requests_of(frames):
    """In any order, and one after the other."""
    sun = [{"type": "directional", "direction": [-1, -1.5, -0.5]}]
    alone = frames * 3 // 4
    return {"alone": {"spec": SPEC | {"lights": sun}, "stable": False, "frames": azimuths(alone)},
            "chained": {"spec": SPEC | {"lights": sun}, "frames": azimuths(frames - alone)}}


def quiet_run(server, scene, requests):
    """The digest of every picture, from one server."""
    with server() as quiet:
        upload(quiet, scene)
        name = sha256(scene).hexdigest()
        digests, start = {}, time.monotonic()
        for job, request in requests.items():
            reply = quiet.ask("POST", f"/v1/scenes/{name}/sequences", json.dumps(request), JSON | {"Accept": "application/zip"})
            digests[job] = digests_of(reply.body)
        return digests, time.monotonic() - start


def digests_of(content):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return [(name, sha256(archive.read(name)).hexdigest()) for name in archive.namelist() if name != "report.json"]


def upload(server, scene):
    reply = server.ask("POST", "/v1/scenes", scene, {"Content-Type": "model/gltf-binary"})
    if reply.status not in (200, 201):
        raise SystemExit(f"upload: {reply.status} {reply.body[:500]}")


def disturb(fleet, redis, jobs, frames, events):
    """Kills and starts again, each after so many frames; gives what happened."""
    told, starting = [], []
    start = time.monotonic()
    while True:
        states = [fleet.ask("GET", job["address"]).json() for job in jobs.values()]
        done = sum(state["done"] for state in states)
        while events and done >= events[0][0]:
            _, victim = events.pop(0)
            told.append({"frames": done, "seconds": round(time.monotonic() - start, 1),
                         "killed": "redis" if victim is None else f"replica {victim}"})
            print(f"{done:5} frames, {told[-1]['seconds']:6} s: {told[-1]['killed']} is killed", flush=True)
            if victim is None:
                redis.kill()
                time.sleep(2)
                redis.start()
                continue
            for thread in [each for index, each in starting if index == victim]:
                thread.join()
            fleet.kill(victim)
            thread = threading.Thread(target=fleet.start, args=(victim,))
            thread.start()
            starting.append((victim, thread))
        if all(state["state"] not in ("queued", "running") for state in states):
            break
        time.sleep(0.05)
    for _, thread in starting:
        thread.join()
    return told, states, time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("scene")
    parser.add_argument("--frames", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--json")
    options = parser.parse_args()
    if shutil.which("redis-server") is None:
        raise SystemExit("skipped: redis-server is not installed (apt-get install redis-server)")
    os.environ["GNOMON_BINARY"] = options.binary
    os.environ.setdefault("GNOMON_TEST_SCENES", str(Path(options.scene).parent))
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "e2e"))
    from shipped_server import Server

    scene, requests = Path(options.scene).read_bytes(), requests_of(options.frames)
    expected, quiet_seconds = quiet_run(lambda: Server("--device", "cpu"), scene, requests)
    print(f"seed {options.seed}; {options.frames} frames take one quiet server {quiet_seconds:.1f} s", flush=True)
    random.seed(options.seed)
    victims = [index for index in range(REPLICAS) for _ in range(DEATHS)] + [None]
    random.shuffle(victims)
    times = sorted(random.sample(range(options.frames // 50, options.frames * 9 // 10), len(victims)))
    with tempfile.TemporaryDirectory() as folder:
        redis = Redis(folder)
        fleet = Fleet(Server, ["--device", "cpu", "--workers", "1", "--job-frames", "2", "--store", folder + "/store",
                               "--jobs", f"redis://127.0.0.1:{redis.port}"])
        try:
            upload(fleet.replicas[0], scene)
            path = f"/v1/scenes/{sha256(scene).hexdigest()}/sequences"
            jobs = {name: fleet.ask("POST", path, json.dumps(request), JSON | {"Prefer": "respond-async"}).json()
                    for name, request in requests.items()}
            told, states, seconds = disturb(fleet, redis, jobs, options.frames, list(zip(times, victims)))
            failures = [state for state in states if state["state"] != "done" or state["done"] != state["of"]]
            found = {} if failures else {name: digests_of(fleet.ask("GET", job["result"], headers={"Accept": "application/zip"}).body)
                                         for name, job in jobs.items()}
        finally:
            fleet.close()
            redis.kill()
    there = sum(len({name for name, _ in each}) for each in found.values())
    twice = sum(len(each) for each in found.values()) - there
    different = sum(a != b for name in found for a, b in zip(found[name], expected[name]))
    result = {"frames": options.frames, "seed": options.seed, "events": told, "kills": len(told), "there": there, "twice": twice,
              "different": different, "quietSeconds": round(quiet_seconds, 1), "seconds": round(seconds, 1),
              "refusedMeanwhile": fleet.refused, "failures": failures}
    print(f"{there} of {options.frames} frames are there, {twice} twice, {different} with other bytes; {len(told)} kills; "
          f"{seconds:.1f} s; {fleet.refused} requests found a replica away or Redis away")
    if options.json:
        Path(options.json).write_text(json.dumps(result, indent=2) + "\n")
    if failures or there != options.frames or twice or different or len(told) != len(victims):
        raise SystemExit(f"FAILED {failures}")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""How long the parts of a fleet take on this machine, as JSON for fleet.py: frames and loads of scenes, what the front and
haproxy add, frames on one core and on two, operations of the store and of queues. Needs python3-numpy; haproxy, redis-server
and redis-tools for what they measure, which is left out without them. Give it a quiet machine: `nice -n -19` helps where
there is none.

usage: tests/bench/fleet_services.py BINARY OUTPUT.json [--seconds N] [--store DIRECTORY_OR_URL] [--only NAME]
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy

from replica_load import drive, put_all, terrain, use_binary

DEMO = {"width": 640, "height": 360}
SMALL = {"width": 160, "height": 120}


def cpu_seconds(pid):
    """Of a process and all that it started and that still run."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        children = [each for task in Path(f"/proc/{pid}/task").iterdir() for each in (task / "children").read_text().split()]
    except FileNotFoundError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK") + sum(cpu_seconds(each) for each in children)


def summary(milliseconds):
    values = numpy.array(milliseconds)
    shares = (numpy.arange(20) + 0.5) / 20
    return {"meanMs": values.mean(), "p50Ms": numpy.quantile(values, 0.5), "p95Ms": numpy.quantile(values, 0.95),
            "quantilesMs": numpy.quantile(values, shares).round(3).tolist()}  # fmt: skip


def frames(start, body, spec, seconds, store):
    """A scene's warm frames, one at a time, and its loads: what Server-Timing says, and the processors' time. Two scenes of
    a memory for one make each of their frames load."""
    from shipped_server import Server

    with Server(*start, "--reply-cache-bytes", "0") as server:
        (scene,) = put_all(server.ask, [body])
        drive(server.connect, [scene], [0] * 10, 1, spec)
        before, samples = cpu_seconds(server.process.pid), []
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            samples += drive(server.connect, [scene], [0] * 10, 1, spec, start=10 + len(samples))
        cpu = cpu_seconds(server.process.pid) - before
        loaded = server.get(f"/v1/scenes/{scene}").json()["memoryBytes"]
    found = {"frame": summary([each.work_ms for each in samples]), "cpuMs": 1000 * cpu / len(samples),
             "http": summary([1000 * each.seconds - each.work_ms - each.load_ms - each.queue_ms for each in samples]),
             "sceneBytes": loaded, "bundleBytes": len(body)}  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        with Server(*start, "--store", store or folder, "--scene-memory-bytes", str(loaded + 1000)) as server:
            scenes = put_all(server.ask, [body, terrain(7, 64)])  # the one drops the other
            samples = drive(server.connect, scenes, [0, 1] * 40, 1, spec)[4::2]
    return found | {"load": summary([each.load_ms for each in samples]),
                    "coldFrame": summary([each.work_ms for each in samples])}  # fmt: skip


def rate(ask, clients, seconds):
    """Calls a second of some clients, each with an `ask` of its own; a call gets its client's number and its own."""
    counts, end = [0] * clients, time.monotonic() + seconds

    def client(number):
        call = ask()
        while time.monotonic() < end:
            call(number, counts[number])
            counts[number] += 1

    threads = [threading.Thread(target=client, args=(each,)) for each in range(clients)]
    begun = time.monotonic()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return sum(counts) / (time.monotonic() - begun)


def caller(connect, method, path, body=lambda number, each: None, headers=None):
    """For `rate`: a kept connection, and a request that must be answered with 200 or 201."""

    def make():
        connection = connect()

        def call(number, each):
            content = body(number, each)
            target = path(content) if callable(path) else path
            connection.request(method, target, content, headers or {})
            reply = connection.getresponse()
            told = reply.read()
            assert reply.status in (200, 201), (reply.status, told[:300])

        return call

    return make


def cores(body, seconds):
    """Frames a second with one core and with two, each as many workers; its clients have no others. And their ratio."""
    from shipped_server import Server

    found, everything = {}, os.sched_getaffinity(0)
    for count in (1, 2):
        os.sched_setaffinity(0, sorted(everything)[:count])  # what is started from now on inherits it, clients too
        try:
            with Server("--device", "cpu", "--workers", str(count), "--reply-cache-bytes", "0") as server:
                (scene,) = put_all(server.ask, [body])
                drive(server.connect, [scene], [0] * 20, 4, DEMO)
                samples, begun = [], time.monotonic()
                while time.monotonic() - begun < seconds:
                    samples += drive(server.connect, [scene], [0] * 100, 4 * count, DEMO, start=20 + len(samples))
                found[f"framesPerSecond{count}"] = len(samples) / (time.monotonic() - begun)
        finally:
            os.sched_setaffinity(0, everything)
    return found | {"ratio": found["framesPerSecond2"] / found["framesPerSecond1"]}


def overheads(start, body, seconds):
    """A kept picture asked for by one client: of the front, and of the front through haproxy."""
    from shipped_proxy import HAPROXY, Replicas
    from shipped_server import Server

    def measure(connect, pids):
        before, times = [cpu_seconds(pid) for pid in pids], []
        connection, end = connect(), time.monotonic() + seconds
        while time.monotonic() < end:
            begun = time.monotonic()
            connection.request("GET", path)
            connection.getresponse().read()
            times.append(1000 * (time.monotonic() - begun))
        return summary(times) | {"cpuMs": [1000 * (cpu_seconds(pid) - was) / len(times) for pid, was in zip(pids, before)]}

    with tempfile.TemporaryDirectory() as store:
        with Server(*start, "--store", store) as server:
            (scene,) = put_all(server.ask, [body])
            path = f"/v1/scenes/{scene}/frame?width=320&height=180"
            server.get(path)
            found = {"front": measure(server.connect, [server.process.pid])}
            found["front"]["perSecond"] = rate(caller(server.connect, "GET", path), 4, seconds)
        if HAPROXY:
            with Replicas(1, store, *start) as fleet:
                fleet.wait_for(1)
                fleet.ask("GET", path)
                found["proxied"] = measure(fleet.connect, [fleet.process.pid])
                found["proxied"]["perSecond"] = rate(caller(fleet.connect, "GET", path), 4, seconds)
    return found


def operations(start, store, seconds):
    """Operations a second: of the store, and of the queue in the process."""
    from hashlib import sha256

    from shipped_server import Server

    with tempfile.TemporaryDirectory() as folder, Server(*start, "--store", store or folder) as server:
        (scene,) = put_all(server.ask, [terrain(0, 8)])
        fresh = time.time_ns() % 10**12

        def content(number, each):
            return terrain((fresh, number, each), 8)

        glb, spec = {"Content-Type": "model/gltf-binary"}, {"Content-Type": "application/json"}
        return {
            "putPerSecond": rate(caller(server.connect, "PUT", lambda body: f"/v1/scenes/{sha256(body).hexdigest()}",
                                        content, glb), 4, seconds),
            "headPerSecond": rate(caller(server.connect, "HEAD", f"/v1/scenes/{scene}"), 4, seconds),
            "listPerSecond": rate(caller(server.connect, "GET", "/v1/scenes?limit=100"), 4, seconds),
            "tasksPerSecond": rate(caller(server.connect, "POST", f"/v1/scenes/{scene}/plan", lambda *_: json.dumps(SMALL),
                                          spec), 4, seconds),
        }  # fmt: skip


def streams(count=20_000):
    """Operations a second of Redis Streams with an append-only file, as a queue of frames uses them."""
    with tempfile.TemporaryDirectory() as folder:
        socket = f"{folder}/redis"
        redis = subprocess.Popen(["redis-server", "--port", "0", "--unixsocket", socket, "--dir", folder, "--appendonly", "yes",
                                  "--save", ""], stdout=subprocess.DEVNULL)  # fmt: skip
        try:
            while not Path(socket).exists():
                time.sleep(0.01)

            def told(*command):
                """`requests per second` of redis-benchmark's CSV."""
                text = subprocess.run(["redis-benchmark", "-s", socket, "-n", str(count), "-c", "8", "--csv", *command],
                                      check=True, capture_output=True, text=True).stdout  # fmt: skip
                return float(text.strip().splitlines()[-1].split('","')[1].strip('"'))

            subprocess.run(["redis-cli", "-s", socket, "XGROUP", "CREATE", "frames", "workers", "$", "MKSTREAM"],
                           check=True, stdout=subprocess.DEVNULL)  # fmt: skip
            value = "x" * 200
            return {
                "addPerSecond": told("XADD", "frames", "*", "frame", value),
                "takePerSecond": told("XREADGROUP", "GROUP", "workers", "one", "COUNT", "1", "STREAMS", "frames", ">"),
                "ackPerSecond": told("XACK", "frames", "workers", "1-1"),
                "get100KBPerSecond": (told("SET", "bundle", "x" * 100_000), told("GET", "bundle"))[1],
            }
        finally:
            redis.terminate()
            redis.wait(20)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--seconds", type=float, default=5, help="for each measurement")
    parser.add_argument("--store", help="what --store gets, instead of a directory")
    parser.add_argument("--only", help="one of them, beside what the output has already")
    options = parser.parse_args()
    use_binary(options.binary)
    demo = (options.binary.resolve().parent.parent / "share/gnomon/demo.glb").read_bytes()
    start = ["--device", "cpu", "--workers", "1"]
    found = json.loads(options.output.read_text()) if options.only else {}
    found["cores"] = len(os.sched_getaffinity(0))
    for name, measure in {
        "demo": lambda: frames(start, demo, DEMO, options.seconds, options.store),
        "terrain": lambda: frames(start, terrain(0, 64), SMALL, options.seconds, options.store),
        "overheads": lambda: overheads(start, demo, options.seconds),
        "scaling": lambda: cores(demo, options.seconds),
        "store": lambda: operations(start, options.store, options.seconds),
        "streams": lambda: streams() if shutil.which("redis-server") else None,
    }.items():
        if options.only not in (None, name):
            continue
        found[name] = measure()
        print(name, json.dumps(found[name]), flush=True)
    options.output.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3
"""What docker/haproxy_replicas.cfg is worth, by the real haproxy before real replicas with one store, whose memory holds a
part of the scenes each. Prints, and with --json writes:
  - how often a frame's scene was in memory, for a Zipf mix, beside the same proxy that goes round;
  - what clients see while a replica is killed (SIGKILL) under load, and comes back;
  - how many scenes move when a replica is added;
  - how the frames of one scene that everybody asks for are spread.
Needs haproxy and python3-numpy.

usage: tests/bench/routing.py BINARY [--scenes N] [--held N] [--requests N] [--replicas N] [--json FILE]
"""

import argparse
import json
import re
import sys
import tempfile
import threading
import time
from collections import Counter
from hashlib import sha256
from pathlib import Path

from replica_load import drive, load_counts, median, put_all, terrain, use_binary, zipf_mix

SPEC = {"width": 160, "height": 120}
CLIENTS = 6


def round_robin(folder):
    """The shipped file with another rule, for comparison."""
    from shipped_proxy import DOCKER

    text = (DOCKER / "haproxy_replicas.cfg").read_text()
    text, changes = re.subn(r"\n    balance hash.*\n    hash-type.*\n", "\n    balance roundrobin\n", text)
    assert changes == 1
    text = re.sub(r"\n    hash-balance-factor.*\n", "\n", text)
    path = Path(folder) / "round_robin.cfg"
    path.write_text(text)
    return path


def places(fleet, names):
    connection, found = fleet.connect(), {}
    for name in names:
        connection.request("HEAD", f"/v1/scenes/{name}")
        reply = connection.getresponse()
        reply.read()
        found[name] = reply.headers["X-Served-By"]
    connection.close()
    return found


def settled(fleet, names, quiet):
    """Where scenes are once no slow start moves any more of them."""
    now, since = places(fleet, names), time.monotonic()
    while time.monotonic() - since < quiet:
        time.sleep(0.2)
        if (next_ := places(fleet, names)) != now:
            now, since = next_, time.monotonic()
    return now


def hit_rate(fleet, ids, mix):
    """Of the second half of a mix, after each scene once and the first half have filled the memories."""
    half = len(mix) // 2
    drive(fleet.connect, ids, [*range(len(ids)), *mix[:half]], CLIENTS, SPEC)
    before = load_counts(fleet.servers.values())
    samples = drive(fleet.connect, ids, mix[half:], CLIENTS, SPEC, start=len(ids) + half)
    found, frames = load_counts(fleet.servers.values()) - before
    assert Counter(each.status for each in samples) == {200: len(samples)}
    return {"hitRate": found / frames, "medianMs": 1000 * median([each.seconds for each in samples]),
            "replicas": dict(Counter(each.replica for each in samples))}  # fmt: skip


def killed(fleet, ids, mix):
    """Frames while a replica dies, and comes back: replies by status, 0 = cut off, and how many replicas were missing."""
    address = list(fleet.servers)[1]
    samples = []
    third = len(mix) // 3
    thread = threading.Thread(target=lambda: samples.extend(drive(fleet.connect, ids, mix, CLIENTS, SPEC, start=10**6)))
    served_before = load_counts([fleet.servers[address]])[1]
    thread.start()
    while load_counts([fleet.servers[address]])[1] - served_before < third / len(fleet.servers):
        time.sleep(0.01)
    fleet.kill(address)
    died = time.monotonic()
    fleet.wait_for(len(fleet.servers) - 1)
    noticed = time.monotonic() - died
    fleet.restart(address)
    thread.join()
    slowest = max(each.seconds for each in samples if each.begun > died - 1)
    return {"replies": dict(Counter(each.status for each in samples)), "noticedAfterS": noticed, "slowestS": slowest}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--scenes", type=int, default=240)
    parser.add_argument("--held", type=int, default=100, help="scenes that one replica's memory holds")
    parser.add_argument("--requests", type=int, default=4000)
    parser.add_argument("--replicas", type=int, default=3)
    parser.add_argument("--exponent", type=float, default=1.0)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    use_binary(options.binary)
    from shipped_proxy import HAPROXY, Replicas
    from shipped_server import Server

    if not HAPROXY:
        sys.exit("haproxy is not installed: apt-get install haproxy")
    bodies = [terrain(seed, 64) for seed in range(options.scenes)]
    mix = zipf_mix(options.scenes, options.requests, options.exponent, 1)
    told = {"scenes": options.scenes, "held": options.held, "requests": options.requests, "replicas": options.replicas}
    with tempfile.TemporaryDirectory() as store, tempfile.TemporaryDirectory() as folder:
        with Server("--device", "cpu", "--workers", "1", "--store", store) as server:
            (first, *_) = put_all(server.ask, bodies)
            loaded = server.get(f"/v1/scenes/{first}").json()["memoryBytes"]
        ids = [sha256(body).hexdigest() for body in bodies]
        flags = ["--device", "cpu", "--workers", "1", "--reply-cache-bytes", "0",
                 "--scene-memory-bytes", str(loaded * options.held + loaded // 2)]  # fmt: skip

        with Replicas(options.replicas, store, *flags, files=("haproxy.cfg", round_robin(folder))) as fleet:
            fleet.wait_for(options.replicas)
            told["roundRobin"] = hit_rate(fleet, ids, mix)
        print("round robin:", json.dumps(told["roundRobin"]), flush=True)

        with Replicas(options.replicas, store, *flags) as fleet:
            fleet.wait_for(options.replicas)
            names = [sha256(b"%d" % each).hexdigest() for each in range(2000)]
            before = settled(fleet, names, 6)
            told["shares"] = dict(Counter(before.values()))
            told["hashed"] = hit_rate(fleet, ids, mix)
            print("by scene:", json.dumps(told["hashed"]), json.dumps(told["shares"]), flush=True)

            told["killed"] = killed(fleet, ids, mix)
            print("one killed:", json.dumps(told["killed"]), flush=True)

            back = settled(fleet, names, 6)
            fleet.start(f"127.0.0.{11 + options.replicas}")
            after = settled(fleet, names, 6)
            fresh = f"replica{options.replicas + 1}"
            told["added"] = {"backAsBefore": before == back,
                             "moved": sum(before[each] != after[each] for each in names) / len(names),
                             "movedElsewhere": sum(before[each] != after[each] != fresh for each in names)}  # fmt: skip
            print("one added:", json.dumps(told["added"]), flush=True)

            samples = drive(fleet.connect, ids, [0] * 400, 16, {"width": 320, "height": 240}, start=2 * 10**6)
            told["hot"] = dict(Counter(each.replica for each in samples))
            print("one scene for all:", json.dumps(told["hot"]), flush=True)
    if options.json:
        options.json.write_text(json.dumps(told, indent=1) + "\n")


if __name__ == "__main__":
    main()

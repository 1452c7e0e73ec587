#!/usr/bin/python3
"""The simulation of fleet_model.py beside three real replicas and the real haproxy: how long frames, loads and the way take
is measured with few scenes; then a trace of frames of many is sent, by scene and going round, and simulated. Prints, and
writes with --json, hit rates and medians of both; the exit status is 1 if any differs by more than 15 %. Needs haproxy,
python3-simpy and python3-numpy, and a quiet machine: it keeps a quarter of a core busy for some minutes.

usage: tests/bench/fleet_check.py BINARY [--requests N] [--rate N] [--json FILE]
"""

import argparse
import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

try:
    import numpy

    from fleet_model import Fleet, Model, Services
    from haproxy_ring import Ring, key_of
    from replica_load import drive, load_counts, put_all, terrain, use_binary, zipf_mix
    from routing import round_robin, settled
except ImportError as missing:
    sys.exit(f"{missing}: apt-get install python3-simpy python3-numpy")

SPEC = {"width": 160, "height": 120}
SCENES, HELD, REPLICAS, CLIENTS = 240, 50, 3, 16
ALLOWED = 0.15


def at_random(count, rate, seed):
    """The seconds of requests that come independently of each other."""
    return numpy.cumsum(numpy.random.default_rng(seed).exponential(1 / rate, count)).tolist()


def flags_for(held, loaded):
    """Of a replica whose memory holds so many scenes, each of `loaded` bytes."""
    return ["--device", "cpu", "--workers", "1", "--reply-cache-bytes", "0",
            "--scene-memory-bytes", str(loaded * held + loaded // 2)]  # fmt: skip


def measured_services(store, ids, loaded, rate):
    """Of the same replicas at the same rate, with a third of the scenes and of the memory: what other frames and loads take
    from the processors' caches is in the times, too."""
    from shipped_proxy import Replicas

    scenes, held = SCENES // 3, HELD // 3
    mix = [*range(scenes), *zipf_mix(scenes, 1200, 1.0, 4)]
    with Replicas(REPLICAS, store, *flags_for(held, loaded), slow_start="1s") as fleet:
        fleet.wait_for(REPLICAS)
        settled(fleet, ids, 4)
        samples = drive(fleet.connect, ids, mix, CLIENTS, SPEC, 0, at_random(len(mix), rate, 5))[scenes:]
    warm, cold = ([each for each in samples if (each.load_ms < 1) == is_warm] for is_warm in (True, False))
    frame = [each.work_ms for each in warm]
    return Services(frame=frame, load=[each.load_ms for each in cold],
                    first=[each.work_ms - numpy.median(frame) for each in cold],
                    http=[1000 * each.seconds - each.work_ms - each.load_ms - each.queue_ms for each in warm])  # fmt: skip


def real(store, ids, flags, files, mix, seconds):
    """Hit rate and latency of the trace behind its first part, which has each scene once; and where the scenes were."""
    from shipped_proxy import Replicas

    with Replicas(REPLICAS, store, *flags, slow_start="1s", **files) as fleet:
        fleet.wait_for(REPLICAS)
        at = settled(fleet, ids, 4)
        drive(fleet.connect, ids, mix[:SCENES], CLIENTS, SPEC, 0, seconds[:SCENES])
        before = load_counts(fleet.servers.values())
        later = [each - seconds[SCENES] for each in seconds[SCENES:]]
        samples = drive(fleet.connect, ids, mix[SCENES:], CLIENTS, SPEC, SCENES, later)
        found, frames = load_counts(fleet.servers.values()) - before
        assert Counter(each.status for each in samples) == {200: len(samples)}
        return {"hitRate": found / frames} | quantiles([each.seconds for each in samples]), at


def quantiles(seconds):
    return {"p50Ms": 1000 * float(numpy.quantile(seconds, 0.5)), "p99Ms": 1000 * float(numpy.quantile(seconds, 0.99))}


def simulated(ids, services, factor, mix, seconds):
    fleet = Fleet(REPLICAS, SCENES, 0, 0, services, HELD, factor=factor, warm=False, ignore=seconds[SCENES],
                  trace=list(zip(seconds, mix)), keys=ids)  # fmt: skip
    outcome = Model(fleet).run()
    return {"hitRate": outcome.hit_rate()} | quantiles(outcome.seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--requests", type=int, default=1200)
    parser.add_argument("--rate", type=float, default=30)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    use_binary(options.binary)
    from shipped_proxy import HAPROXY
    from shipped_server import Server

    if not HAPROXY:
        sys.exit("haproxy is not installed: apt-get install haproxy")
    mix = [*range(SCENES), *zipf_mix(SCENES, options.requests, 1.0, 2)]
    seconds = at_random(len(mix), options.rate, 3)
    told = {"scenes": SCENES, "held": HELD, "replicas": REPLICAS, "requests": options.requests, "rate": options.rate}
    with tempfile.TemporaryDirectory() as store, tempfile.TemporaryDirectory() as folder:
        with Server("--device", "cpu", "--workers", "1", "--store", store) as server:
            ids = put_all(server.ask, [terrain(seed, 64) for seed in range(SCENES)])
            loaded = server.get(f"/v1/scenes/{ids[0]}").json()["memoryBytes"]
        services = measured_services(store, ids, loaded, options.rate)
        told["services"] = {name: float(numpy.median(each)) for name, each in vars(services).items() if isinstance(each, list)}
        print("medians of the parts, ms:", json.dumps(told["services"]), flush=True)
        flags = flags_for(HELD, loaded)
        good = True
        for name, factor, files in (("byScene", 200, {}),
                                    ("inTurn", 0, {"files": ("haproxy.cfg", round_robin(folder))})):  # fmt: skip
            found, at = real(store, ids, flags, files, mix, seconds)
            if factor:
                ring = Ring({number + 1: 100 for number in range(REPLICAS)})
                homes = {each: f"replica{ring.owners[ring.nearest([key_of(each)])[0]]}" for each in ids}
                told["placesAsSimulated"] = sum(homes[each] == at[each] for each in ids) / len(ids)
                print("scenes at the place that is simulated:", told["placesAsSimulated"], flush=True)
            guessed = simulated(ids, services, factor, mix, seconds)
            differs = {each: guessed[each] / found[each] - 1 for each in found}
            good = good and abs(differs["hitRate"]) <= ALLOWED and abs(differs["p50Ms"]) <= ALLOWED
            told[name] = {"real": found, "simulated": guessed, "difference": differs}
            print(name, json.dumps(told[name]), flush=True)
    told["within15Percent"] = good
    if options.json:
        options.json.write_text(json.dumps(told, indent=1) + "\n")
    sys.exit(not good)


if __name__ == "__main__":
    main()

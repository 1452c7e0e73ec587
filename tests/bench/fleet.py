#!/usr/bin/python3
"""How far many replicas carry, by simulation (fleet_model.py) with the times that fleet_services.py measured: 1 to 1,000
replicas and 100 to 1,000,000 scenes with Zipf popularity. Writes numbers as JSON and charts as SVG. fleet_check.py compares
the simulation with real replicas. Needs python3-simpy and python3-numpy; takes minutes of one core.

usage: tests/bench/fleet.py SERVICES.json FOLDER [--only NAME] [--price PER_CORE_HOUR]
"""

import argparse
import json
import sys
import time
from pathlib import Path

from svg_lines import chart

try:
    import numpy

    from fleet_model import Autoscaler, Fleet, Model, Services
except ImportError as missing:
    sys.exit(f"{missing}: apt-get install python3-simpy python3-numpy")

LOAD = 0.6  # of what the renderers of all replicas could draw
REQUESTS = 60_000  # that a run simulates, about
SCENES_EACH = 200  # for a replica
HELD = 400  # in its memory, twice as many as its own


class Parts:
    """The measured times, and what follows from them."""

    def __init__(self, measured):
        demo, way = measured["demo"], measured["overheads"]
        first = max(0.0, demo["coldFrame"]["meanMs"] - demo["frame"]["meanMs"])
        copies = demo["bundleBytes"] / 100_000  # pieces of 100 KB that the store sends for a load
        self.services = Services(frame=demo["frame"]["quantilesMs"], load=demo["load"]["quantilesMs"], first=[first],
                                 http=demo["http"]["quantilesMs"], proxy=way["proxied"]["cpuMs"][0],
                                 store=1000 * copies / measured["streams"]["get100KBPerSecond"])  # fmt: skip
        self.cores = measured["cores"]
        self.most = 1000 / demo["frame"]["meanMs"]  # frames a second of a replica whose scenes are all in memory

    def fleet(self, replicas, scenes, **more):
        rate = LOAD * self.most * replicas
        seconds = more.pop("seconds", max(30.0, REQUESTS / rate))
        more.setdefault("held", HELD)
        more.setdefault("rate", rate)
        return Fleet(replicas, scenes, seconds=seconds, services=self.services, ignore=more.pop("ignore", seconds / 2), **more)


def run(parts, fleet, price):
    begun = time.monotonic()
    outcome = Model(fleet).run()
    seconds = numpy.array(outcome.seconds)
    hours = outcome.replica_seconds * parts.cores / 3600 / outcome.asked * 1e6
    told = {
        "replicas": fleet.replicas, "scenes": fleet.scenes, "held": fleet.held, "factor": fleet.factor,
        "frames": len(seconds), "done": len(seconds) / outcome.due, "refused": outcome.refused, "retried": outcome.retried,
        "hitRate": outcome.hit_rate(), "p50Ms": 1000 * float(numpy.quantile(seconds, 0.5)),
        "p99Ms": 1000 * float(numpy.quantile(seconds, 0.99)), "coreHoursPerMillion": hours,
        "proxyBusy": outcome.asked * parts.services.proxy / 1000 / fleet.seconds / fleet.threads,
        "storeBusy": outcome.loads * parts.services.store / 1000 / fleet.seconds,
    }  # fmt: skip
    if price:
        told["pricePerMillion"] = hours * price
    print(json.dumps({name: round(value, 4) for name, value in told.items()}), f"in {time.monotonic() - begun:.0f} s", flush=True)
    return told, outcome


def sizes(parts, folder, price):
    """More replicas with as many scenes for each, and with a million for all."""
    found = {}
    for name, scenes_of in {"200 scenes each": lambda count: SCENES_EACH * count, "1M scenes": lambda _: 1_000_000}.items():
        found[name] = []
        for count in (1, 3, 10, 30, 100, 300, 1000):
            seconds = {300: 16.0, 1000: 8.0}.get(count)
            more = {"seconds": seconds} if seconds else {}
            found[name].append(run(parts, parts.fleet(count, scenes_of(count), **more), price)[0])
    well = {name: [each for each in rows if each["done"] > 0.9] for name, rows in found.items()}  # the rest drown
    chart(folder / "sizes_hit_rate.svg", "Hit rate by size", "replicas", "frames whose scene is in memory",
          {name: [(each["replicas"], each["hitRate"]) for each in rows] for name, rows in well.items()}, True, least=0, most=1)
    chart(folder / "sizes_latency.svg", "Latency by size", "replicas", "milliseconds",
          {f"{quantile}, {name}": [(each["replicas"], each[f"{quantile}Ms"]) for each in rows]
           for name, rows in well.items() for quantile in ("p50", "p99")}, True, True)  # fmt: skip
    chart(folder / "sizes_busy.svg", "What is used up", "replicas", "asked of one proxy (4 threads), of one store",
          {f"{part}, {name}": [(each["replicas"], each[f"{part}Busy"]) for each in rows]
           for name, rows in found.items() for part in ("proxy", "store")}, True, least=0)  # fmt: skip
    return found


def bounds(parts, folder, price):
    """hash-balance-factor at 30 replicas, for memories of different size."""
    found = {}
    for held in (200, 400, 800):
        found[f"{held / SCENES_EACH:g} x its scenes"] = [
            run(parts, parts.fleet(30, 30 * SCENES_EACH, held=held, factor=factor, seconds=120.0), price)[0]
            for factor in (110, 125, 150, 200, 250, 300, 400)
        ]
    for name, of in (("hit_rate", "hitRate"), ("p99", "p99Ms")):
        chart(folder / f"bounds_{name}.svg", f"hash-balance-factor, 30 replicas: {name.replace('_', ' ')}", "percent of the average",
              "frames whose scene is in memory" if of == "hitRate" else "milliseconds",
              {f"memory {label}": [(each["factor"], each[of]) for each in rows] for label, rows in found.items()})  # fmt: skip
    found["in turn"] = [run(parts, parts.fleet(30, 30 * SCENES_EACH, factor=0, seconds=120.0), price)[0]]
    return found


def loads(parts, folder, price):
    """How many frames replicas may draw before they come late, by scene and in turn, and so what they cost."""
    found = {}
    for name, factor in (("by scene", 200), ("in turn", 0)):
        found[name] = []
        for load in (0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
            fleet = parts.fleet(10, 10 * SCENES_EACH, factor=factor, rate=load * 10 * parts.most, seconds=200.0)
            found[name].append(run(parts, fleet, price)[0] | {"load": load})
    for quantile in ("p50", "p99"):
        chart(folder / f"loads_{quantile}.svg", f"{quantile} by load, 10 replicas", "core-hours for a million frames", "milliseconds",
              {name: [(each["coreHoursPerMillion"], each[f"{quantile}Ms"]) for each in rows] for name, rows in found.items()},
              log_y=True)  # fmt: skip
    return found


def scaling(parts, folder, price):
    """A load that grows to three times within five minutes, stays, and is gone at once, for targets of the queue's time: with
    Kubernetes' own pace, and damped, a tenth or one more in 15 s, a tenth less in a minute, by a fresher metric."""
    rate, found, lines, waits = LOAD * parts.most * 4, [], {}, {}

    def grown(second):
        return rate * (1 + 2 * min(1.0, max(0.0, (second - 120) / 300)) if second < 720 else 1)

    damped = {"rise": 0.1, "more": 1, "fall": 0.1, "window": 30.0, "lag": 15.0}
    for name, more in (("20 ms, as Kubernetes does", {"target_ms": 20}), ("10 ms, damped", {"target_ms": 10} | damped),
                       ("20 ms, damped", {"target_ms": 20} | damped), ("250 ms, damped", {"target_ms": 250} | damped)):  # fmt: skip
        fleet = parts.fleet(4, 4 * SCENES_EACH, seconds=1500.0, ignore=0.0, rate=grown,
                            autoscaler=Autoscaler(least=2, most=40, **more))  # fmt: skip
        told, outcome = run(parts, fleet, price)
        found.append(told | {"autoscaler": name, "mostReplicas": max(each for _, each in outcome.counts)})
        begun, seconds = numpy.array(outcome.begun), numpy.array(outcome.seconds)
        lines[name] = [(second, count) for second, count in steps(outcome.counts, 1500)]
        waits[name] = [(minute * 60, 1000 * float(numpy.quantile(seconds[(begun // 60) == minute], 0.99)))
                       for minute in range(25)]  # fmt: skip
    chart(folder / "scaling_replicas.svg", "Replicas by target of queue time", "seconds", "replicas that serve", lines, least=0)
    chart(folder / "scaling_p99.svg", "p99 of each minute by target", "seconds", "milliseconds", waits, log_y=True)
    return found


def steps(counts, end):
    """Values that hold until the next one, as corners of a line."""
    corners = []
    for (second, count), (later, _) in zip(counts, [*counts[1:], (end, 0)]):
        corners += [(second, count), (later, count)]
    return corners


def failures(parts, folder, price):
    """Ten replicas that fail, for different mean lives."""
    found = []
    for life in (60, 300, 1800, 7200, 0):
        fleet = parts.fleet(10, 10 * SCENES_EACH, seconds=900.0, ignore=100.0, mean_life=life)
        found.append(run(parts, fleet, price)[0] | {"meanLifeS": life})
    return found


def cold(parts, folder, price):
    """A whole fleet that starts with nothing in memory."""
    found, lines = {}, {}
    for count in (3, 30, 300):
        fleet = parts.fleet(count, count * SCENES_EACH, seconds={300: 40.0}.get(count, 300.0), ignore=0.0, warm=False)
        told, outcome = run(parts, fleet, price)
        begun, seconds = numpy.array(outcome.begun), numpy.array(outcome.seconds)
        width = fleet.seconds / 20
        lines[f"{count} replicas"] = [(width * (each + 1), 1000 * float(numpy.quantile(seconds[(begun // width) == each], 0.99)))
                                      for each in range(20)]  # fmt: skip
        found[str(count)] = told
    chart(folder / "cold_p99.svg", "p99 after a cold start", "seconds", "milliseconds", lines, True, True)
    return found


RUNS = {each.__name__: each for each in (bounds, loads, scaling, failures, cold, sizes)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("services", type=Path, help="what fleet_services.py has written")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", choices=RUNS)
    parser.add_argument("--price", type=float, default=0, help="of a core-hour, in any currency")
    options = parser.parse_args()
    parts = Parts(json.loads(options.services.read_text()))
    options.folder.mkdir(parents=True, exist_ok=True)
    path = options.folder / "fleet.json"
    found = json.loads(path.read_text()) if options.only and path.exists() else {}
    for name, simulate in RUNS.items():
        if options.only in (None, name):
            print(name, flush=True)
            found[name] = simulate(parts, options.folder, options.price)
            path.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    sys.exit(main())

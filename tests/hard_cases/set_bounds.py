#!/usr/bin/env python3
"""Writes the bounds of hard cases from what a run of test_hard_cases measured (hard_cases.json in its build folder):
every metric and a third on top, and three pixels; of techniques that trace, a hundred-thousandth. Of three receivers or
fewer no share but an exact one has a bound. Look at what changed: a bound that grows is a fault or needs a reason.

usage: set_bounds.py HARD_CASES.json [CASE...]      without cases: those that have no bounds yet for some technique
"""

import json
import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
SHARES = ("misclassified", "falseShadow", "falseLit", "acne", "leak", "edge", "interior", "meanAbsolute")
TRACED = ("rayTraced",)  # right but for one receiver in a hundred thousand


def rounded_up(value):
    """To two digits."""
    if value <= 0:
        return 0
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / step - 1e-9) * step:.6g}")


def can_be_bounded(way, metrics):
    return metrics and metrics["receivers"] > (0 if way in TRACED else 3)


def bounds_of(way, metrics):
    pixels = 1e-5 if way in TRACED else 3 / max(metrics["receivers"], 1)
    bounds = {}
    for name, value in metrics.items():
        if name in SHARES:
            bounds[name] = min(1, rounded_up(value * 4 / 3 + pixels))
        elif name == "rms":
            bounds[name] = min(1, rounded_up(math.sqrt(value * value * 4 / 3 + pixels)))
        elif name == "edgeDisplacement":
            bounds[name] = rounded_up(value * 4 / 3 + 0.05)
        elif name == "shimmer":
            bounds[name] = rounded_up(value * 4 / 3)
    return bounds


def text_of(case):
    """One line a key, one for each key of the request, one a technique."""

    def block(value):
        lines = [f"    {json.dumps(key)}: {json.dumps(part)}" for key, part in value.items()]
        return "{\n" + ",\n".join(lines) + "\n  }" if lines else "{}"

    parts = [f"  {json.dumps(key)}: {block(value) if key in ('spec', 'bounds', 'refused') else json.dumps(value)}"
             for key, value in case.items()]
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main(measured_file, *names):
    with open(measured_file) as file:
        measured = json.load(file)
    for name, ways in measured.items():
        path = os.path.join(FOLDER, name + ".json")
        with open(path) as file:
            case = json.load(file)
        old = {} if name in names else case["bounds"]
        case["bounds"] = {way: old.get(way) or bounds_of(way, metrics) for way, metrics in ways.items()
                          if can_be_bounded(way, metrics)}
        with open(path, "w") as file:
            file.write(text_of(case))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])

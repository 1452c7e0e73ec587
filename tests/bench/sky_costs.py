#!/usr/bin/python3
"""What a sky's shadow costs and how exact it is: the table of renderer/ACCURACY.md. The rms of the share of the
environment's light against many rays, all pixels of 640 x 360; and whole frames of 1280 x 720 without encoding, as
multiples of the same frame with its sun alone, which take turns: medians by the clock and, in brackets, by the time of
all processors. The demo and a uniform sky are always measured; scenes are GLBs beside a .json with their camera.
Needs NumPy.

usage: tests/bench/sky_costs.py BINARY [--scenes FILE.glb ...] [--environments FILE.hdr ...]
"""

import argparse
import json
import os
import statistics
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "clients/python"))
import gnomon  # noqa: E402
import numpy as np  # noqa: E402

SUN = {"direction": [-0.5, -0.8, 0.3]}  # beside a uniform sky, which has none


def uniform_sky():
    """A Radiance picture of 16 x 8 texels, all of them 1."""
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + struct.pack("4B", 128, 128, 128, 129) * 128


def spec_of(camera, environment, width, height, **fields):
    """A frame of a scene, lit by an environment and its sun alone."""
    spec = {"width": width, "height": height, "views": ["color"], "environment": {"file": environment}, **fields}
    if environment == "uniform.hdr":
        spec["lights"] = [SUN]
    if camera:
        spec["camera"] = camera
    return spec


def camera_of(path):
    named = path.with_suffix(".json")
    if not named.exists():
        return None
    said = json.loads(named.read_text())["camera"]
    lens = {"fovYDegrees": said["fovy_deg"], "near": said["near"], "far": said["far"]}
    return {"eye": said["eye"], "target": said["target"], "up": said["up"], "perspective": lens}


def with_rays(spec, samples, **fields):
    return {**spec, **fields, "environment": {**spec["environment"], "shadows": "rays", "samples": samples}}


def shares(session, scene, spec, view, samples, rays):
    asked = with_rays(spec, samples, views=[view], debug={"light": "environment"}, antialiasing="none")
    if view == "reference":
        asked["environment"]["samples"] = rays
    return getattr(session.frame(scene, asked), view).astype(np.float64)


def rms(session, scene, spec, truth, samples):
    apart = shares(session, scene, spec, "shadow", samples, 0) - truth
    return float(np.sqrt(np.mean(apart * apart)))


def processor_seconds(session):
    """Of all processes of a server so far: it leads a session of its own."""
    ticks = 0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[3]) == session:
            ticks += sum(map(int, fields[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def cost(session, server, scene, spec, repeats):
    """Milliseconds of a frame, by the clock of its stages and of all processors; without encoding and waiting."""
    before = processor_seconds(server)
    clock = []
    for _ in range(repeats):
        times = session.frame(scene, spec).timings
        clock.append(sum(ms for stage, ms in times.items() if stage not in ("queue", "encode")))
    return statistics.median(clock), (processor_seconds(server) - before) * 1000 / repeats


def costs(session, server, scene, specs, rounds):
    """The medians of each."""
    for spec in specs:
        session.frame(scene, spec)
    found = [[] for _ in specs]
    for _ in range(rounds):
        for spec, of in zip(specs, found):
            of.append(cost(session, server, scene, spec, 2))
    return [tuple(statistics.median(part) for part in zip(*of)) for of in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("--scenes", type=Path, nargs="*", default=[])
    parser.add_argument("--environments", type=Path, nargs="*", default=[])
    parser.add_argument("--samples", type=int, nargs="*", default=[1, 4, 16])
    parser.add_argument("--rays", type=int, default=1024, help="of the pixels that are compared with")
    parser.add_argument("--rounds", type=int, default=5, help="of times; 0 = only errors")
    parser.add_argument("--references", type=Path, help="a folder where they are kept, and taken from")
    parser.add_argument("--device", default="cpu")
    options = parser.parse_args()
    demo = options.binary.resolve().parent.parent / "share/gnomon/demo.glb"
    skies = {"uniform.hdr": uniform_sky(), **{path.name: path.read_bytes() for path in options.environments}}
    print("| scene | environment | rms | times, one sample a pixel | times, 4x antialiasing |\n|---|---|---|---|---|")
    own = gnomon.LocalServer("--request-timeout", "900", "--device", options.device, "--reply-cache-bytes", "0", binary=options.binary)
    with own, gnomon.Session(own.url) as session:
        for path in [*options.scenes, demo]:
            scene = session.upload(path, skies)
            for sky in skies:
                small = spec_of(camera_of(path), sky, 640, 360)
                kept = options.references and options.references / f"{path.stem}-{Path(sky).stem}-{options.rays}.npy"
                if kept and kept.exists():
                    truth = np.load(kept)
                else:
                    truth = shares(session, scene, small, "reference", 1, options.rays)
                    if kept:
                        np.save(kept, truth)
                errors = " / ".join(f"{rms(session, scene, small, truth, n):.4f}" for n in options.samples)
                cells = []
                for antialiasing in ("none", "msaa4x") if options.rounds else ():
                    large = spec_of(camera_of(path), sky, 1280, 720, antialiasing=antialiasing,
                                    output={"format": "npz"})  # fmt: skip
                    specs = [large, *(with_rays(large, n) for n in options.samples)]
                    alone, *rest = costs(session, own.pid, scene, specs, options.rounds)
                    cells.append(f"{alone[0]:.0f} ({alone[1]:.0f}) ms x " + " / ".join(
                        f"{clock / alone[0]:.1f} ({processors / alone[1]:.1f})" for clock, processors in rest))  # fmt: skip
                print(f"| {path.stem} | {Path(sky).stem} | {errors} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

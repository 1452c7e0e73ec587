#!/usr/bin/env python3
"""A labelled data set: the same scene under random suns, from random cameras, with some of its nodes out of sight.

    python3 clients/python/examples/dataset.py scene.glb dataset --count 1000

Each sample is one .npz, with arrays color, depth, ids and shadow, the camera's pose (4 x 4, OpenCV's axes) and matrix K, and
with report.json, which tells how it was drawn.
manifest.json says what drew them. Run it again after a break, and it goes on where it stopped: what a sample shows is
decided by its number and --seed alone.
"""

import argparse
import json
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import gnomon

# %% What a sample shows.


def random_spec(summary, number, options):
    random = np.random.default_rng([options.seed, number])
    low, high = np.array(summary["boundsMin"]), np.array(summary["boundsMax"])
    centre, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
    azimuth, elevation = random.uniform(0, 2 * np.pi), np.radians(random.uniform(10, 60))
    direction = np.array([np.cos(elevation) * np.sin(azimuth), np.sin(elevation), -np.cos(elevation) * np.cos(azimuth)])
    target = centre + random.uniform(-0.2, 0.2, 3) * (high - low)
    pose = gnomon.camera.pose(target + direction * radius * random.uniform(0.8, 1.6), target, axes="opencv")
    focal = options.width * random.uniform(0.9, 1.3)
    K = np.array([[focal, 0, (options.width - 1) / 2], [0, focal, (options.height - 1) / 2], [0, 0, 1]])
    hidden = random.choice(summary["nodes"], size=min(options.hidden, summary["nodes"]), replace=False)
    return pose, K, gnomon.spec.FrameSpec(
        width=options.width,
        height=options.height,
        views=["color", "depth", "ids", "shadow"],
        camera=gnomon.camera.from_pose(pose, "opencv", K),
        lights=[gnomon.spec.Light(sun=gnomon.spec.Sun(random.uniform(0, 360), random.uniform(8, 80)),
                                  temperatureKelvin=random.uniform(3000, 9000))],
        nodes=[gnomon.spec.NodeOptions(node=int(node), visible=False) for node in hidden],
    )


# %% Drawing and writing one; the file appears whole or not at all.


def write_sample(session, scene, number, options):
    path = options.folder / f"{number:06d}.npz"
    if path.exists():
        return 0
    pose, K, spec = random_spec(scene.summary, number, options)
    frame = session.frame(scene, spec)
    whole = path.with_suffix(".part")
    whole.write_bytes(frame.npz(worldFromCamera=pose, K=K))
    whole.replace(path)
    return 1


# %% All of them, several at once: the server draws while others are written.


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--width", type=int, default=320)
    parser.add_argument("--height", type=int, default=240)
    parser.add_argument("--hidden", type=int, default=2, help="how many nodes are out of sight")
    parser.add_argument("--server", help="address of a server; without it GNOMON_SERVER, or one is started")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    with gnomon.Session(options.server) as session, ThreadPoolExecutor(4) as threads:
        scene = session.upload(options.scene)
        manifest = {
            "scene": scene.id,
            "seed": options.seed,
            "width": options.width,
            "height": options.height,
            "hidden": options.hidden,
            "renderer": session.capabilities()["renderer"],
        }
        stored = options.folder / "manifest.json"
        if stored.exists() and json.loads(stored.read_text())["made"] != manifest:
            sys.exit(f"{stored} is of another scene, seed, size or renderer: choose another folder")
        stored.write_text(json.dumps({"made": manifest}, indent=2) + "\n")
        begun = time.monotonic()
        drawn = sum(threads.map(lambda number: write_sample(session, scene, number, options), range(options.count)))
        seconds = time.monotonic() - begun
    samples = sorted(path.name for path in options.folder.glob("*.npz"))
    stored.write_text(json.dumps({"made": manifest, "samples": samples}, indent=2) + "\n")
    print(f"{drawn} frames in {seconds:.1f} s, {drawn / seconds:.1f} frames a second; {len(samples)} samples in all")


if __name__ == "__main__":
    main()

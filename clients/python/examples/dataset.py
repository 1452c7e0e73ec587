#!/usr/bin/env python3
"""A labelled data set: the same scene under random suns, from random cameras, with some of its nodes out of sight.

    python3 clients/python/examples/dataset.py scene.glb dataset --count 1000

Each sample is one .npz, with arrays color, depth, ids and shadow, the camera's pose (4 x 4, OpenCV's axes) and matrix K,
`shown`, the share of its pixels that show the scene, and with report.json, which says how it was drawn.
manifest.json says what drew them, names the nodes that ids shows, and has the share of every sample. Where a camera sees less
of the scene than --shown, another is tried. Run it again after a break, and it goes on where it stopped: what a sample shows
is decided by its number, --seed and --shown alone.
"""

import argparse
import json
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import gnomon

ATTEMPTS = 50  # cameras for one sample

# %% What a sample shows.


def random_hidden(nodes, count, random):
    """So many nodes that draw something themselves, as long as half of the triangles stay: a root is never among them."""
    hides = np.array([node["triangles"] for node in nodes])  # with those below, which a node takes along
    below = [[] for _ in nodes]
    for node in nodes:
        if "parent" in node:
            below[node["parent"]].append(node["node"])
    order = [node["node"] for node in nodes if "parent" not in node]
    for node in order:
        order.extend(below[node])
    for node in reversed(order):
        hides[node] += sum(hides[each] for each in below[node])
    drawn = [node["node"] for node in nodes if node["triangles"] > 0]
    left, hidden = sum(node["triangles"] for node in nodes) // 2, []
    for node in random.permutation(drawn):
        if len(hidden) < count and hides[node] <= left:
            hidden.append(int(node))
            left -= hides[node]
    return hidden


def random_spec(summary, nodes, number, attempt, options):
    random = np.random.default_rng([options.seed, number, attempt])
    low, high = np.array(summary["boundsMin"]), np.array(summary["boundsMax"])
    centre, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
    azimuth, elevation = random.uniform(0, 2 * np.pi), np.radians(random.uniform(10, 60))
    direction = np.array([np.cos(elevation) * np.sin(azimuth), np.sin(elevation), -np.cos(elevation) * np.cos(azimuth)])
    target = centre + random.uniform(-0.2, 0.2, 3) * (high - low)
    pose = gnomon.camera.pose(target + direction * radius * random.uniform(0.8, 1.6), target, axes="opencv")
    focal = options.width * random.uniform(0.9, 1.3)
    K = np.array([[focal, 0, (options.width - 1) / 2], [0, focal, (options.height - 1) / 2], [0, 0, 1]])
    hidden = random_hidden(nodes, options.hidden, random)
    return pose, K, gnomon.spec.FrameSpec(
        width=options.width,
        height=options.height,
        views=["color", "depth", "ids", "shadow"],
        camera=gnomon.camera.from_pose(pose, "opencv", K),
        lights=[gnomon.spec.Light(sun=gnomon.spec.Sun(random.uniform(0, 360), random.uniform(8, 80)),
                                  temperatureKelvin=random.uniform(3000, 9000))],
        nodes=[gnomon.spec.NodeOptions(node=node, visible=False) for node in hidden],
    )


# %% Drawing and writing one; the file appears whole or not at all.


def write_sample(session, scene, nodes, number, options):
    """Whether it was not there already."""
    path = options.folder / f"{number:06d}.npz"
    if path.exists():
        return False
    most = 0.0
    for attempt in range(ATTEMPTS):
        pose, K, spec = random_spec(scene.summary, nodes, number, attempt, options)
        frame = session.frame(scene, spec)
        shown = float((frame.ids >= 0).mean())
        if shown >= options.shown:
            whole = path.with_suffix(".part")
            whole.write_bytes(frame.npz(worldFromCamera=pose, K=K, shown=shown))
            whole.replace(path)
            return True
        most = max(most, shown)
    raise SystemExit(f"sample {number}: of {ATTEMPTS} cameras none shows the scene on {options.shown:.1%} of the pixels, the best on "
                     f"{most:.1%}: choose a smaller --shown, or fewer --hidden nodes")


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
    parser.add_argument("--shown", type=float, default=0.05, help="the least share of the pixels that shows the scene")
    parser.add_argument("--server", help="address of a server; without it GNOMON_SERVER, or one is started")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    with gnomon.Session(options.server) as session, ThreadPoolExecutor(4) as threads:
        scene = session.upload(options.scene)
        nodes = [*session.nodes(scene)]
        manifest = {
            "scene": scene.id,
            "seed": options.seed,
            "width": options.width,
            "height": options.height,
            "hidden": options.hidden,
            "shown": options.shown,
            "renderer": session.capabilities()["renderer"],
        }
        stored = options.folder / "manifest.json"
        if stored.exists() and json.loads(stored.read_text())["made"] != manifest:
            sys.exit(f"{stored} is of another scene, seed, size, choice or renderer: choose another folder")
        stored.write_text(json.dumps({"made": manifest}, indent=2) + "\n")
        begun = time.monotonic()
        drawn = sum(threads.map(lambda number: write_sample(session, scene, nodes, number, options), range(options.count)))
        seconds = time.monotonic() - begun
    samples = {path.name: float(np.load(path)["shown"]) for path in sorted(options.folder.glob("*.npz"))}
    names = {node["node"]: node["name"] for node in nodes}
    stored.write_text(json.dumps({"made": manifest, "nodes": names, "samples": samples}, indent=2) + "\n")
    print(f"{drawn} frames in {seconds:.1f} s, {drawn / seconds:.1f} frames a second; {len(samples)} samples in all")
    shares = [*samples.values()]
    if shares:
        print(f"pixels that show the scene: {np.mean(shares):.1%} in the mean, {min(shares):.1%} to {max(shares):.1%}")


if __name__ == "__main__":
    main()

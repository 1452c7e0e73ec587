#!/usr/bin/env python3
"""Compares the diffuse light of an environment, and what a scene hides of it, with Cycles.

usage: lambert.py GNOMON ENVIRONMENT.hdr WORK OUTPUT     needs NumPy, and `blender` or BLENDER=PATH

A matt court: a floor, a sphere on it, one above it, a box and a wall, all of albedo 0.8. Cycles draws them by its Diffuse BSDF
without bounces, twice with other seeds, and once with one bounce. Gnomon's materials are never Lambert alone. So the scene is
drawn with a white and with a black base color, and also in uniform light of radiance 1 without shadows: the
quotient of the differences white - black is the light of a Lambert surface of albedo 1. In the folder OUTPUT it writes lambert.md,
lambert.json and lambert.png: Cycles, Gnomon, and Cycles with one bounce.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ALBEDO = 0.8
WIDTH, HEIGHT = 384, 288
SAMPLES = 256
BLOCK = 8  # pixels
RAYS = (4, 16)
CAMERA = {"eye": [4.2, 3.0, 6.0], "target": [0, 0.6, 0], "fovYDegrees": 30, "near": 1, "far": 20}


def write_scene(path, color):
    sys.path.insert(0, str(HERE.parents[3] / "server/demo"))
    import glb as glb_writer
    import shapes
    glb = glb_writer.Glb()
    matt = glb.material("matt", (color,) * 3 + (1,), 0, 1)
    def node(name, mesh, at):
        return glb.node(name, mesh=glb.mesh(name, (mesh, matt)), translation=at)
    glb.scene([node("floor", shapes.grid(5, 5, 2, 2), (0, 0, 0)),
               node("standing", shapes.sphere(0.5, 96, 192), (-0.7, 0.5, 0.3)),
               node("floating", shapes.sphere(0.35, 96, 192), (0.9, 1.2, 0.8)),
               node("box", shapes.box(0.8, 0.8, 0.8), (0.9, 0, -0.3)),
               node("wall", shapes.box(3, 1.6, 0.2), (0, 0, -1.6))])
    glb.write(str(path))


def write_uniform(path):
    """Radiance 1 from everywhere, uncompressed."""
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes((128, 128, 128, 129)) * 32)


def gnomon(program, scene, environment, shadows, samples, file):
    camera = {key: CAMERA[key] for key in ("eye", "target")}
    camera["perspective"] = {key: CAMERA[key] for key in ("fovYDegrees", "near", "far")}
    spec = {"width": WIDTH, "height": HEIGHT, "lights": [], "ambient": {"intensity": 0}, "camera": camera,
            "environment": {"file": environment.name, "shadows": shadows, "samples": samples, "extractSun": "none"},
            "output": {"format": "npy", "arrayColors": "linear"}}
    request = file.with_suffix(".spec.json")
    request.write_text(json.dumps(spec))
    subprocess.run([program, "render", scene, "--spec", request, "--environment", environment, "-o", file], check=True)
    return np.load(file)[..., :3].astype(np.float64)


def lambert(program, scenes, environment, uniform, samples, work):
    def difference(light, shadows):
        return np.subtract(*(gnomon(program, scene, light, shadows, samples, work / "gnomon.npy") for scene in scenes))
    with np.errstate(divide="ignore", invalid="ignore"):
        return ALBEDO * difference(environment, "rays") / difference(uniform, "none")


def cycles(scene, environment, bounces, seed, work):
    setup = {"modelFile": str(scene), "environmentFile": str(environment), "rotationDegrees": 0, "camera": CAMERA,
             "width": WIDTH, "height": HEIGHT, "samples": SAMPLES, "bounces": bounces, "seed": seed, "lambert": ALBEDO}
    (work / "setup.json").write_text(json.dumps(setup))
    file = work / f"cycles_{bounces}_{seed}"
    subprocess.run([os.environ.get("BLENDER", "blender"), "--background", "--factory-startup", "--python-exit-code", "1",
                    "--python", HERE / "cycles.py", "--", work / "setup.json", file], check=True, stdout=subprocess.DEVNULL)
    return np.load(f"{file}.npy").astype(np.float64)


def relative(judge, other):
    """Mean absolute difference as a share of the mean, and the ratio of all light."""
    return float(np.abs(other - judge).mean() / judge.mean()), float(other.mean() / judge.mean())


def main(program, environment, work, output):
    work.mkdir(parents=True, exist_ok=True)
    scenes = [work / "white.glb", work / "black.glb"]
    for scene, color in zip(scenes, (1, 0)):
        write_scene(scene, color)
    uniform = work / "uniform.hdr"
    write_uniform(uniform)
    from distances import blocks, inside, png, srgb
    first, second = (cycles(scenes[0], environment, 0, seed, work) for seed in (0, 1))
    bounced = cycles(scenes[0], environment, 1, 0, work)[..., :3]
    where = inside(first[..., 3])
    judge = (first[..., :3] + second[..., :3]) / 2
    ours = {rays: lambert(program, scenes, environment, uniform, rays, work) for rays in RAYS}
    pairs = [("Cycles, another seed", first[..., :3], second[..., :3]),
             *((f"Gnomon, {rays} rays", judge, picture) for rays, picture in ours.items()),
             ("Cycles, one bounce", judge, bounced)]
    rows = []
    for name, a, b in pairs:
        pixels, light = relative(a[where], b[where])
        coarse = relative(blocks(a, where, BLOCK), blocks(b, where, BLOCK))[0]
        rows.append({"picture": name, "pixels": pixels, "blocks": coarse, "light": light})
    text = ["<!-- readme -->", f"Against Cycles without bounces, {SAMPLES} samples, in {environment.stem}:", "",
            "| picture | difference, pixels | difference, 8 x 8 pixels | ratio of all light |", "|---|---|---|---|",
            *(f"| {row['picture']} | {100 * row['pixels']:.2f} % | {100 * row['blocks']:.2f} % | {row['light']:.4f} |"
              for row in rows), "<!-- /readme -->"]
    (output / "lambert.md").write_text("\n".join(text) + "\n")
    (output / "lambert.json").write_text(json.dumps(rows, indent=1) + "\n")
    shown = np.concatenate([np.where(where[..., None], picture, 0) for picture in (judge, ours[RAYS[0]], bounced)], 1)
    png(output / "lambert.png", (255 * srgb(shown) + 0.5).astype(np.uint8))
    print("\n".join(text))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), *(Path(part).resolve() for part in sys.argv[2:5]))

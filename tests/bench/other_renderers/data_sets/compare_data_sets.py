#!/usr/bin/env python3
"""The same data set by Gnomon's example and by Blender: color, depth and ids, 640 x 480, random suns and cameras.

usage: compare_data_sets.py GNOMON SCENE.glb WORK OUTPUT [FRAMES [BLENDER_FRAMES]]     1000 and 12 frames, if not told

Writes OUTPUT/data_sets.md; WORK gets both data sets. Gnomon's samples are those of clients/python/examples/dataset.py, with
its fourth array, shadow; Blender draws the first of these frames. They take turns: half of Gnomon's frames, Blender's, the
other half. Needs NumPy; without Blender (Debian package `blender`) a line says so.
"""

import json
import os
import re
import resource
import shutil
import subprocess
import sys
from argparse import Namespace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
EXAMPLE = ROOT / "clients/python/examples/dataset.py"
WIDTH, HEIGHT, SEED = 640, 480, 1


def measured(command, environment={}):
    """The output of a program, and the seconds that it and its processes spent on all cores."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, env=os.environ | environment, stdout=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{command[0]} ended with {done.returncode}: {done.stdout[-500:]}")
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def by_gnomon(program, scene, folder, frames):
    """The frames up to this number that the folder does not have yet: how many, seconds, processor seconds."""
    output, processor = measured(
        [sys.executable, "-B", EXAMPLE, scene, folder, "--count", str(frames), "--width", str(WIDTH), "--height", str(HEIGHT),
         "--hidden", "0", "--shown", "0", "--seed", str(SEED)],
        {"GNOMON_SERVER": "", "GNOMON_BINARY": str(program), "PYTHONPATH": str(ROOT / "clients/python")})  # fmt: skip
    drawn, seconds = re.search(r"(\d+) frames in ([\d.]+) s", output).groups()
    return int(drawn), float(seconds), processor


def direction_of(sun):
    azimuth, elevation = np.radians(sun.azimuthDegrees), np.radians(sun.elevationDegrees)
    return [np.cos(elevation) * np.sin(azimuth), np.sin(elevation), -np.cos(elevation) * np.cos(azimuth)]


def frames_of(program, scene, count):
    """What Gnomon's first samples show, for Blender."""
    sys.path[:0] = [str(ROOT / "clients/python"), str(EXAMPLE.parent)]
    import dataset
    import gnomon

    options = Namespace(seed=SEED, width=WIDTH, height=HEIGHT, hidden=0)
    with gnomon.Session(binary=program) as session:
        summary, nodes = session.upload(scene).summary, [*session.nodes(scene)]
    for number in range(count):
        pose, K, spec = dataset.random_spec(summary, nodes, number, 0, options)
        yield {"worldFromCamera": pose.tolist(), "focal": K[0, 0], "towardsSun": direction_of(spec.lights[0].sun)}


def by_blender(program, scene, folder, count):
    folder.mkdir(parents=True, exist_ok=True)
    given = folder / "frames.json"
    frames = list(frames_of(program, scene, count))
    given.write_text(json.dumps({"glb": str(scene), "width": WIDTH, "height": HEIGHT, "frames": frames}))
    script = Path(__file__).with_name("blender_data_set.py")
    command = ["blender", "--background", "--factory-startup", "--python", script, "--", given, folder]
    output, processor = measured(command)
    report = json.loads([line for line in output.splitlines() if line.startswith('{"seconds"')][-1])
    return report["frames"], report["seconds"], processor


def table(rows):
    """`rows`: by name, how many frames, seconds, processor seconds."""
    _, (unit_frames, unit_seconds, unit_processor) = rows[0]
    lines = ["| program | frames | frames a second | x seconds | processor seconds a frame | x processor |",
             "|---|---|---|---|---|---|"]  # fmt: skip
    for name, (frames, seconds, processor) in rows:
        x, x_processor = seconds / frames / (unit_seconds / unit_frames), processor / frames / (unit_processor / unit_frames)
        lines.append(f"| {name} | {frames} | {frames / seconds:.3g} | {x:.3g} | {processor / frames:.3g} | {x_processor:.3g} |")
    return "\n".join(lines)


PAGE = """# The same data set

Made by `tests/bench/other_renderers/run BUILD OUTPUT datasets`.

<!-- readme -->

{table}

The demo from random cameras under random suns, {width} x {height}: color, depth and what is seen at each pixel; one file a \
frame on disk, compressed. {machine}, {cores} cores, no GPU; load average before {before:.2f}, after {after:.2f}, this run's \
own included.{absent}

<!-- /readme -->

Frames a second are counted from when the scene is loaded to the last file. Gnomon's are those of
`clients/python/examples/dataset.py`, which writes the shadows as a fourth array. Blender draws the first of these frames, by
Python, with four samples, no bounces and no denoiser, into one OpenEXR file of several layers each. `processor` is the time
of all processes on all cores, start and end included; other work on the machine changes it little.
"""


def main(program, scene, work, output, frames=1000, blender_frames=12):
    program, scene, work = (Path(path).resolve() for path in (program, scene, work))
    frames, before, absent = int(frames), os.getloadavg()[0], ""
    shutil.rmtree(work, ignore_errors=True)
    halves = [by_gnomon(program, scene, work / "gnomon", frames // 2)]
    others = []
    if shutil.which("blender"):
        version = re.search(r"[\d.]+", measured(["blender", "--version"])[0])[0]
        others.append((f"Blender {version}, Cycles", by_blender(program, scene, work / "blender", int(blender_frames))))
    else:
        absent = " Blender is not in the table: there is no `blender` (Debian package `blender`)."
        print("Skipped:" + absent, file=sys.stderr)
    halves.append(by_gnomon(program, scene, work / "gnomon", frames))
    rows = [("Gnomon", tuple(map(sum, zip(*halves)))), *others]
    named = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    page = PAGE.format(table=table(rows), machine=named[1] if named else os.uname().machine, width=WIDTH, height=HEIGHT,
                       cores=os.cpu_count(), before=before, after=os.getloadavg()[0], absent=absent)
    (Path(output) / "data_sets.md").write_text(page)
    print(f"Written to {output}; the data sets to look at: {work}", file=sys.stderr)


if __name__ == "__main__":
    if not 5 <= len(sys.argv) <= 7:
        sys.exit(__doc__)
    main(*sys.argv[1:])

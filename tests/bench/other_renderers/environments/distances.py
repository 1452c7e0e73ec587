#!/usr/bin/env python3
"""Compares the engines' pictures with the judge's, and writes a table of them and a sheet to look at.

usage: distances.py DRAWN OUTPUT

DRAWN is the folder that draw_environments.mjs has filled. In the folder OUTPUT it writes three files named environments:
the table (.md), its numbers (.json), and a sheet (.png) with a row of pictures of each case, sRGB clipped at 1, the judge
first.
"""

import json
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

JUDGE = "Cycles"
ENGINES = ("Gnomon, cpu", "Gnomon, gl", "three.js", "Babylon.js", "Khronos viewer")
SSIM_SIGMA, SSIM_REACH = 1.5, 5
BLOCK = 4  # pixels; the judge's noise counts less in their means
BRIGHTEST = 4.0  # of what is compared: one highlight would outweigh all else


def blurred(picture):
    """By the Gaussian window of Wang et al. (2004), 11 x 11."""
    steps = np.arange(-SSIM_REACH, SSIM_REACH + 1)
    weights = np.exp(-steps ** 2 / (2 * SSIM_SIGMA ** 2))
    weights /= weights.sum()
    for axis in (0, 1):
        padded = np.pad(picture, [(SSIM_REACH, SSIM_REACH) if a == axis else (0, 0) for a in (0, 1)], mode="edge")
        picture = sum(w * np.take(padded, range(i, i + picture.shape[axis]), axis) for i, w in enumerate(weights))
    return picture


def ssim(a, b, where):
    """Mean structural similarity of two pictures of 0..1 (Wang et al., "Image Quality Assessment", 2004)."""
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    mean_a, mean_b = blurred(a), blurred(b)
    aa, bb, ab = blurred(a * a) - mean_a ** 2, blurred(b * b) - mean_b ** 2, blurred(a * b) - mean_a * mean_b
    likeness = (2 * mean_a * mean_b + c1) * (2 * ab + c2) / ((mean_a ** 2 + mean_b ** 2 + c1) * (aa + bb + c2))
    return float(likeness[where].mean())


def srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055)


def inside(cover, reach=1):
    """Pixels of the model alone, with their neighbours: edges differ by how they are smoothed."""
    solid = cover >= 0.999
    for axis in (0, 1):
        for step in range(-reach, reach + 1):
            solid = solid & np.roll(cover >= 0.999, step, axis)
    return solid


def blocks(picture, where, side):
    """Means of squares of `side` pixels that lie wholly in `where`; what is left beyond the last whole square does not count."""
    height, width = (length // side * side for length in where.shape)
    shape = (height // side, side, width // side, side)
    return picture[:height, :width].reshape(*shape, 3).mean((1, 3))[where[:height, :width].reshape(shape).all((1, 3))]


def distance(judge, other, where):
    """In linear light, each number clipped at BRIGHTEST: the mean absolute difference, that as a share of the judge's mean
    light, the same of means over squares of pixels, and the ratio of all light; and SSIM of luminance as it is seen."""
    judged, shown = np.clip(judge, 0, BRIGHTEST), np.clip(other, 0, BRIGHTEST)
    a, b = judged[where], shown[where]
    squares = [blocks(picture, where, BLOCK) for picture in (judged, shown)]
    grey = [srgb(picture) @ (0.2126, 0.7152, 0.0722) * where for picture in (judge, other)]
    off = float(np.abs(a - b).mean())
    coarse = float(np.abs(squares[0] - squares[1]).mean() / squares[0].mean()) if squares[0].size else None
    return {"difference": off, "share": off / float(a.mean()), "blocks": coarse, "light": float(b.mean() / a.mean()),
            "ssim": ssim(*grey, where)}


def png(path, picture):
    """`picture`: rows of 8-bit red, green, blue."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    height, width, _ = picture.shape
    rows = b"".join(b"\0" + row.tobytes() for row in picture)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


def measured(folder):
    """A case's rows, and its pictures for the sheet, where the judge has drawn it."""
    judge = np.load(folder / f"{JUDGE}.npy")
    cover, judge = judge[..., 3], judge[..., :3]
    where = inside(cover)
    rows, pictures = [], [judge]
    for engine in ENGINES:
        file, about = folder / f"{engine}.npy", folder / f"{engine}.json"
        if not file.exists() or not about.exists():
            pictures.append(np.zeros_like(judge))
            continue
        other, said = np.load(file)[..., :3], json.loads(about.read_text())
        rows.append({"case": folder.name, "engine": engine, "version": said["version"],
                     "milliseconds": float(np.median(said["times"])), "processorMilliseconds": said["processor"],
                     **distance(judge, other, where)})
        pictures.append(np.where(cover[..., None] > 0, other, 0))
    return rows, np.concatenate([(255 * srgb(picture) + 0.5).astype(np.uint8) for picture in pictures], 1)


def table(rows, judged):
    engines = [engine for engine in ENGINES if any(row["engine"] == engine for row in rows)]
    lines = ["| model, environment | " + " | ".join(engines) + " | Cycles |", "|---" * (len(engines) + 2) + "|"]
    for case, milliseconds in judged.items():
        found = {row["engine"]: row for row in rows if row["case"] == case}
        nearest = min((row["share"] for row in found.values()), default=None)
        cells = []
        for engine in engines:
            row = found.get(engine)
            coarse = row and ("-" if row["blocks"] is None else f"{100 * row['blocks']:.1f}")
            text = row and f"{100 * row['share']:.1f} / {coarse} %, {row['ssim']:.3f}, {row['processorMilliseconds']:.0f} ms"
            cells.append("-" if row is None else f"**{text}**" if row["share"] == nearest else text)
        lines.append(f"| {case} | " + " | ".join(cells) + f" | {milliseconds / 1000:.0f} s |")
    return lines


def main(drawn, output):
    rows, sheet, judged = [], [], {}
    for folder in sorted(path.parent for path in drawn.glob(f"*/{JUDGE}.npy")):
        found, pictures = measured(folder)
        rows += found
        sheet.append(pictures)
        judged[folder.name] = json.loads((folder / f"{JUDGE}.json").read_text())["times"][0]
    if not sheet:
        sys.exit(f"Nothing in {drawn} was drawn by {JUDGE}, which all others are compared with.")
    versions = sorted({f"{row['engine']} {row['version']}" for row in rows})
    text = ["<!-- readme -->", "Of each: mean absolute difference to Cycles in linear light, as a share of its mean light, "
            f"by pixel / by {BLOCK} x {BLOCK} pixels; "
            "SSIM; processor time of a warm frame, of all cores together. Bold: the nearest.", "",
            *table(rows, judged), "<!-- /readme -->", "",
            "Versions: " + ", ".join(versions) + "."]
    (output / "environments.md").write_text("\n".join(text) + "\n")
    (output / "environments.json").write_text(json.dumps(rows, indent=1) + "\n")
    png(output / "environments.png", np.concatenate(sheet, 0))
    print("\n".join(text))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

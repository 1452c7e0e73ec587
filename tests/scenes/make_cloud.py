#!/usr/bin/env python3
"""Writes a cumulus as a NumPy array of bytes, [z, y, x]: 0 = clear air, 255 = the thickest of the cloud.

usage: make_cloud.py FILE.npy
"""

import math
import random
import struct
import sys

SIZE = (72, 40, 56)  # voxels along x, y, z
ASPECT = (1.8, 1.0, 1.4)  # of the box that it is made for
BASE = 0.12  # height of the flat underside
OCTAVES = ((5.0, 0.5), (11.0, 0.28), (23.0, 0.16), (47.0, 0.09))  # cells along the height, weight


def lattice(seed):
    """Smooth noise, -1..1, that is the same wherever and whenever it is made."""
    values = list(range(256))
    random.Random(seed).shuffle(values)

    def corner(x, y, z):
        return values[(values[(values[x & 255] + y) & 255] + z) & 255] / 127.5 - 1

    def noise(x, y, z):
        cell = [math.floor(v) for v in (x, y, z)]
        part = [v - c for v, c in zip((x, y, z), cell)]
        share = [p * p * (3 - 2 * p) for p in part]
        total = 0.0
        for i in range(8):
            ends = (i & 1, i >> 1 & 1, i >> 2)
            weight = 1.0
            for end, s in zip(ends, share):
                weight *= s if end else 1 - s
            total += weight * corner(*(c + e for c, e in zip(cell, ends)))
        return total

    return noise


def heaps():
    """Spheres that make a heap, as x, y, z, radius: wide and low outside, high in the middle."""
    chance = random.Random(7)
    made = []
    for ring, count, radius, height in ((0.0, 1, 0.36, 0.42), (0.28, 5, 0.27, 0.34), (0.55, 9, 0.2, 0.22)):
        for i in range(count):
            angle = 2 * math.pi * (i + 0.4 * chance.random()) / count
            x = 0.5 * ASPECT[0] * (1 + ring * 1.1 * math.cos(angle))
            z = 0.5 * ASPECT[2] * (1 + ring * 1.0 * math.sin(angle))
            made.append((x, BASE + height * (0.75 + 0.5 * chance.random()), z, radius * (0.8 + 0.4 * chance.random())))
    return made


def density(x, y, z, spheres, noise):
    inside = max(1 - math.dist((x, y, z), sphere[:3]) / sphere[3] for sphere in spheres)
    if inside < -0.8:
        return 0.0
    inside += 0.9 * sum(weight * noise(x * cells, y * cells, z * cells) for cells, weight in OCTAVES)
    below = (y - BASE) / 0.05  # the underside is flat
    return max(0.0, min(1.0, 2.6 * inside)) * max(0.0, min(1.0, below))


def make_cloud():
    spheres, noise = heaps(), lattice(3)
    voxels = bytearray()
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                place = [(index + 0.5) / count * length for index, count, length in zip((i, j, k), SIZE, ASPECT)]
                voxels.append(round(255 * density(*place, spheres, noise)))
    return bytes(voxels)


def npy(voxels):
    header = f"{{'descr': '|u1', 'fortran_order': False, 'shape': ({SIZE[2]}, {SIZE[1]}, {SIZE[0]}), }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + voxels


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], "wb") as file:
        file.write(npy(make_cloud()))

#!/usr/bin/env python3
"""Writes the scene by which orientation and units of the engines are compared.

usage: spheres.py MODEL.glb ENVIRONMENT.hdr

Above a matt white sphere and a glossy red one, below rough metal and a mirror, far enough apart to leave each other the light.
The environment is of radiance 0.5, its lower half 0.1, and has four lights of radiance 8: red towards +X, green towards +Z,
blue towards -X, white at the zenith.
"""

import math
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "server/demo"))
import glb as glb_writer  # noqa: E402
import shapes  # noqa: E402

WIDTH, HEIGHT = 512, 256
LIGHTS = (((1, 0, 0), (8, 0, 0)), ((0, 0, 1), (0, 8, 0)), ((-1, 0, 0), (0, 0, 8)), ((0, 1, 0), (8, 8, 8)))
LIGHT_RADIUS = math.radians(12)


def model():
    glb = glb_writer.Glb()
    looks = (("matt", (0.8, 0.8, 0.8, 1), 0, 1), ("glossy", (0.6, 0.05, 0.05, 1), 0, 0.25),
             ("rough metal", (0.9, 0.7, 0.4, 1), 1, 0.5), ("mirror", (0.9, 0.9, 0.9, 1), 1, 0.05))
    nodes = []
    for i, (name, color, metallic, roughness) in enumerate(looks):
        mesh = glb.mesh(name, (shapes.sphere(0.3, 64, 128), glb.material(name, color, metallic, roughness)))
        nodes.append(glb.node(name, mesh=mesh, translation=(2 * (i % 2) - 1, 1 - 2 * (i // 2), 0)))
    glb.scene(nodes)
    return glb


def radiance(row, column):
    """Of a pixel; the middle of the picture lies towards +X, and columns go on towards +Z."""
    elevation = math.pi * (0.5 - (row + 0.5) / HEIGHT)
    azimuth = 2 * math.pi * ((column + 0.5) / WIDTH - 0.5)
    away = (math.cos(elevation) * math.cos(azimuth), math.sin(elevation), math.cos(elevation) * math.sin(azimuth))
    for direction, color in LIGHTS:
        if sum(a * b for a, b in zip(away, direction)) > math.cos(LIGHT_RADIUS):
            return color
    return (0.5,) * 3 if elevation > 0 else (0.1,) * 3


def rgbe(color):
    largest = max(color)
    mantissa, exponent = math.frexp(largest)
    scale = 256 * mantissa / largest
    return bytes(int(value * scale) for value in color) + struct.pack("B", exponent + 128)


def write_environment(path):
    with open(path, "wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
        for row in range(HEIGHT):
            pixels = [rgbe(radiance(row, column)) for column in range(WIDTH)]
            file.write(struct.pack(">BBH", 2, 2, WIDTH))  # each channel by itself, in literal runs of 128
            for channel in range(4):
                for first in range(0, WIDTH, 128):
                    file.write(b"\x80" + bytes(pixel[channel] for pixel in pixels[first:first + 128]))


model().write(sys.argv[1])
write_environment(sys.argv[2])

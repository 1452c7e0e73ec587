"""Small procedural textures that repeat without a seam, as PNG bytes. Colors are sRGB, 0..255."""

import math
import random

import glb


def noise(size, cells, seed):
    """Value noise that repeats, 0..1, as rows of floats."""
    rng = random.Random(seed)
    lattice = [[rng.random() for _ in range(cells)] for _ in range(cells)]
    steps = []
    for i in range(size):
        at = i * cells / size
        cell, part = int(at), at - int(at)
        steps.append((cell, (cell + 1) % cells, part * part * (3 - 2 * part)))
    rows = []
    for y0, y1, v in steps:
        upper, lower = lattice[y0], lattice[y1]
        column = [a + (b - a) * v for a, b in zip(upper, lower)]
        rows.append([column[x0] + (column[x1] - column[x0]) * u for x0, x1, u in steps])
    return rows


def clouds(size, cells, octaves, seed):
    """Octaves of noise, each twice as fine and half as strong; 0..1 with mean 0.5."""
    layers = [noise(size, min(cells << octave, size), seed + octave) for octave in range(octaves)]
    weights = [0.5 ** octave for octave in range(octaves)]
    total = sum(weights)
    return [[sum(w * layer[y][x] for w, layer in zip(weights, layers)) / total for x in range(size)]
            for y in range(size)]


def _byte(value):
    return 0 if value < 0 else 255 if value > 255 else int(value + 0.5)


def mottled(size, color, contrast, seed, cells=8, octaves=5, stretch=1):
    """One color, lighter and darker in spots; `stretch` > 1 draws the spots out along v, mirrored in the middle."""
    field = clouds(size, cells, octaves, seed)
    pixels = bytearray()
    for y in range(size):
        row = field[min(y, size - 1 - y) // stretch]
        for x in range(size):
            shade = 1 + contrast * (row[x] - 0.5) * 2
            pixels.extend(_byte(c * shade) for c in color)
    return glb.png(size, size, 3, pixels)


def tiles(size, count, color, joint, seed):
    """Square slabs, `count` a side, each of its own shade, with joints between them."""
    rng = random.Random(seed)
    shades = [[0.88 + 0.22 * rng.random() for _ in range(count)] for _ in range(count)]
    field = clouds(size, 8, 5, seed + 100)
    slab = size // count
    pixels = bytearray()
    for y in range(size):
        for x in range(size):
            edge = min(x % slab, y % slab, slab - 1 - x % slab, slab - 1 - y % slab)
            base = joint if edge < 1 else color
            shade = shades[y // slab % count][x // slab % count] * (0.86 + 0.28 * field[y][x])
            if edge == 1:
                shade *= 0.9
            pixels.extend(_byte(c * shade) for c in base)
    return glb.png(size, size, 3, pixels)


def checker(size, count, light, dark):
    """Squares, `count` a side."""
    cell = size // count
    pixels = bytearray()
    for y in range(size):
        for x in range(size):
            pixels.extend(light if (x // cell + y // cell) % 2 == 0 else dark)
    return glb.png(size, size, 3, pixels)


def leaves(size, count, color, seed):
    """Overlapping pointed leaves on nothing: alpha is 0 or 255."""
    rng = random.Random(seed)
    average = [_byte(c * 0.9) for c in color]
    pixels = bytearray(average + [0]) * (size * size)
    for _ in range(count):
        # A leaf grows from near the middle outwards, all of it inside of the card.
        angle = rng.random() * 2 * math.pi
        length = size * (0.16 + 0.1 * rng.random())
        away = rng.random() * (size * 0.47 - length)
        x0 = size / 2 + math.cos(angle) * away
        y0 = size / 2 + math.sin(angle) * away
        heading = angle + (rng.random() - 0.5) * 1.6
        shade = 0.75 + 0.5 * rng.random()
        dx, dy = math.cos(heading), math.sin(heading)
        reach = int(length) + 2
        for y in range(max(0, int(y0) - reach), min(size, int(y0) + reach)):
            for x in range(max(0, int(x0) - reach), min(size, int(x0) + reach)):
                along = ((x - x0) * dx + (y - y0) * dy) / length
                if not 0 <= along <= 1:
                    continue
                across = abs((y - y0) * dx - (x - x0) * dy) / length
                if across > 0.24 * math.sin(math.pi * along ** 0.75):
                    continue
                vein = 0.82 if across < 0.02 else 1.0
                at = (y * size + x) * 4
                pixels[at:at + 4] = bytes([_byte(c * shade * vein) for c in color] + [255])
    return glb.png(size, size, 4, pixels)


def bumps(size, count):
    """A tangent-space normal map of `count` x `count` round studs on a flat ground."""
    cell = size / count
    pixels = bytearray()
    for y in range(size):
        for x in range(size):
            u = ((x + 0.5) % cell) / cell * 2 - 1
            v = ((y + 0.5) % cell) / cell * 2 - 1
            distance = math.hypot(u, v) / 0.8
            # Half a sphere, flattened to slopes of at most one.
            slope = 0.0 if distance >= 1 or distance == 0 else math.sin(math.pi * distance) / distance
            nx, ny = u * slope, -v * slope
            length = math.sqrt(nx * nx + ny * ny + 1)
            pixels.extend((_byte((nx / length + 1) * 127.5), _byte((ny / length + 1) * 127.5),
                           _byte((1 / length + 1) * 127.5)))
    return glb.png(size, size, 3, pixels)

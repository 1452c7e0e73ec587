"""The grown parts of the demo scene."""

import math
import random

from shapes import Mesh, grid, lathe

FLAT_RADIUS = 34.0  # the ground is level this far around the plaza


def ground_height(x, z):
    """Level around the plaza, low hills towards the edge."""
    distance = math.hypot(x, z)
    if distance < FLAT_RADIUS:
        return 0.0
    t = min(1.0, (distance - FLAT_RADIUS) / 60.0)
    swell = math.sin(x * 0.05 + 1.0) * math.cos(z * 0.043) * 1.6 + math.sin(x * 0.021 - z * 0.017) * 2.4 + 1.2
    return t * t * (3 - 2 * t) * swell


def ground(size, cells):
    """Colored by vertex, so that the repeating texture does not show from afar."""

    def tint(x, _, z):
        patch = math.sin(x * 0.11 + 2) * math.sin(z * 0.09 - 1) + 0.5 * math.sin(x * 0.31 - z * 0.27)
        return (0.92 + 0.1 * patch, 0.95 + 0.05 * patch, 0.85 + 0.05 * patch)

    return grid(size, size, cells, cells, ground_height).paint(tint)


def path(width, z_from, z_to, steps):
    """A strip along Z that follows the ground, 5 cm above it."""
    mesh = Mesh()
    for step in range(steps + 1):
        z = z_from + (z_to - z_from) * step / steps
        for side in (-1, 1):
            x = side * width / 2
            mesh.vertex((x, ground_height(x, z) + 0.05, z), (0, 1, 0), (x, z))
    for step in range(steps):
        a = 2 * step
        if z_to > z_from:
            mesh.quad(a, a + 2, a + 3, a + 1)
        else:
            mesh.quad(a, a + 1, a + 3, a + 2)
    return mesh


def trunk(height, seed):
    """A bent trunk with five boughs."""
    rng = random.Random(seed)
    mesh = Mesh()
    _limb(mesh, (0, 0, 0), (rng.uniform(-0.3, 0.3), height, rng.uniform(-0.3, 0.3)), 0.24, 0.1)
    for i in range(5):
        angle = 2 * math.pi * (i + rng.random() * 0.6) / 5
        start = height * (0.55 + 0.08 * i)
        reach = height * rng.uniform(0.28, 0.4)
        _limb(mesh, (0, start, 0), (math.sin(angle) * reach, start + reach * 0.75, math.cos(angle) * reach), 0.09, 0.03)
    return mesh


def _limb(mesh, start, end, thick, thin, sides=9):
    """A tapered tube between two points."""
    axis = [e - s for s, e in zip(start, end)]
    length = math.sqrt(sum(a * a for a in axis))
    axis = [a / length for a in axis]
    reference = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.8 else (0.0, 0.0, 1.0)
    u = [axis[1] * reference[2] - axis[2] * reference[1], axis[2] * reference[0] - axis[0] * reference[2],
         axis[0] * reference[1] - axis[1] * reference[0]]
    norm = math.sqrt(sum(c * c for c in u))
    u = [c / norm for c in u]
    v = [axis[1] * u[2] - axis[2] * u[1], axis[2] * u[0] - axis[0] * u[2], axis[0] * u[1] - axis[1] * u[0]]
    first = len(mesh.positions) // 3
    for point, radius, along in ((start, thick, 0.0), (end, thin, length)):
        for side in range(sides + 1):
            angle = 2 * math.pi * side / sides
            normal = [math.cos(angle) * a + math.sin(angle) * b for a, b in zip(u, v)]
            mesh.vertex([p + radius * n for p, n in zip(point, normal)], normal, (side / sides, -along))
    for side in range(sides):
        a, b = first + side, first + sides + 1 + side
        mesh.quad(a, a + 1, b + 1, b)


def crown(radius, height, middle, cards, seed):
    """Leaf cards over several balls of foliage. Their normals point out of the crown, so that it is lit as one body."""
    rng = random.Random(seed)
    clumps = [(0.0, middle, 0.0, 0.62)]
    for i in range(7):
        angle = 2 * math.pi * (i + rng.random() * 0.5) / 7
        clumps.append((math.sin(angle) * radius * 0.55, middle + height * rng.uniform(-0.28, 0.3),
                       math.cos(angle) * radius * 0.55, rng.uniform(0.38, 0.5)))
    mesh = Mesh()
    for card in range(cards):
        cx, cy, cz, share = clumps[card % len(clumps)]
        y = rng.uniform(-1, 1)
        angle = rng.uniform(0, 2 * math.pi)
        flat = math.sqrt(1 - y * y)
        out = (flat * math.cos(angle), y, flat * math.sin(angle))
        depth = share * radius * rng.uniform(0.55, 1.0)
        at = (cx + out[0] * depth, cy + out[1] * depth * height / radius * 0.8, cz + out[2] * depth)
        _card(mesh, at, out, rng.uniform(0.75, 1.15), rng)
    return mesh


def _card(mesh, at, out, size, rng):
    """A square that faces roughly outwards, turned at random in its plane."""
    facing = [o + rng.uniform(-0.7, 0.7) for o in out]
    norm = math.sqrt(sum(c * c for c in facing))
    facing = [c / norm for c in facing]
    angle = rng.uniform(0, 2 * math.pi)
    reference = (math.cos(angle), 0.3, math.sin(angle))
    u = [facing[1] * reference[2] - facing[2] * reference[1], facing[2] * reference[0] - facing[0] * reference[2],
         facing[0] * reference[1] - facing[1] * reference[0]]
    norm = math.sqrt(sum(c * c for c in u)) or 1.0
    u = [c / norm * size / 2 for c in u]
    v = [facing[1] * u[2] - facing[2] * u[1], facing[2] * u[0] - facing[0] * u[2], facing[0] * u[1] - facing[1] * u[0]]
    corners = [[p + a * i + b * j for p, a, b in zip(at, u, v)] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    normal = [0.7 * o + 0.3 * f for o, f in zip(out, facing)]
    norm = math.sqrt(sum(c * c for c in normal))
    mesh.flat_quad(corners, [c / norm for c in normal], ((0, 1), (1, 1), (1, 0), (0, 0)))


def cypress(height, seed):
    """A slender tree as one lumpy body, darker below."""
    rng = random.Random(seed)
    phases = [rng.uniform(0, 2 * math.pi) for _ in range(3)]

    def lumps(angle):
        return 1 + 0.1 * math.sin(3 * angle + phases[0]) + 0.06 * math.sin(5 * angle + phases[1])

    profile = [(0.0, 0.35)]
    for step in range(1, 11):
        t = step / 11
        bulge = math.sin(math.pi * t ** 0.62) ** 0.8 * (1 + 0.12 * math.sin(11 * t + phases[2]))
        profile.append((0.115 * height * bulge, 0.35 + (height - 0.35) * t))
    profile.append((0.0, height))
    mesh = lathe(profile, 18, crease=80, ripple=lumps)
    mesh.append(lathe([(0.16, 0.0), (0.13, 0.7)], 8))

    def shade(_, y, __):
        t = 0.45 + 0.55 * min(1.0, y / height * 1.4)
        return (0.11 * t, 0.21 * t, 0.075 * t) if y > 0.8 else (0.09, 0.06, 0.04)

    return mesh.paint(shade)

"""Scenes for tests/hard_cases: sizes, shapes and places at which shadows go wrong.

Each has a camera node called "camera". North is -Z, metres, grounds lie at y = 0.
"""

import math
import random

from basic_scenes import BLUE, GREEN, GREY, RED, SAND, Stage, _ell
from glb import Glb, png
from shapes import Mesh, box, grid


def _scaled(factor):
    """The cube on its plane, everything larger by `factor`."""
    glb = Glb()
    ground = glb.node("ground", mesh=glb.mesh("ground", (grid(20, 20, 1, 1), glb.material("ground", SAND))))
    cube = glb.node("box", mesh=glb.mesh("box", (box(2, 2, 2), glb.material("box", GREY))))
    root = glb.node("root", scale=[factor] * 3, children=[ground, cube])
    camera = glb.camera_node("camera", glb.perspective(45, 0.01 * factor), [c * factor for c in (5, 4, 7)],
                             (0, factor, 0))
    glb.scene([root, camera])
    return glb


def micro():
    return _scaled(1e-6)


def giga():
    return _scaled(5e7)


def pebble():
    stage = Stage(1000.0, eye=(0.006, 0.005, 0.008), target=(0, 0.0005, 0))
    stage.add("pebble", box(1e-3, 1e-3, 1e-3), RED)
    return stage.finish()


def ladder():
    """A box at every power of ten metres before the camera, each as wide as a fifth of its distance."""
    stage = Stage(4e5, eye=(0, 0.01, 0), target=(0, 0.01, -1), fov=60)
    for power in range(-2, 5):
        away = 10.0 ** power
        size = 0.2 * away
        stage.add(f"box at {away:g}", box(size, size, size), RED if power % 2 else BLUE,
                  translation=[away * (0.35 if power % 2 else -0.35), 0.0, -away])
    return stage.finish()


def upstream():
    """Nothing stands near the ground in view: a slab hangs 400 m up towards a sun of direction (1, -2, 0.5)."""
    stage = Stage(20.0, eye=(4, 5, 9), target=(0, 0, 0))
    length = math.sqrt(1 + 4 + 0.25)
    stage.add("slab", box(5, 0.5, 5), translation=[-400 / length, 800 / length, -200 / length])
    return stage.finish()


def faulty_triangles():
    stage = Stage(eye=(5, 4, 7))
    stage.add("box", box(2, 2, 2))
    faulty = box(1, 1, 1)
    a = faulty.vertex((1.5, 0, 0), (0, 1, 0))
    b = faulty.vertex((2.5, 1, 0), (0, 1, 0))
    c = faulty.vertex((3.5, 2, 0), (0, 1, 0))
    faulty.triangle(a, b, c)  # on one line
    faulty.triangle(a, a, b)
    faulty.triangle(a, a, a)
    for axis in range(3):
        place = [1.5, 1.0, 1.0]
        place[axis] = math.nan
        bad = faulty.vertex(place, (0, 1, 0))
        faulty.triangle(a, b, bad)
        faulty.triangle(bad, c, a)
    stage.add("faulty box", faulty, BLUE, translation=[-3.0, 0.0, 2.0])
    return stage.finish()


def odd_nodes():
    """One shape under the transforms that go wrong: flattened, vanished, mirrored, sheared."""
    stage = Stage(eye=(1, 6, 13), target=(0, 0.8, 0))
    glb = stage.glb
    shape = glb.mesh("ell", (_ell(), glb.material("ell", BLUE)))
    pane = glb.mesh("ell, both sides", (_ell(), glb.material("flat ell", GREEN, double_sided=True)))
    stage.nodes.append(glb.node("flattened", mesh=pane, translation=[-5.0, 0.0, 0.0], scale=[1.0, 1.0, 0.0]))
    stage.nodes.append(glb.node("a line", mesh=pane, translation=[-3.4, 0.0, 0.0], scale=[0.0, 1.0, 0.0]))
    stage.nodes.append(glb.node("a point", mesh=pane, translation=[-2.8, 0.5, 0.0], scale=[0.0, 0.0, 0.0]))
    stage.nodes.append(glb.node("mirrored", mesh=shape, translation=[-0.6, 0.0, 0.0], scale=[-1.0, 1.0, 1.0]))
    stage.nodes.append(glb.node("upside down", mesh=shape, translation=[0.8, 2.4, 0.0], scale=[1.0, -1.0, 1.0]))
    half = math.radians(35) / 2
    inner = glb.node("turned", mesh=shape, rotation=[0.0, 0.0, math.sin(half), math.cos(half)])
    stage.nodes.append(glb.node("sheared", translation=[3.6, 0.8, 0.0], scale=[0.5, 1.3, 1.0], children=[inner]))
    mirror = glb.node("turned too", mesh=shape, rotation=[0.0, 0.0, math.sin(half), math.cos(half)])
    stage.nodes.append(glb.node("sheared and mirrored", translation=[5.6, 0.8, 0.0], scale=[-0.5, 1.3, 1.0],
                                children=[mirror]))
    return stage.finish()


def _triangle():
    mesh = Mesh()
    mesh.triangle(*[mesh.vertex(corner, (0, 1, 0)) for corner in ((-1, 0, 1), (1, 0, 1), (0, 0, -1))])
    return mesh


def single_triangle():
    stage = Stage(0, eye=(2, 2, 3), target=(0, 0, 0))
    stage.add("triangle", _triangle(), RED)
    return stage.finish()


def triangle_over_plane():
    stage = Stage(eye=(3, 4, 5), target=(0, 0.5, 0))
    stage.add("triangle", _triangle(), material=stage.glb.material("triangle", RED, double_sided=True),
              translation=[0.0, 1.0, 0.0])
    return stage.finish()


def coplanar():
    """A square in the very plane of the ground, and a box to throw a shadow over both."""
    stage = Stage(eye=(5, 4, 7))
    stage.add("square", grid(4, 4, 1, 1), RED, translation=[1.0, 0.0, 1.0])
    stage.add("box", box(1, 1.5, 1), translation=[-0.5, 0.0, 0.0])
    return stage.finish()


def leaves():
    """1,000 masked cards in a ball, one over the other."""
    stage = Stage(12.0, eye=(5, 4, 7), target=(0, 1.4, 0))
    dots = [(60, 120, 40, 255) if (x - 15.5) ** 2 + 2.5 * (y - 15.5) ** 2 < 200 else (60, 120, 40, 0)
            for y in range(32) for x in range(32)]
    texture = stage.glb.texture(png(32, 32, 4, [c for pixel in dots for c in pixel]), "leaf")
    chance = random.Random(7)
    cards = Mesh()
    for _ in range(1000):
        z = chance.uniform(-1, 1)
        turn = chance.uniform(0, 2 * math.pi)
        normal = (math.cos(turn) * math.sqrt(1 - z * z), z, math.sin(turn) * math.sqrt(1 - z * z))
        place = [1.3 * chance.uniform(0.2, 1) ** (1 / 3) * c for c in normal]
        place[1] += 1.9
        side = (-math.sin(turn), 0.0, math.cos(turn))
        along = (normal[1] * side[2] - normal[2] * side[1], normal[2] * side[0] - normal[0] * side[2],
                 normal[0] * side[1] - normal[1] * side[0])
        tilt = chance.uniform(-0.5, 0.5)
        face = [n + tilt * s for n, s in zip(normal, side)]
        length = math.sqrt(sum(c * c for c in face))
        face = [c / length for c in face]
        across = [s - tilt * n for n, s in zip(normal, side)]
        length = math.sqrt(sum(c * c for c in across))
        across = [c / length for c in across]
        size = chance.uniform(0.08, 0.16)
        corners = [[p + size * (u * b + v * a) for p, a, b in zip(place, along, across)]
                   for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        edge_u = [q - p for p, q in zip(corners[0], corners[1])]
        edge_v = [q - p for p, q in zip(corners[0], corners[3])]
        facing = sum(f * c for f, c in zip(face, (edge_u[1] * edge_v[2] - edge_u[2] * edge_v[1],
                                                  edge_u[2] * edge_v[0] - edge_u[0] * edge_v[2],
                                                  edge_u[0] * edge_v[1] - edge_u[1] * edge_v[0])))
        cards.flat_quad(corners if facing > 0 else corners[::-1], face)
    stage.add("leaves", cards, material=stage.glb.material("leaf", texture=texture, mask=0.5, double_sided=True))
    return stage.finish()


def pinhole():
    """A roof of 8 m with a hole of 1 cm: as wide as a texel of a tile of 1024 that spans the ground."""
    stage = Stage(10.0, eye=(0.4, 1.4, 1.6), target=(0, 0, 0), fov=60)
    roof = Mesh()
    hole, side = 0.005, 4.0
    width = side - hole
    for x, z, w, d in ((-(hole + width / 2), 0, width, 2 * side), (hole + width / 2, 0, width, 2 * side),
                       (0, -(hole + width / 2), 2 * hole, width), (0, hole + width / 2, 2 * hole, width)):
        roof.append(box(w, 0.002, d), (x, 2.0, z))
    stage.add("roof", roof, RED)
    return stage.finish()


def room_corner():
    """A room of 6 m, open to the south and above the camera, with a crate in it."""
    stage = Stage(6.0, eye=(1.5, 2.2, 5.5), target=(-0.6, 1.0, -1.0), fov=60)
    stage.add("west wall", box(0.2, 4, 6), translation=[-3.1, 0.0, 0.0])
    stage.add("north wall", box(6.4, 4, 0.2), translation=[0.0, 0.0, -3.1])
    stage.add("crate", box(1, 1, 1), BLUE, translation=[-1.0, 0.0, -0.8])
    return stage.finish()


def stack():
    """300 panes, one above the other, over a ground."""
    stage = Stage(12.0, eye=(4, 3, 6), target=(0, 1.2, 0))
    panes = Mesh()
    for i in range(300):
        panes.append(box(1.5, 0.002, 1.5), (0, 0.5 + 0.006 * i, 0))
    stage.add("panes", panes, RED)
    return stage.finish()

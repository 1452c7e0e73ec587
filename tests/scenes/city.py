"""The benchmark's scene: about 600,000 triangles on 200 x 200 m, seen from street level."""

import math
import random

import textures
from architecture import column
from garden import crown, trunk
from glb import Glb, look_along, sun_direction, turn
from shapes import Mesh, box, grid, lathe, sphere

SITES = [-91, -65, -39, -13, 13, 39, 65, 91]  # where blocks stand along X and Z; the streets run between them


def terrain_height(x, z):
    return 0.9 * math.sin(x * 0.031 + 0.4) * math.cos(z * 0.027) + 0.25 * math.sin(x * 0.11 - z * 0.09)


def window_bay():
    """A framed window, 1.3 x 1.8 m, that stands out of the plane z = 0; its pane is a Mesh of its own."""
    frame, pane = Mesh(), Mesh()
    for x in (-0.65, 0.65):
        frame.append(box(0.16, 1.8, 0.16), (x, 0, 0.08))
    frame.append(box(1.7, 0.12, 0.34), (0, -0.12, 0.17))
    frame.append(box(1.6, 0.18, 0.24), (0, 1.8, 0.12))
    frame.append(box(0.06, 1.8, 0.08), (0, 0, 0.06))
    frame.append(box(1.14, 0.06, 0.08), (0, 1.1, 0.06))
    pane.flat_quad(((-0.57, 0, 0.03), (0.57, 0, 0.03), (0.57, 1.8, 0.03), (-0.57, 1.8, 0.03)), (0, 0, 1))
    return frame, pane


def building(rng):
    """Walls, frames and panes of one house, as three meshes; its front looks along +Z."""
    width, depth, floors = rng.uniform(13, 17), rng.uniform(12, 16), rng.randint(4, 8)
    storey, foot = 3.3, 3.0
    height = floors * storey + 1.0
    walls = box(width, height + foot, depth)
    for i in range(1, len(walls.positions), 3):
        walls.positions[i] -= foot
    frames, panes = Mesh(), Mesh()
    frame, pane = window_bay()
    for yaw, along, out in ((0, width, depth), (180, width, depth), (90, depth, width), (270, depth, width)):
        bays = int(along / 2.9)
        cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
        for floor in range(floors):
            for bay in range(bays):
                x, z = (bay - (bays - 1) / 2) * along / bays, out / 2
                at = (cos * x + sin * z, 0.9 + floor * storey, cos * z - sin * x)
                frames.append(frame, at, yaw)
                panes.append(pane, at, yaw)
    for level in [0.55] + [floor * storey + 0.3 for floor in range(1, floors)]:
        frames.append(box(width + 0.24, 0.14, depth + 0.24), (0, level, 0))
    frames.append(box(width + 0.9, 0.4, depth + 0.9), (0, height, 0))
    frames.append(box(width + 0.3, 0.7, 0.3), (0, height + 0.4, depth / 2))
    for _ in range(4):
        walls.append(box(rng.uniform(0.6, 2.2), rng.uniform(1.2, 3.0), rng.uniform(0.6, 2.2)),
                     (rng.uniform(-0.4, 0.4) * width, height + 0.3, rng.uniform(-0.4, 0.4) * depth))
    return walls, frames, panes


def boulder(seed, rings=44, segments=56):
    """An irregular body about 1.4 m across."""
    rng = random.Random(seed)
    a, b, c = (rng.uniform(0, 2 * math.pi) for _ in range(3))
    mesh = sphere(0.7, rings, segments)
    p = mesh.positions
    for i in range(0, len(p), 3):
        x, y, z = p[i:i + 3]
        grow = 1 + 0.12 * math.sin(4 * x + a) + 0.12 * math.sin(5 * y + b) + 0.1 * math.sin(4.5 * z + c)
        p[i], p[i + 1], p[i + 2] = x * grow, y * grow, z * grow
    return mesh


def add_houses(glb, rng):
    facades = [glb.material(f"facade {i}", color, roughness=0.9) for i, color in enumerate(
        ((0.55, 0.42, 0.32, 1), (0.6, 0.56, 0.48, 1), (0.42, 0.22, 0.16, 1), (0.5, 0.46, 0.34, 1)))]
    stone = glb.material("frames", (0.66, 0.64, 0.58, 1), roughness=0.8)
    glass = glb.material("glass", (0.05, 0.07, 0.09, 1), roughness=0.15)
    houses = []
    for i in range(12):
        walls, frames, panes = building(rng)
        houses.append(glb.mesh(f"house {i}", (walls, facades[i % 4]), (frames, stone), (panes, glass)))
    nodes = []
    for row, z in enumerate(SITES):
        for line, x in enumerate(SITES):
            if math.hypot(x, z) > 105 or (abs(x) < 20 and abs(z) < 20):
                continue
            nodes.append(glb.node(mesh=houses[(row * 5 + line * 7) % len(houses)],
                                  translation=[x, terrain_height(x, z), z],
                                  rotation=turn(90 * rng.randint(0, 3))))
    return nodes


def add_street_furniture(glb, rng):
    """Columns and balls along the street x = 0, trees along the others, boulders in the square."""
    stone = glb.material("stone", (0.6, 0.57, 0.5, 1))
    pillar = glb.mesh("column", (column(5.0, 0.34), stone))
    ball = glb.mesh("ball", (sphere(0.4, 20, 36), glb.material("brass", (0.8, 0.6, 0.25, 1), 0.8, 0.35)))
    stand = glb.mesh("stand", (lathe([(0.3, -0.4), (0.3, 0.3), (0.2, 0.4), (0, 0.4)], 24), stone))
    leaf = glb.texture(textures.leaves(64, 40, (90, 130, 50), 5), "leaves")
    leaves = glb.material("leaves", texture=leaf, mask=0.5, double_sided=True, roughness=0.9)
    bark = glb.material("bark", (0.16, 0.12, 0.08, 1))
    trees = [glb.mesh(f"tree {i}", (trunk(3.2, 20 + i), bark), (crown(2.2, 2.0, 4.3, 420, 30 + i), leaves))
             for i in range(3)]
    nodes = []

    def place(mesh, x, z, lift=0.0, **more):
        nodes.append(glb.node(mesh=mesh, translation=[x, terrain_height(x, z) + lift, z], **more))

    for i in range(24):
        z = 92 - 8 * i
        for side in (-1, 1):
            if i % 2 == 0:
                place(pillar, 4.0 * side, z, -0.1)
            else:
                place(stand, 4.0 * side, z)
                place(ball, 4.0 * side, z, 0.78)
    for i in range(22):
        z = 90 - 8.5 * i
        place(trees[i % 3], 26.0 + rng.uniform(-1, 1), z, -0.1, rotation=turn(50 * i))
        place(trees[(i + 1) % 3], -26.0 + rng.uniform(-1, 1), z, -0.1, rotation=turn(70 * i))
    for i in range(10):
        angle = 2 * math.pi * i / 10
        rock = glb.mesh(f"boulder {i}", (boulder(40 + i), stone))
        place(rock, 15 * math.sin(angle), 15 * math.cos(angle), 0.4)
    return nodes


def city():
    rng = random.Random(2024)
    glb = Glb()
    paving = glb.texture(textures.tiles(128, 4, (170, 160, 148), (96, 90, 84), 3), "paving")
    ground = grid(220, 220, 176, 176, terrain_height).scale_uvs(0.4)
    nodes = [glb.node("ground", mesh=glb.mesh("ground", (ground, glb.material("paving", texture=paving))))]
    nodes += add_houses(glb, rng) + add_street_furniture(glb, rng)
    eye_z = 97.0
    eye = (1.2, terrain_height(1.2, eye_z) + 1.7, eye_z)
    nodes.append(glb.camera_node("camera", glb.perspective(55, 0.1), eye, (-0.6, eye[1] + 1.4, 40.0)))
    nodes.append(glb.camera_node("aerial", glb.perspective(45, 0.5), (95, 75, 130), (0, 0, 0)))
    sun = glb.light("directional", name="sun", color=[1.0, 0.94, 0.85], intensity=3.5)
    nodes.append(glb.node("sun", rotation=look_along(sun_direction(197, 38)), extensions=sun))
    glb.scene(nodes, "city")
    return glb

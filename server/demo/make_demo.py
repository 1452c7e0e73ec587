#!/usr/bin/env python3
"""Writes the bundled demo scene: a sundial plaza in a park, made for a low sun.

usage: make_demo.py OUTPUT.glb
"""

import math
import sys

import architecture
import garden
import textures
from glb import Glb, look_along, sun_direction, turn
from shapes import box

SUN_AZIMUTH, SUN_ELEVATION = 84.0, 26.0


def around(radius, degrees):
    """A point on the ground, clockwise from north."""
    angle = math.radians(degrees)
    return math.sin(angle) * radius, -math.cos(angle) * radius


def add_materials(glb):
    """Name -> index."""
    slabs = glb.texture(textures.tiles(256, 4, (206, 192, 168), (118, 106, 90), 11), "slabs")
    sandstone = glb.texture(textures.mottled(128, (216, 200, 170), 0.14, 21), "sandstone")
    grass = glb.texture(textures.mottled(256, (116, 138, 72), 0.3, 31, cells=16, octaves=4), "grass")
    gravel = glb.texture(textures.mottled(128, (192, 178, 152), 0.15, 41, cells=24, octaves=3), "gravel")
    wood = glb.texture(textures.mottled(128, (150, 108, 70), 0.3, 51, cells=16, octaves=3, stretch=8), "wood")
    bark = glb.texture(textures.mottled(64, (104, 82, 62), 0.45, 61, cells=8, octaves=3, stretch=4), "bark")
    needles = glb.texture(textures.mottled(128, (205, 215, 195), 0.55, 81, cells=32, octaves=3), "needles")
    leaf = glb.texture(textures.leaves(128, 48, (104, 148, 58), 71), "leaves")
    return {
        "slabs": glb.material("slabs", texture=slabs, roughness=0.8),
        "stone": glb.material("sandstone", texture=sandstone, roughness=0.85),
        "dark stone": glb.material("basalt", (0.09, 0.085, 0.08, 1), roughness=0.55),
        "bronze": glb.material("bronze", (0.55, 0.31, 0.14, 1), metallic=0.75, roughness=0.38),
        "grass": glb.material("grass", texture=grass, roughness=1.0),
        "gravel": glb.material("gravel", texture=gravel, roughness=1.0),
        "wood": glb.material("wood", texture=wood, roughness=0.75),
        "bark": glb.material("bark", texture=bark, roughness=0.95),
        "leaves": glb.material("leaves", texture=leaf, roughness=0.8, mask=0.5, double_sided=True),
        "foliage": glb.material("foliage", texture=needles, roughness=1.0),
        "painted": glb.material("painted", roughness=0.6),
    }


def add_plaza(glb, materials):
    """The dial, the blade and what is inlaid."""
    plaza = glb.mesh("dial", (architecture.plaza().scale_uvs(0.5), materials["slabs"]),
                     (architecture.hour_marks(), materials["dark stone"]),
                     (architecture.rings(), materials["dark stone"]))
    blade = glb.mesh("gnomon", (architecture.gnomon(), materials["bronze"]))
    court = glb.mesh("court", (architecture.court().scale_uvs(0.4), materials["gravel"]))
    return [glb.node("court", mesh=court), glb.node("dial", mesh=plaza), glb.node("gnomon", mesh=blade)]


def add_colonnade(glb, materials):
    """Columns around the north of the plaza, under one beam."""
    radius, height, floor = 14.2, 4.9, 0.12
    column = glb.mesh("column", (architecture.column(height, 0.36).scale_uvs(0.6), materials["stone"]))
    beam = glb.mesh("entablature", (architecture.entablature(radius, floor + height, (-97, 97)).scale_uvs(0.6),
                                    materials["stone"]))
    walk = glb.mesh("walk", (architecture.walk(radius, (-101, 101)).scale_uvs(0.5), materials["slabs"]))
    nodes = [glb.node("entablature", mesh=beam), glb.node("walk", mesh=walk)]
    for i in range(17):
        degrees = -92 + 184 * i / 16
        x, z = around(radius, degrees)
        nodes.append(glb.node(f"column {i + 1}", mesh=column, translation=[x, floor, z], rotation=turn(-degrees)))
    return nodes


def add_spheres(glb, materials):
    """Five balls on pedestals south-west of the dial, from dull to mirror-like."""
    pedestal = glb.mesh("pedestal", (architecture.pedestal(), materials["stone"]))
    finishes = (("plaster", (0.80, 0.78, 0.74, 1), 0.0, 0.95), ("glazed red", (0.55, 0.06, 0.04, 1), 0.0, 0.25),
                ("gold", (1.00, 0.72, 0.30, 1), 0.85, 0.32), ("glazed blue", (0.05, 0.14, 0.42, 1), 0.0, 0.45),
                ("steel", (0.62, 0.63, 0.65, 1), 0.8, 0.2))
    shape = architecture.ball()
    nodes = []
    for i, (name, color, metallic, roughness) in enumerate(finishes):
        ball = glb.mesh(name, (shape, glb.material(name, color, metallic, roughness)))
        degrees = 187 + 13 * i
        x, z = around(12.9, degrees)
        top = glb.node(name, mesh=ball, translation=[0.0, 1.44, 0.0])
        nodes.append(glb.node(f"pedestal {i + 1}", mesh=pedestal, translation=[x, 0.0, z], rotation=turn(-degrees),
                              children=[top]))
    return nodes


def add_pergola(glb, materials):
    """East of the plaza, with two benches in it, and boxes painted by vertex colors beside it."""
    pergola = glb.mesh("pergola", (architecture.pergola(9.0, 3.2, 2.7), materials["wood"]))
    bench = glb.mesh("bench", (architecture.bench(), materials["wood"]))
    nodes = [glb.node("pergola", mesh=pergola, translation=[19.5, 0.0, 3.0], children=[
        glb.node("bench north", mesh=bench, translation=[0.6, 0.0, -2.2]),
        glb.node("bench south", mesh=bench, translation=[0.6, 0.0, 2.2])])]
    floor = glb.mesh("pergola floor", (box(4.2, 0.06, 9.4).scale_uvs(0.5), materials["slabs"]))
    nodes.append(glb.node("pergola floor", mesh=floor, translation=[19.5, 0.0, 3.0]))
    colors = ((0.62, 0.16, 0.08), (0.75, 0.5, 0.1), (0.1, 0.3, 0.36))
    for i, color in enumerate(colors):
        planter = box(0.9, 0.7, 0.9).paint(lambda _, y, __, c=color: [v * (0.55 + 0.64 * y) for v in c])
        mesh = glb.mesh(f"planter {i + 1}", (planter, materials["painted"]))
        nodes.append(glb.node(f"planter {i + 1}", mesh=mesh, translation=[16.6, 0.0, -0.4 + 3.0 * i],
                              rotation=turn(12 * i)))
    return nodes


def add_garden(glb, materials):
    """Ground, paths, trees, and an avenue to the north that runs out to where the last cascade lies."""
    ground = glb.mesh("ground", (garden.ground(260, 60).scale_uvs(1 / 9), materials["grass"]))
    paths = glb.mesh("paths", *[(garden.path(3.4, side * 17.8, side * 122, 60).scale_uvs(0.4), materials["gravel"])
                                for side in (-1, 1)])
    nodes = [glb.node("ground", mesh=ground), glb.node("paths", mesh=paths)]
    trees = []
    for i in range(2):
        trees.append(glb.mesh(f"tree {i + 1}", (garden.trunk(3.4 + 0.5 * i, 5 + i), materials["bark"]),
                              (garden.crown(2.6, 2.2, 4.7 + 0.5 * i, 560, 9 + i), materials["leaves"])))
    places = ((-17.5, -2.0, 1.0), (-20.5, 6.5, 1.15), (-29.0, 16.0, 0.9), (26.0, 22.0, 1.05), (23.0, 13.0, 1.2),
              (-25.0, -9.0, 1.25), (26.0, -8.0, 1.1), (-22.5, 20.0, 1.0), (-33.0, 12.0, 1.3), (34.0, -22.0, 1.3))
    for i, (x, z, size) in enumerate(places):
        nodes.append(glb.node(f"tree {i + 1}", mesh=trees[i % 2], translation=[x, garden.ground_height(x, z), z],
                              rotation=turn(67 * i), scale=[size] * 3))
    cypresses = [glb.mesh(f"cypress {i + 1}", (garden.cypress(8.0 + i, 13 + i).scale_uvs(0.5), materials["foliage"]))
                 for i in range(2)]
    for i in range(13):
        for side in (-1, 1):
            x, z = side * 4.6, -24.0 - 7.6 * i
            nodes.append(glb.node(mesh=cypresses[(i + (side > 0)) % 2], rotation=turn(41 * i),
                                  translation=[x, garden.ground_height(x, z), z]))
    return nodes


def add_surroundings(glb, materials):
    """Balustrades, obelisks at the southern path and towers far off."""
    rail = glb.mesh("balustrade", (architecture.balustrade(7.2), materials["stone"]))
    nodes = []
    for degrees in (-146, -118, 118, 146):
        x, z = around(22.5, degrees)
        nodes.append(glb.node("balustrade", mesh=rail, translation=[x, 0.0, z], rotation=turn(-degrees)))
    obelisk = glb.mesh("obelisk", (architecture.obelisk(5.2).scale_uvs(0.5), materials["stone"]))
    for x in (-3.0, 3.0):
        nodes.append(glb.node("obelisk", mesh=obelisk, translation=[x, 0.0, 19.5]))
    tower = glb.mesh("tower", (architecture.tower(15.0, 3.6).scale_uvs(0.25), materials["stone"]))
    for x, z, size in ((-26.0, -98.0, 0.85), (82.0, -60.0, 1.2), (-62.0, -22.0, 0.9)):
        nodes.append(glb.node("tower", mesh=tower, translation=[x, garden.ground_height(x, z) - 0.8, z],
                              scale=[size] * 3))
    return nodes


def add_sun_and_cameras(glb):
    sun = glb.light("directional", name="sun", color=[1.0, 0.9, 0.76], intensity=4.0)
    direction = sun_direction(SUN_AZIMUTH, SUN_ELEVATION)
    return [glb.node("sun", rotation=look_along(direction), extensions=sun),
            glb.camera_node("overview", glb.perspective(40, 0.1, 400), (12.0, 8.0, 19.2), (-1.7, 0.7, -2.2)),
            glb.camera_node("close", glb.perspective(46, 0.05, 400), (5.2, 2.1, 7.4), (-0.9, 1.5, -2.8)),
            glb.camera_node("avenue", glb.perspective(50, 0.1, 400), (1.5, 2.3, -15.5), (-0.4, 2.6, -60.0))]


def make_demo():
    glb = Glb()
    materials = add_materials(glb)
    nodes = []
    for add in (add_plaza, add_colonnade, add_spheres, add_pergola, add_garden, add_surroundings):
        nodes += add(glb, materials)
    nodes += add_sun_and_cameras(glb)
    glb.scene(nodes, "sundial plaza")
    return glb


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    make_demo().write(sys.argv[1])

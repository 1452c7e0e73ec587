"""Small scenes that each hold one difficulty. Every one but `empty` has a camera node called "camera"; only `lights`
has lights of its own.

North is -Z, metres, grounds lie at y = 0.
"""

import math

import textures
from glb import Glb, look_along, png, turn
from shapes import Mesh, box, grid, lathe, sphere

GREY = (0.5, 0.5, 0.5, 1)
SAND = (0.62, 0.55, 0.42, 1)
RED = (0.6, 0.1, 0.08, 1)
GREEN = (0.12, 0.4, 0.1, 1)
BLUE = (0.1, 0.2, 0.6, 1)


class Stage:
    """A GLB with a ground and a camera."""

    def __init__(self, ground_size=20.0, eye=(5, 4, 7), target=(0, 1, 0), fov=45):
        self.glb = Glb()
        self.nodes = []
        if ground_size:
            width, depth = ground_size if isinstance(ground_size, tuple) else (ground_size, ground_size)
            self.add("ground", grid(width, depth, 1, 1), SAND)
        self.nodes.append(self.glb.camera_node("camera", self.glb.perspective(fov, 0.1), eye, target))

    def add(self, name, mesh, color=GREY, material=None, **placement):
        if material is None:
            material = self.glb.material(name, color)
        self.nodes.append(self.glb.node(name, mesh=self.glb.mesh(name, (mesh, material)), **placement))

    def finish(self):
        self.glb.scene(self.nodes)
        return self.glb


def box_on_plane():
    stage = Stage()
    stage.add("box", box(2, 2, 2))
    return stage.finish()


def tilted_planes():
    stage = Stage(eye=(0, 5, 13), target=(0, 2, 0))
    for i, tilt in enumerate((15, 45, 75)):
        half = math.radians(tilt) / 2
        x = 5.0 * (i - 1)
        stage.add(f"plane {tilt}", grid(4, 4, 1, 1), rotation=[math.sin(half), 0.0, 0.0, math.cos(half)],
                  translation=[x, 2.2, 0.0])
        stage.add(f"pole {tilt}", lathe([(0.1, 0), (0.1, 4), (0, 4)], 16), RED, translation=[x + 0.5, 0.0, 3.0])
    return stage.finish()


def mask_leaf():
    stage = Stage(10.0, eye=(4, 5, 6), target=(0, 0.8, 0))
    checker = [(60, 120, 40, 255) if (x // 16 + y // 16) % 2 == 0 else (60, 120, 40, 0)
               for y in range(64) for x in range(64)]
    texture = stage.glb.texture(png(64, 64, 4, [c for pixel in checker for c in pixel]), "leaf")
    card = Mesh()
    card.flat_quad(((-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)), (0, 1, 0), ((0, 1), (1, 1), (1, 0), (0, 0)))
    stage.add("leaf", card, material=stage.glb.material("leaf", texture=texture, mask=0.5, double_sided=True),
              translation=[0.0, 2.0, 0.0])
    return stage.finish()


def blended_pane():
    stage = Stage(10.0, eye=(4, 4, 5), target=(0, 0.8, 0))
    ramp = [(150, 60, 40, min(max(x - 8, 0) * 255 // 47, 255)) for _ in range(64) for x in range(64)]
    texture = stage.glb.texture(png(64, 64, 4, [c for pixel in ramp for c in pixel]), "pane")
    pane = Mesh()
    first, last = 8 / 64, 56 / 64  # away from where the ramp wraps around, in smaller levels, too
    pane.flat_quad(((-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)), (0, 1, 0),
                   ((first, 1), (last, 1), (last, 0), (first, 0)))
    stage.add("pane", pane, material=stage.glb.material("pane", texture=texture, blend=True, double_sided=True),
              translation=[0.0, 2.0, 0.0])
    return stage.finish()


def _ell():
    """An upright L without mirror symmetry, its foot towards +X."""
    return Mesh().append(box(0.6, 2.4, 0.6)).append(box(1.2, 0.6, 0.6), (0.9, 0, 0)).append(
        lathe([(0.2, 0), (0, 0.7)], 24), (1.2, 0.6, 0))


def panes():
    stage = Stage(10.0, eye=(-1.2, 3.8, 5.4), target=(-0.1, 0.6, 0.4))
    pane = box(1.2, 1.6, 0.06)
    for i, alpha in enumerate((0.0, 0.3, 0.7, 1.0)):
        material = stage.glb.material(f"alpha {alpha}", (0.1, 0.3, 0.6, alpha), blend=True)
        stage.add(f"pane {alpha}", pane, material=material, translation=[1.5 * (i - 1.5), 0.3, 0.0])
    return stage.finish()


def mirrored_node():
    stage = Stage(eye=(0, 3.5, 8), target=(0, 1, 0))
    shape = stage.glb.mesh("ell", (_ell(), stage.glb.material("ell", BLUE)))
    stage.nodes.append(stage.glb.node("as modelled", mesh=shape, translation=[0.6, 0.0, 0.0]))
    stage.nodes.append(stage.glb.node("mirrored", mesh=shape, translation=[-0.6, 0.0, 0.0], scale=[-1.0, 1.0, 1.0]))
    return stage.finish()


def caster_behind_camera():
    stage = Stage(80.0, eye=(0, 2, 0), target=(0, 1, -10), fov=60)
    stage.add("wall behind", box(8, 8, 0.5), RED, translation=[0.0, 0.0, 6.0])
    stage.add("box ahead", box(1, 1, 1), translation=[0.0, 0.0, -8.0])
    return stage.finish()


def long_row():
    stage = Stage((40.0, 240.0), eye=(0, 3, 4), target=(0, 2.2, -20), fov=50)
    pillar = stage.glb.mesh("pillar", (Mesh().append(box(1.2, 0.3, 1.2)).append(
        lathe([(0.45, 0.3), (0.38, 4), (0.6, 4.2), (0.6, 4.4), (0, 4.4)], 24)), stage.glb.material("pillar", GREY)))
    for i in range(20):
        for side in (-1, 1):
            stage.nodes.append(stage.glb.node(f"pillar {i} {'east' if side > 0 else 'west'}", mesh=pillar,
                                              translation=[3.0 * side, 0.0, -5.0 - 5.0 * i]))
    return stage.finish()


def thin_slats():
    stage = Stage(12.0, eye=(4, 3, 6), target=(0, 1.2, 0))
    slats = Mesh()
    for i in range(41):
        slats.append(box(0.03, 0.03, 4), ((i - 20) * 0.1, 2.5, 0))
    stage.add("slats", slats, RED)
    return stage.finish()


def vertex_colors():
    stage = Stage(eye=(3, 3, 5), target=(0, 1, 0))
    white = stage.glb.material("white")
    stage.add("coloured box", box(2, 2, 2).paint(lambda x, y, z: ((x + 1) / 2, y / 2, (z + 1) / 2)), material=white)
    return stage.finish()


def double_sided():
    stage = Stage(eye=(0, 2, 7), target=(0, 1, 0))
    card = Mesh()
    card.flat_quad(((-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)), (0, 0, 1), ((0, 1), (1, 1), (1, 0), (0, 0)))
    away = turn(180)
    for x, name, color, both, rotation in ((-3.6, "single, front", RED, False, turn(0)),
                                           (-1.2, "single, back", GREEN, False, away),
                                           (1.2, "double, front", RED, True, turn(0)),
                                           (3.6, "double, back", GREEN, True, away)):
        stage.add(name, card, material=stage.glb.material(name, color, double_sided=both), rotation=rotation,
                  translation=[x, 0.0, 0.0])
    return stage.finish()


def normal_mapped():
    stage = Stage(12.0, eye=(0, 3.5, 5), target=(0, 0.8, 0))
    bumps = stage.glb.texture(textures.bumps(128, 4), "bumps")
    material = stage.glb.material("studs", GREY, roughness=0.5, normal=bumps)
    flat = stage.glb.material("smooth", GREY, roughness=0.5)
    for i, name in enumerate(("with tangents", "without tangents", "no normal map")):
        panel = grid(2, 2, 1, 1).scale_uvs(0.5)
        if i == 0:
            panel.tangents.extend([1.0, 0.0, 0.0, 1.0] * 4)
        stage.add(name, panel, material=flat if i == 2 else material, translation=[2.4 * (i - 1), 0.3, 0.0])
    return stage.finish()


def multi_scene():
    glb = Glb()
    ground = glb.node("ground", mesh=glb.mesh("ground", (grid(20, 20, 1, 1), glb.material("ground", SAND))))
    shape = glb.mesh("box", (box(1, 1, 1), glb.material("box", BLUE)))
    boxes = [glb.node(f"box {i}", mesh=shape, translation=[2.0 * (i - 1), 0.0, 0.0]) for i in range(3)]
    camera = glb.camera_node("camera", glb.perspective(45, 0.1), (4, 3, 6), (0, 0.5, 0))
    glb.scene([ground, boxes[1], camera], "one box")
    glb.scene([ground, *boxes, camera], "three boxes")
    return glb


def cameras():
    stage = Stage(eye=(4, 3, 6), target=(0, 1, 0))
    glb = stage.glb
    stage.add("box", box(1, 2, 1), BLUE)
    stage.nodes.append(glb.camera_node("bounded", glb.perspective(30, 0.5, 50), (-6, 4, 8), (0, 1, 0)))
    stage.nodes.append(glb.camera_node("parallel", glb.orthographic(4, 3, 0.1, 40), (6, 6, 6), (0, 1, 0)))
    inner = glb.node("on a turned arm", camera=glb.perspective(45, 0.1), translation=[0.0, 1.5, 7.0])
    stage.nodes.append(glb.node("arm", rotation=turn(90), children=[inner]))
    return stage.finish()


def lights():
    stage = Stage(eye=(0, 6, 11), target=(0, 0.5, 0))
    glb = stage.glb
    for i in range(3):
        stage.add(f"ball {i}", sphere(0.6, 16, 32), translation=[4.0 * (i - 1), 0.6, 0.0])
    sun = glb.light("directional", name="sun", color=[1.0, 0.9, 0.8], intensity=1.5)
    spot = glb.light("spot", name="spot", color=[0.4, 0.6, 1.0], intensity=60.0, range=20.0,
                     spot={"innerConeAngle": math.radians(15), "outerConeAngle": math.radians(25)})
    point = glb.light("point", name="point", color=[1.0, 0.4, 0.2], intensity=12.0)
    stage.nodes += [glb.node("sun", rotation=look_along((0.5, -1.0, -0.6)), extensions=sun),
                    glb.node("spot", translation=[-4.0, 5.0, 1.0], rotation=look_along((0.0, -1.0, -0.2)),
                             extensions=spot),
                    glb.node("point", translation=[4.0, 2.2, 1.2], extensions=point)]
    return stage.finish()


def empty():
    glb = Glb()
    glb.scene([], "empty")
    return glb

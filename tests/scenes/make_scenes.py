#!/usr/bin/env python3
"""Writes test scenes as NAME.glb, always the same bytes.

usage: make_scenes.py FOLDER NAME...      (README.md says what there is)
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "server", "demo"))

import basic_scenes  # noqa: E402
import city  # noqa: E402
import hard_scenes  # noqa: E402

SCENES = {scene.__name__: scene for scene in (
    basic_scenes.box_on_plane, basic_scenes.tilted_planes, basic_scenes.mask_leaf, basic_scenes.blended_pane, basic_scenes.panes,
    basic_scenes.mirrored_node,
    basic_scenes.caster_behind_camera, basic_scenes.long_row, basic_scenes.thin_slats, basic_scenes.vertex_colors,
    basic_scenes.double_sided, basic_scenes.normal_mapped, basic_scenes.multi_scene, basic_scenes.cameras,
    basic_scenes.lights, basic_scenes.empty, city.city,
    hard_scenes.micro, hard_scenes.giga, hard_scenes.pebble, hard_scenes.ladder, hard_scenes.upstream,
    hard_scenes.faulty_triangles, hard_scenes.odd_nodes, hard_scenes.single_triangle, hard_scenes.triangle_over_plane,
    hard_scenes.coplanar, hard_scenes.leaves, hard_scenes.pinhole, hard_scenes.room_corner, hard_scenes.stack)}


def main(folder, *names):
    os.makedirs(folder, exist_ok=True)
    for name in names:
        if name not in SCENES:
            sys.exit(f"no scene is called {name}; there are: {' '.join(SCENES)}")
        SCENES[name]().write(os.path.join(folder, name + ".glb"))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

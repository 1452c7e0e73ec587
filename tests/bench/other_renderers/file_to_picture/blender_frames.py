"""Draws frames with Blender.

usage: blender --background --factory-startup --python blender_frames.py -- SETUP

SETUP is a file of JSON as scenes.mjs makes it, with `engine`; its `url` is the GLB's path. Once the scene is loaded, it
says {"version"} as one line to file descriptor 3, then answers each line of its input there by one line:
`picture FRAME FILE` by true once that frame is in the file, as PNG.
"""

import json
import math
import os
import sys
from pathlib import Path

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Blender 3.4's importer of glTF still asks for this name.

SAMPLES = 4


def blender_axes(vector):
    """glTF's Y is up, Blender's Z."""
    x, y, z = vector
    return Vector((x, -z, y))


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def load(setup):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=setup["url"])
    for thing in list(bpy.context.scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)


def add_ambient_light(setup):
    """Every surface shines by its share of ambient light, as it does by the other renderers; a lit world would be noise."""
    for material in filter(lambda each: each.use_nodes, bpy.data.materials):
        for node in material.node_tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                color, emission = node.inputs["Base Color"], node.inputs["Emission"]
                emission.default_value = color.default_value
                if color.is_linked:
                    material.node_tree.links.new(color.links[0].from_socket, emission)
                node.inputs["Emission Strength"].default_value = setup["ambient"] * setup["sunIntensity"] / math.pi


def add_sun(setup):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = setup["sunIntensity"]
    sun.angle = 0
    sun.shadow_cascade_count = setup["cascades"]
    sun.shadow_cascade_max_distance = setup["shadowDistance"]
    add("sun", sun).rotation_euler = blender_axes(setup["towardsSun"]).to_track_quat("Z", "Y").to_euler()


def add_camera(setup):
    given = setup["camera"]
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(given["fovYDegrees"])
    camera.clip_start, camera.clip_end = given["near"], given["far"]
    bpy.context.scene.camera = add("camera", camera)


def set_engine(setup):
    scene = bpy.context.scene
    scene.render.engine = setup["engine"]
    scene.render.use_persistent_data = True
    scene.render.resolution_x, scene.render.resolution_y = setup["width"], setup["height"]
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces = SAMPLES, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    eevee = scene.eevee
    eevee.taa_render_samples = SAMPLES
    eevee.shadow_cascade_size = str(setup["mapSize"])
    eevee.use_soft_shadows = False


def picture(setup, frame, file):
    given = setup["camera"]
    eye, target = blender_axes(setup["eyes"][int(frame)]), blender_axes(given["target"])
    scene = bpy.context.scene
    scene.camera.location = eye
    scene.camera.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
    scene.render.filepath = file
    bpy.ops.render.render(write_still=True)
    return True


def main(path):
    setup = json.loads(Path(path).read_text())
    load(setup)
    add_ambient_light(setup)
    add_sun(setup)
    add_camera(setup)
    set_engine(setup)
    with os.fdopen(3, "w") as answers:
        print(json.dumps({"version": bpy.app.version_string}), file=answers, flush=True)
        for line in sys.stdin:
            _, *words = line.rstrip("\n").split(" ", 2)
            print(json.dumps(picture(setup, *words)), file=answers, flush=True)


main(sys.argv[-1])

"""Draws a data set with Blender's Cycles: color, depth and the index of the object that is seen, for every frame.

usage: blender --background --factory-startup --python blender_data_set.py -- FRAMES FOLDER

FRAMES is a file of JSON: `glb`, the scene's path; `width`, `height`; and `frames`, each with `worldFromCamera` (4 x 4,
OpenCV's axes, glTF's world), `focal` in pixels and `towardsSun`. Each frame becomes one OpenEXR file of several layers, as
Blender writes them. The last line of the output is JSON: the seconds of all frames, and their number.
"""

import json
import sys
import time
from pathlib import Path

import bpy
import numpy
from mathutils import Matrix, Vector

numpy.bool = bool  # Blender 3.4's importer of glTF still asks for this name.

SAMPLES = 4
Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
BLENDER_CAMERA = Matrix.Diagonal((1, -1, -1, 1))


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def load(glb):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    for thing in list(bpy.context.scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)
    for index, thing in enumerate(bpy.context.scene.objects):
        thing.pass_index = index + 1


def set_output(width, height):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.cycles.samples, scene.cycles.max_bounces = SAMPLES, 0
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_object_index = True


def draw(frame, width, camera, sun, file):
    camera.matrix_world = Z_UP @ Matrix(frame["worldFromCamera"]) @ BLENDER_CAMERA
    camera.data.lens = frame["focal"] * camera.data.sensor_width / width
    sun.rotation_euler = (Z_UP.to_3x3() @ Vector(frame["towardsSun"])).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.render.filepath = file
    bpy.ops.render.render(write_still=True)


def main(frames, folder):
    given = json.loads(Path(frames).read_text())
    load(given["glb"])
    set_output(given["width"], given["height"])
    camera = add("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "HORIZONTAL"
    camera.data.clip_start, camera.data.clip_end = 0.01, 1e4
    bpy.context.scene.camera = camera
    sun = add("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = 3, 0
    begun = time.monotonic()
    for number, frame in enumerate(given["frames"]):
        draw(frame, given["width"], camera, sun, str(Path(folder) / f"{number:06d}.exr"))
    print(json.dumps({"seconds": time.monotonic() - begun, "frames": len(given["frames"])}), flush=True)


main(*sys.argv[-2:])

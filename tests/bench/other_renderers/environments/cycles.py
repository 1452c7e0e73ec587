"""Draws models in the light of an environment by Blender's Cycles.

usage: blender --background --factory-startup --python cycles.py -- SETUP FILE [SETUP FILE]...

SETUP is a file of JSON, as draw_environments.mjs makes it. Writes FILE.npy: rows from the top, red, green, blue in linear
light, and the share of the pixel that the model covers; and FILE.json: {"version", "times": [milliseconds]}.
"""

import json
import math
import sys
import time
from pathlib import Path

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Blender 3.4's importer of glTF still asks for this name.


def blender_axes(vector):
    """glTF's Y is up, Blender's Z."""
    x, y, z = vector
    return Vector((x, -z, y))


def load(setup):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=setup["modelFile"])
    for thing in list(bpy.context.scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)


def make_lambert(albedo):
    """All surfaces matt, in place of their own materials."""
    matt = bpy.data.materials.new("lambert")
    matt.use_nodes = True
    nodes = matt.node_tree.nodes
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (albedo, albedo, albedo, 1)
    matt.node_tree.links.new(diffuse.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    for thing in bpy.context.scene.objects:
        for slot in thing.material_slots:
            slot.material = matt


def source_of(given):
    """What an input of a node gets: another's output, or a constant."""
    if given.is_linked:
        return given.links[0].from_socket
    return given.default_value if given.type == "VALUE" else tuple(given.default_value)[:3]


def computed(tree, kind, operation, **sources):
    node = tree.nodes.new(kind)
    node.operation = operation
    for name, source in sources.items():
        given = node.inputs[int(name[1:])]
        if isinstance(source, bpy.types.NodeSocket):
            tree.links.new(source, given)
        else:
            given.default_value = source
    return node.outputs[0]


def product(tree, a, b):
    return computed(tree, "ShaderNodeMath", "MULTIPLY", _0=a, _1=b)


def scaled(tree, color, factor):
    return computed(tree, "ShaderNodeVectorMath", "SCALE", _0=color, _3=factor)


def rest_of(tree, share):
    return computed(tree, "ShaderNodeMath", "SUBTRACT", _0=1, _1=share)


def shade_as_gltf(tree):
    """Lambert's diffuse light, less what is mirrored over it, and a lobe that loses no light between microfacets. Blender 3.4
    imports Burley's diffuse light, in full, and a lobe that does. Transmissive materials keep their diffuse light."""
    for shader in [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]:
        shader.distribution = "MULTI_GGX"
        given = shader.inputs
        if given["Transmission"].is_linked or given["Transmission"].default_value > 0:
            continue
        diffuse, fresnel, both = (tree.nodes.new(kind) for kind in (
            "ShaderNodeBsdfDiffuse", "ShaderNodeFresnel", "ShaderNodeAddShader"))
        fresnel.inputs["IOR"].default_value = 1.5
        if given["Normal"].is_linked:
            for node in (diffuse, fresnel):
                tree.links.new(source_of(given["Normal"]), node.inputs["Normal"])
        color, metallic = source_of(given["Base Color"]), source_of(given["Metallic"])
        below = product(tree, rest_of(tree, metallic), rest_of(tree, fresnel.outputs[0]))
        shown = product(tree, below, source_of(given["Alpha"]))
        tree.links.new(scaled(tree, color, shown), diffuse.inputs["Color"])
        tree.links.new(scaled(tree, color, metallic), given["Base Color"])
        for link in list(shader.outputs["BSDF"].links):
            tree.links.new(both.outputs[0], link.to_socket)
        tree.links.new(shader.outputs["BSDF"], both.inputs[0])
        tree.links.new(diffuse.outputs["BSDF"], both.inputs[1])


def light_by(setup):
    """Blender has the middle of the picture towards its +X and goes on towards its -Y, which is glTF's +Z."""
    world = bpy.data.worlds.new("environment")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    place, turn = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeMapping")
    picture = nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(setup["environmentFile"])
    picture.image.colorspace_settings.name = "Linear"
    turn.inputs["Rotation"].default_value[2] = math.radians(setup["rotationDegrees"])
    links.new(place.outputs["Generated"], turn.inputs["Vector"])
    links.new(turn.outputs["Vector"], picture.inputs["Vector"])
    links.new(picture.outputs["Color"], nodes["Background"].inputs["Color"])


def add_camera(setup):
    given = setup["camera"]
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(given["fovYDegrees"])
    camera.clip_start, camera.clip_end = given["near"], given["far"]
    placed = bpy.data.objects.new("camera", camera)
    bpy.context.scene.collection.objects.link(placed)
    eye, target = blender_axes(given["eye"]), blender_axes(given["target"])
    placed.location = eye
    placed.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = placed


def set_engine(setup, file):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = setup["width"], setup["height"]
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = file
    cycles = scene.cycles
    cycles.samples = setup["samples"]
    cycles.seed = setup.get("seed", 0)
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = 0
    cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    cycles.max_bounces = setup["bounces"]
    cycles.transparent_max_bounces = 16


def draw(path, file):
    setup = json.loads(Path(path).read_text())
    load(setup)
    if "lambert" in setup:
        make_lambert(setup["lambert"])
    elif setup.get("materials", "glTF") == "glTF":
        for material in bpy.data.materials:
            if material.use_nodes:
                shade_as_gltf(material.node_tree)
    light_by(setup)
    add_camera(setup)
    set_engine(setup, file + ".exr")
    begin = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    milliseconds = 1000 * (time.perf_counter() - begin)
    drawn = bpy.data.images.load(file + ".exr")
    pixels = numpy.empty(4 * setup["width"] * setup["height"], numpy.float32)
    drawn.pixels.foreach_get(pixels)
    numpy.save(file + ".npy", pixels.reshape(setup["height"], setup["width"], 4)[::-1])
    Path(file + ".json").write_text(json.dumps({"version": bpy.app.version_string, "times": [milliseconds]}))


def main(given):
    for path, file in zip(given[::2], given[1::2]):
        draw(path, file)


main(sys.argv[sys.argv.index("--") + 1:])

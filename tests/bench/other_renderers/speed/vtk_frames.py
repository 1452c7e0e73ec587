#!/usr/bin/env python3
"""Draws frames with VTK, whose one shadow map is kept from frame to frame.

usage: vtk_frames.py SETUP

SETUP is a file of JSON as scenes.mjs makes it; its `url` is the GLB's path. Prints {"version", "window"} as one line once
the scene is loaded, then answers each line of its input by one line: `turn FIRST COUNT` by the milliseconds of these
frames as an array, `first` by true once all pixels of the first frame were read, `picture FRAME FILE` by true once that
frame is in the file, as PNG.
"""

import json
import math
import sys
import time
from pathlib import Path

import vtkmodules.vtkInteractionStyle  # noqa: F401  what the importer's window asks its factory for
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOImport import vtkGLTFImporter
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkRenderPassCollection,
    vtkSequencePass,
    vtkShadowMapPass,
)


def corrections(setup):
    """What VTK 9.1 needs to show these shadows where they belong, as changes to its shaders that cost no time.

    It draws the map with the window's aspect, and reads it with a square's. The map is an exponential one; its constant
    cannot be set, and lets nearly all light through where a scene is much wider than its casters are high. So the map
    gets the depth itself. Ambient light is added, which VTK's PBR takes from an environment's texture alone.
    """
    aspect = setup["width"] / setup["height"]
    ambient = setup["ambient"] * setup["sunIntensity"] / math.pi
    return {
        "shadowCoord.xy/shadowCoord.w": f"(shadowCoord.xy/shadowCoord.w - 0.5) * vec2(1.0 / {aspect}, 1.0) + 0.5",
        "exp(depthC * ldepth)": "ldepth",
        "depthCExpBlured * depthCExpActual": "(ldepth - 0.001 > depthCExpBlured ? 0.0 : 1.0)",
        "color += Lo;": f"color += Lo + {ambient} * albedo;",
    }


def shadow_passes(map_size):
    """The map, drawn when a light or an actor changed, and then the picture with it."""
    shadows = vtkShadowMapPass()
    shadows.GetShadowMapBakerPass().SetResolution(map_size)
    both = vtkRenderPassCollection()
    both.AddItem(shadows.GetShadowMapBakerPass())
    both.AddItem(shadows)
    sequence = vtkSequencePass()
    sequence.SetPasses(both)
    camera = vtkCameraPass()
    camera.SetDelegatePass(sequence)
    return camera


class Frames:
    def __init__(self, setup):
        self.setup = setup
        self.size = setup["width"], setup["height"]
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(4 if setup["antialias"] else 0)
        self.window.SetSize(*self.size)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*setup["background"])
        self.window.AddRenderer(self.renderer)
        self.load()
        self.light()
        self.renderer.SetPass(shadow_passes(setup["mapSize"]))
        self.pixels = vtkUnsignedCharArray()

    def load(self):
        importer = vtkGLTFImporter()
        importer.SetFileName(self.setup["url"])
        importer.SetRenderWindow(self.window)
        importer.Update()
        for actor in self.renderer.GetActors():
            for original, replacement in corrections(self.setup).items():
                actor.GetShaderProperty().AddFragmentShaderReplacement(original, False, replacement, True)

    def light(self):
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.PositionalOff()
        light.SetPosition(*self.setup["towardsSun"])
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(self.setup["sunIntensity"])
        self.renderer.RemoveAllLights()
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(light)

    def draw(self, frame):
        given = self.setup["camera"]
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(*self.setup["eyes"][frame])
        camera.SetFocalPoint(*given["target"])
        camera.SetViewUp(*given["up"])
        camera.SetViewAngle(given["fovYDegrees"])
        camera.SetClippingRange(given["near"], given["far"])
        self.window.Render()

    def read(self, width, height):
        self.window.GetPixelData(0, 0, width - 1, height - 1, 0, self.pixels, 0)

    def timed(self, frame):
        begin = time.perf_counter()
        self.draw(frame)
        self.read(1, 1)
        return 1e3 * (time.perf_counter() - begin)

    def picture(self, frame, file):
        self.draw(int(frame))
        shot = vtkWindowToImageFilter()
        shot.SetInput(self.window)
        shot.ReadFrontBufferOff()
        shot.ShouldRerenderOff()
        writer = vtkPNGWriter()
        writer.SetFileName(file)
        writer.SetInputConnection(shot.GetOutputPort())
        writer.Write()
        return True

    def first(self):
        self.draw(0)
        self.read(*self.size)
        return True

    def answer(self, command, *words):
        if command == "turn":
            first, count = map(int, words)
            return [self.timed(frame) for frame in range(first, first + count)]
        return {"first": self.first, "picture": self.picture}[command](*words)


def main(setup):
    frames = Frames(json.loads(Path(setup).read_text()))
    about = {"version": vtkVersion.GetVTKVersion(), "window": frames.window.GetClassName()}
    print(json.dumps(about), flush=True)
    for line in sys.stdin:
        print(json.dumps(frames.answer(*line.rstrip("\n").split(" ", 2))), flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])

"""What is asked of a server: every field may be left out, and `None` leaves it out.

Names are those of the JSON; a plain dict with the same names does as well as any of these classes.
"""

# Written by generate.py from /openapi.json; change the server's rows and run it again.
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

Json = Mapping[str, Any]
Vector = Union[Sequence[float], npt.NDArray[np.generic]]
Matrix = Union[Sequence[Sequence[float]], npt.NDArray[np.generic]]


@dataclass
class Orbit:
    """A position on a sphere around a target.

    target:
        Centre of the sphere, at which the camera looks; absent = the centre of the scene, or without `distance` the
        point that brings what is seen into the middle of the picture. Unit: metres.
    azimuthDegrees:
        Direction from the target to the eye, clockwise from north (-Z) as seen from above. The default looks from
        the south-southwest, so that two sides of a building show. Unit: degrees. Default: 210.0.
    elevationDegrees:
        Height of the eye above the target's horizon. Unit: degrees. Default: 20.0.
    distance:
        Distance from the eye to the target; absent = as near as shows all that is seen, with a margin. Unit:
        metres.
    """

    target: Optional[Vector] = None
    azimuthDegrees: Optional[float] = None
    elevationDegrees: Optional[float] = None
    distance: Optional[float] = None


@dataclass
class CameraPose:
    """Position and rotation of a camera, as a matrix.

    worldFromCamera:
        The matrix, row by row, that takes points of the camera's space into the world: a rotation without mirroring
        or scale, a translation, and 0 0 0 1 as the last row. Unit: metres. Default: [[1.0, 0.0, 0.0, 0.0], [0.0,
        1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]].
    axes:
        Which way the camera's axes point. opengl = x right, y up, the camera looks along -z: OpenGL, glTF, Blender;
        opencv = x right, y down, the camera looks along z: OpenCV, ROS, COLMAP. Default: "opengl".
    """

    worldFromCamera: Optional[Matrix] = None
    axes: Optional[Literal["opengl", "opencv"]] = None


@dataclass
class Perspective:
    """A lens with perspective.

    fovYDegrees:
        Full vertical angle of view. Unit: degrees. Default: 45.0.
    near:
        Nearest depth that is drawn; absent = half a millimetre, less where the scene is small. Unit: metres.
    far:
        Farthest depth that is drawn, more than `near`; absent = no limit. Unit: metres.
    """

    fovYDegrees: Optional[float] = None
    near: Optional[float] = None
    far: Optional[float] = None


@dataclass
class Intrinsics:
    """A lens with perspective as calibration gives it. The centre of the upper left pixel is 0 0, as in OpenCV: the
    middle of the picture is at (width - 1) / 2, (height - 1) / 2.

    fx:
        Focal length across. Unit: pixels. Default: 1000.0.
    fy:
        Focal length downwards. Unit: pixels. Default: 1000.0.
    cx:
        Principal point, from the left; absent = the middle. Unit: pixels.
    cy:
        Principal point, from the top; absent = the middle. Unit: pixels.
    near:
        Nearest depth that is drawn; absent = half a millimetre, less where the scene is small. Unit: metres.
    far:
        Farthest depth that is drawn, more than `near`; absent = no limit. Unit: metres.
    """

    fx: Optional[float] = None
    fy: Optional[float] = None
    cx: Optional[float] = None
    cy: Optional[float] = None
    near: Optional[float] = None
    far: Optional[float] = None


@dataclass
class Orthographic:
    """A lens without perspective.

    height:
        Distance from the lower to the upper edge of the picture. Unit: metres. Default: 10.0.
    near:
        Nearest depth that is drawn; negative = behind the eye. Unit: metres. Default: 0.0.
    far:
        Farthest depth that is drawn, more than `near`. Unit: metres. Default: 1000.0.
    """

    height: Optional[float] = None
    near: Optional[float] = None
    far: Optional[float] = None


@dataclass
class Camera:
    """At most one placement and at most one lens; without a placement, an orbit that shows the whole scene.

    eye:
        Position of the camera; 0 0 5 if only `target` or `up` is given. Unit: metres.
    target:
        The point that the camera looks at, different from `eye`; 0 0 0 if only `eye` or `up` is given. Unit:
        metres.
    up:
        A direction that points upwards in the picture, not parallel to the direction of view; absent = 0 1 0.
    orbit:
        Placement on a sphere around a target.
    node:
        Placement and lens of a camera in the scene, by its name; where none has this one, by its index among the
        scene's cameras, from 0; or by node: and its node's index, as node:4.
    fit:
        True = show the whole scene from the default direction; false is not accepted.
    pose:
        Placement by a matrix.
    perspective:
        A lens with perspective; absent = the lens of the camera node, or 45 degrees.
    intrinsics:
        A lens with perspective by focal lengths and principal point, instead of `perspective`.
    orthographic:
        A lens without perspective, instead of one with perspective.
    """

    eye: Optional[Vector] = None
    target: Optional[Vector] = None
    up: Optional[Vector] = None
    orbit: Optional[Union["Orbit", Json]] = None
    node: Optional[Union[int, str]] = None
    fit: Optional[bool] = None
    pose: Optional[Union["CameraPose", Json]] = None
    perspective: Optional[Union["Perspective", Json]] = None
    intrinsics: Optional[Union["Intrinsics", Json]] = None
    orthographic: Optional[Union["Orthographic", Json]] = None


@dataclass
class Sun:
    """A direction given by the sun's place in the sky: by azimuth and elevation, or by a place on Earth and a time,
    from which these follow. The effective spec has azimuth and elevation.

    azimuthDegrees:
        Direction of the sun, clockwise from north (-Z) as seen from above; east (+X) is 90; absent = 135. Unit:
        degrees.
    elevationDegrees:
        Height of the sun above the horizon; negative = below it; absent = 45. Unit: degrees.
    latitudeDegrees:
        Latitude of the place, north of the equator positive; with `longitudeDegrees` and `time`, instead of azimuth
        and elevation. Unit: degrees.
    longitudeDegrees:
        Longitude of the place, east of Greenwich positive. Unit: degrees.
    time:
        Date and time with a zone, as RFC 3339 has it, in the years 1900 to 2100: 2026-06-21T17:00:00+02:00, or Z
        for UTC; seconds may be left out, leap seconds are refused. The sun is where it is seen at sea level:
        refraction by the air raises it. While it is below the horizon its light has intensity 0. In quotes where a
        query or a flag takes JSON.
    northDegrees:
        Where true north lies in the scene, clockwise from -Z as seen from above; with a place and a time; absent =
        0. Unit: degrees.
    """

    azimuthDegrees: Optional[float] = None
    elevationDegrees: Optional[float] = None
    latitudeDegrees: Optional[float] = None
    longitudeDegrees: Optional[float] = None
    time: Optional[str] = None
    northDegrees: Optional[float] = None


@dataclass
class Partition:
    """How the depth range is cut into cascades.

    mode:
        How split distances are chosen. manual = at the distances of `splits`; uniform = into equal lengths;
        logarithmic = into equal ratios, mixed with equal lengths by `pssmFactor`. Default: "logarithmic".
    pssmFactor:
        In mode logarithmic: 0 = purely logarithmic, which gives the foreground the most texels; 1 = uniform. The
        default is half of each, the usual compromise. Default: 0.5.
    splits:
        In mode manual: far ends of the cascades as fractions of the depth range, one for each cascade, increasing.
    """

    mode: Optional[Literal["manual", "uniform", "logarithmic"]] = None
    pssmFactor: Optional[float] = None
    splits: Optional[Vector] = None


@dataclass
class PreviousRange:
    """A range that an earlier frame's report gave.

    near:
        View depth where the range begins. Unit: metres. Default: 0.0.
    far:
        View depth where the range ends, more than `near`. Unit: metres. Default: 0.0.
    """

    near: Optional[float] = None
    far: Optional[float] = None


@dataclass
class DepthRange:
    """The depths that the cascades cover.

    mode:
        Whether the range is computed or given. Computed is tightest, so shadows are sharpest. automatic = from the
        nearest to the farthest surface in this frame; manual = from `min` to `max`. Default: "automatic".
    min:
        In mode manual: where shadows begin, measured from the camera's near plane. Unit: metres.
    max:
        In mode manual: where shadows end, measured from the camera's near plane, more than `min`. Farther = coarser
        texels. Unit: metres.
    previous:
        In mode automatic, for sequences: this light's `depthRange` from the report of the previous frame. It is
        kept, extended by `guardDistance` at both ends, as long as it covers what is in view; this keeps shadows
        from crawling.
    guardDistance:
        Added to both ends of `previous`; absent = 1. Larger = the range changes less often and texels are coarser.
        Unit: metres.
    """

    mode: Optional[Literal["automatic", "manual"]] = None
    min: Optional[float] = None
    max: Optional[float] = None
    previous: Optional[Union["PreviousRange", Json]] = None
    guardDistance: Optional[float] = None


@dataclass
class Filter:
    """How the shadow map is sampled.

    type:
        How the texels of the map are combined. `hard` is fastest; `pcf` costs time when shading, and `pcss` more:
        32 texels searched and 32 comparisons where a caster is near; the others blur every tile first. hard = one
        sample, a sharp edge; pcf = percentage-closer filtering over `size` x `size` texels, or over a disc; vsm =
        variance shadow map, blurred; evsm = exponential variance shadow map, blurred: leaks less light; msm =
        moment shadow map of four moments, blurred: leaks less light; pcss = percentage-closer soft shadows: sharp
        at the caster's foot, the softer the farther the caster, from the light's `angularDiameterDegrees` or
        `radius`. Default: "pcf".
    size:
        Width of the kernel. Wider is softer and slower, and darkens concave corners farther out. Ignored by `hard`,
        `pcss` and when `radius` is set. Unit: texels. Default: 5.
    radius:
        Radius of the kernel in the world, instead of `size`: the same softness in every cascade. Larger is slower;
        refused with `hard`, and with `pcss`, which takes the light's own size. Unit: metres.
    """

    type: Optional[Literal["hard", "pcf", "vsm", "evsm", "msm", "pcss"]] = None
    size: Optional[Literal[3, 5, 7]] = None
    radius: Optional[float] = None


@dataclass
class Bias:
    """How far a surface is moved before it is compared with the map, so that it does not shadow itself.

    mode:
        Whether the bias is computed or given. automatic = from the texels' size, the filter and the slope: nothing
        to tune; manual = by `depth`, `slope` and `normalOffsetScale`. Default: "automatic".
    depth:
        In mode manual: distance towards the light; absent = 0. Larger removes acne, and detaches shadows from their
        casters. Unit: metres.
    slope:
        In mode manual: distance towards the light, multiplied by the tangent of the angle between normal and light;
        absent = 0. Unit: metres.
    normalOffsetScale:
        In mode manual: distance along the surface's normal, as a multiple of `depth`; absent = 0.
    """

    mode: Optional[Literal["automatic", "manual"]] = None
    depth: Optional[float] = None
    slope: Optional[float] = None
    normalOffsetScale: Optional[float] = None


@dataclass
class LightMapOptions:
    """The texture that technique lightMap keeps a light's shadow in.

    size:
        Longer side of the texture at most; the scene's surfaces are shown as finely as fits. Doubling it halves the
        blur of edges, and takes four times the memory and the time to bake. Ignored when `texelsPerMetre` is set.
        Unit: texels. Default: 1024.
    texelsPerMetre:
        How finely surfaces are shown, instead of `size`: the texture is as large as that takes.
    samples:
        Rays for each texel towards a light that has a size. Noise falls with the square root of the number, the
        time to bake grows with it; frames cost the same. Lights without a size take sixteen. Unit: rays. Default:
        64.
    """

    size: Optional[int] = None
    texelsPerMetre: Optional[float] = None
    samples: Optional[int] = None


@dataclass
class Shadow:
    """The shadow of a light.

    enabled:
        False = the light casts no shadow, and takes no place in the atlas. Default: true.
    technique:
        How the shadow is found. Size, cascades, filter, stabilization and bias affect shadow maps only; with auto,
        a light that sets a filter or a bias gets a map. The report says what auto chose, and why. auto = for each
        light rayTraced where that is estimated to cost at most twice its map, else shadowMap; shadowMap = depths
        seen from the light, filtered: fast, and as exact as its texels are fine; shadowVolume = stencilled shadow
        volumes: exact and sharp, drawn by the device `gl` alone; rayTraced = rays for every pixel: exact, and soft
        where the light has a size; lightMap = rays for every texel of the scene's surfaces, once, and a lookup in
        each frame: soft where the light has a size, for static scenes. Default: "auto".
    strength:
        0 = no shadow, 1 = no direct light in shadow. Default: 1.0.
    color:
        Linear red, green and blue: the share of its direct light that a full shadow leaves on a surface, whatever
        technique finds it. View `shadow` does not show it. Default: [0.0, 0.0, 0.0].
    size:
        Side of one shadow tile (a cascade, or a face of a spot or point light), in steps of two. Each step up
        halves the size of a texel, so shadows are sharper, and takes four times the space and fill time. Absent =
        Large for directional lights, Medium for spots, Small for point lights, which have up to six tiles. XSmall =
        an eighth of atlas.baseSize; Small = a quarter of atlas.baseSize; Medium = half of atlas.baseSize; Large =
        atlas.baseSize; XLarge = twice atlas.baseSize.
    importance:
        Each step below high halves the tile's side. Tiles of less important lights are also the first to shrink
        when the atlas is full. low = a quarter of the tile's side; medium = half of the tile's side; high = the
        full side. Default: "high".
    cascadeCount:
        Directional lights: number of slices of the view, each with a tile of its own. More keep the foreground
        sharp and cost a tile each; 4 suit views to the horizon, 1 suits a single object. Unit: cascades. Default:
        4.
    partition:
        How the depth range is split into cascades.
    depthRange:
        The depths that the cascades cover.
    stabilization:
        Keeps shadow edges from crawling when the camera moves, at the price of larger texels. Off by default, as a
        single picture does not need it. none = the tightest fit; sharpest for single pictures; projectionSnapping =
        tiles fitted to a sphere and moved by whole texels; viewSnapping = tiles fitted to a sphere whose centre
        lies on a grid in the world. Default: "none".
    blendCascades:
        True = each cascade fades into the next over its last 20 %, which hides the seam and costs a second lookup
        there. Default: true.
    filter:
        How the shadow map is filtered.
    bias:
        How surfaces are kept from shadowing themselves.
    blendedCasters:
        How materials of alphaMode BLEND, and transmissive ones, cast shadows. dither = by a 4 x 4 pattern that
        blocks as much light as their alpha says; threshold = where their alpha is at least a half. Default:
        "dither".
    terminator:
        Where the triangles of a curved surface turn away from the light: what a shadow is found for there.
        Techniques shadowVolume and lightMap always take the triangles. smooth = the curved surface that the normals
        of vertices show; flat = the triangles, which end the light along their edges. Default: "smooth".
    lightMap:
        Technique lightMap: how finely the shadow is baked into a texture of the scene's surfaces.
    raySamples:
        Technique rayTraced: most rays for each pixel towards a light that has a size. Only penumbras take so many;
        where a pixel and its neighbours agree, one ray does, or 4 beside materials with alpha. Lights without a
        size take one ray. Unit: rays. Default: 16.
    """

    enabled: Optional[bool] = None
    technique: Optional[Literal["auto", "shadowMap", "shadowVolume", "rayTraced", "lightMap"]] = None
    strength: Optional[float] = None
    color: Optional[Vector] = None
    size: Optional[Literal["XSmall", "Small", "Medium", "Large", "XLarge"]] = None
    importance: Optional[Literal["low", "medium", "high"]] = None
    cascadeCount: Optional[int] = None
    partition: Optional[Union["Partition", Json]] = None
    depthRange: Optional[Union["DepthRange", Json]] = None
    stabilization: Optional[Literal["none", "projectionSnapping", "viewSnapping"]] = None
    blendCascades: Optional[bool] = None
    filter: Optional[Union["Filter", Json]] = None
    bias: Optional[Union["Bias", Json]] = None
    blendedCasters: Optional[Literal["dither", "threshold"]] = None
    terminator: Optional[Literal["smooth", "flat"]] = None
    lightMap: Optional[Union["LightMapOptions", Json]] = None
    raySamples: Optional[int] = None


@dataclass
class Light:
    """A light; a directional one needs `direction` or `sun`.

    type:
        Where the light comes from. directional = parallel light from far away, like the sun; spot = from a point,
        within a cone; point = from a point, in all directions. Default: "directional".
    direction:
        Direction in which the light travels, of any length but zero; directional and spot lights.
    sun:
        The sun's place in the sky, instead of `direction`; directional lights only.
    position:
        Position of the light; required for spot and point lights, refused for directional ones. Unit: metres.
    range:
        Distance beyond which the light has no effect; spot and point lights; absent = no limit. A short range lets
        more lights be culled. Unit: metres.
    innerConeDegrees:
        Half angle of the cone within which a spot has its full intensity, less than `outerConeDegrees`. Unit:
        degrees. Default: 0.0.
    outerConeDegrees:
        Half angle of the cone beyond which a spot gives no light. Up to 60 a spot takes one shadow tile, beyond it
        up to five. Unit: degrees. Default: 45.0.
    angularDiameterDegrees:
        Angle that the light's disc spans in the sky, 0.53 for the real sun; directional lights only; absent = 0.
        Techniques rayTraced and lightMap, filter pcss and the exact reference draw a soft shadow for it; all other
        techniques ignore it and draw a hard edge. Unit: degrees.
    radius:
        Radius of the glowing ball; spot and point lights; absent = 0. Techniques rayTraced and lightMap, filter
        pcss and the exact reference draw a soft shadow for it; all other techniques ignore it and draw a hard edge.
        Unit: metres.
    color:
        Linear red, green and blue; absent = white, or the color of `temperatureKelvin`.
    temperatureKelvin:
        Color of a glowing black body of this temperature, instead of `color`; 6500 is daylight. Unit: kelvin.
    intensity:
        Brightness: lux for directional lights, candela for spot and point lights. Unit: lux or candela. Default:
        3.0.
    cullingMask:
        Bit mask of layers: the light reaches only nodes of these layers, and only they cast its shadow. Default:
        65535.
    shadow:
        The light's own shadow options, replacing the frame's `shadow` as a whole; absent = the frame's `shadow`.
    """

    type: Optional[Literal["directional", "spot", "point"]] = None
    direction: Optional[Vector] = None
    sun: Optional[Union["Sun", Json]] = None
    position: Optional[Vector] = None
    range: Optional[float] = None
    innerConeDegrees: Optional[float] = None
    outerConeDegrees: Optional[float] = None
    angularDiameterDegrees: Optional[float] = None
    radius: Optional[float] = None
    color: Optional[Vector] = None
    temperatureKelvin: Optional[float] = None
    intensity: Optional[float] = None
    cullingMask: Optional[int] = None
    shadow: Optional[Union["Shadow", Json]] = None


@dataclass
class Atlas:
    """The one depth texture that holds every tile.

    size:
        Largest side of the atlas; it takes no more than its tiles need. A smaller limit saves memory and shrinks
        tiles when it is full. The device may allow less. Unit: texels. Default: 4096.
    baseSize:
        Side of a tile of size Large, at most `size`. Doubling it halves the size of every shadow texel, at four
        times the memory and fill time. Unit: texels. Default: 1024.
    samples:
        Depths in each texel, each compared by itself. 4 smooths edges within a texel at four times the memory; the
        device must support it. Default: 1.
    """

    size: Optional[Literal[128, 256, 512, 1024, 2048, 4096, 8192]] = None
    baseSize: Optional[Literal[128, 256, 512, 1024, 2048, 4096, 8192]] = None
    samples: Optional[Literal[1, 4]] = None


@dataclass
class NodeOptions:
    """Switches of a node and everything below it, where an entry for a node further down takes precedence; and the
    place of the node itself, which what is below it follows.

    node:
        The node's index, or its name (all nodes of that name); required.
    visible:
        False = the camera does not see it; absent = true.
    castShadow:
        Whether it casts shadows, visible or not; absent = the value of `visible`.
    receiveShadow:
        False = no shadow falls on it; absent = true.
    layers:
        Bit mask of its layers, matched with the lights' `cullingMask`; absent = 1, the first layer.
    matrix:
        Its transform in the space of its parent, instead of that of the file or an animation: an affine matrix,
        column by column, as in glTF.
    translation:
        Its place in the space of its parent; absent = as the file or the animation has it, 0 0 0 for a node with a
        matrix there. Unit: metres.
    rotation:
        Its rotation, a quaternion x y z w of any length but zero; absent = as the file or the animation has it,
        none for a node with a matrix there.
    scale:
        Its scale along its own axes; absent = as the file or the animation has it, 1 1 1 for a node with a matrix
        there.
    """

    node: Optional[Union[int, str]] = None
    visible: Optional[bool] = None
    castShadow: Optional[bool] = None
    receiveShadow: Optional[bool] = None
    layers: Optional[int] = None
    matrix: Optional[Vector] = None
    translation: Optional[Vector] = None
    rotation: Optional[Vector] = None
    scale: Optional[Vector] = None


@dataclass
class VolumeBox:
    """A box along the world's axes.

    min:
        Its lowest corner. Unit: metres. Default: [0.0, 0.0, 0.0].
    max:
        Its highest corner, more than `min` along each axis. Unit: metres. Default: [1.0, 1.0, 1.0].
    """

    min: Optional[Vector] = None
    max: Optional[Vector] = None


@dataclass
class TransferStop:
    """Color and extinction of a value of the grid.

    value:
        A value of the grid, more than that of the entry before. Default: 0.0.
    color:
        Linear red, green and blue that is scattered of the light that is taken away; 1 1 1 for a cloud, 0 0 0 for
        soot. Default: [1.0, 1.0, 1.0].
    extinction:
        Light that is taken away on a metre: exp(-extinction) is let through. Unit: per metre. Default: 0.0.
    """

    value: Optional[float] = None
    color: Optional[Vector] = None
    extinction: Optional[float] = None


@dataclass
class VolumeOptions:
    """A cloud, smoke or fog: numbers on a grid, which `node`, `box` or `matrix` places in the scene.

    file:
        Name of a file of the upload: .npy (an array `[z, y, x]` of float32, float16 or uint8) or .vdb (OpenVDB);
        required.
    grid:
        Name of a float grid of a .vdb; absent = the only one.
    node:
        A node of the scene that the volume is attached to and moves with, by its index or name: `box` or `matrix`
        is in its space, without both the grid fills the cube from 0 to 1 there. It is seen, casts and receives as
        the node does, whose layers do not matter.
    box:
        The box that the grid fills.
    matrix:
        Instead of `box`: the affine matrix, column by column, that takes the unit cube which the grid fills into
        the world, in metres, or into the space of `node`.
    transferFunction:
        What values of the grid mean, in ascending order: linear between two entries, and beyond the first and last
        as these say; required.
    castShadow:
        False = it dims the light of no surface and no volume, itself included. Default: true.
    receiveShadow:
        False = no surface and no volume shades it. Default: true.
    """

    file: Optional[str] = None
    grid: Optional[str] = None
    node: Optional[Union[int, str]] = None
    box: Optional[Union["VolumeBox", Json]] = None
    matrix: Optional[Vector] = None
    transferFunction: Optional[Sequence[Union["TransferStop", Json]]] = None
    castShadow: Optional[bool] = None
    receiveShadow: Optional[bool] = None


@dataclass
class AnimationMoment:
    """A moment of one of the file's animations, by index or name.

    index:
        Index of the animation.
    name:
        Name of the animation; the first of that name.
    timeSeconds:
        Time within the animation. Before the first and after the last keyframe its values stay as they are there.
        Unit: seconds. Default: 0.0.
    """

    index: Optional[int] = None
    name: Optional[str] = None
    timeSeconds: Optional[float] = None


@dataclass
class Ambient:
    """Light of the surroundings: a neutral studio, brighter above than at the sides and below.

    color:
        Linear red, green and blue. Default: [1.0, 1.0, 1.0].
    intensity:
        Brightness of the surroundings from above, in the same unit as the lights; the default is a fifth of a
        light's default intensity. Default: 0.6.
    """

    color: Optional[Vector] = None
    intensity: Optional[float] = None


@dataclass
class Sky:
    """A clear sky and its sun, computed from the sun's place.

    turbidity:
        Haze of the air: 2 is a clear day in the mountains, 3 a clear day, 10 a hazy one. Default: 3.0.
    albedo:
        Linear red, green and blue share of light that the land all around reflects into the sky. Default: [0.2,
        0.2, 0.2].
    sun:
        The sun's place in the sky. It becomes a directional light.
    """

    turbidity: Optional[float] = None
    albedo: Optional[Vector] = None
    sun: Optional[Union["Sun", Json]] = None


@dataclass
class EnvironmentOptions:
    """Light from all around: a picture of all directions, a computed sky, or the studio of `ambient`. Without `file`,
    `sky`, `light` and `studio`: what the glTF gives its scene, else the studio with lamps.

    file:
        Name of a file of the upload: .hdr (Radiance) or .exr, twice as wide as high, linear radiance by longitude
        and latitude.
    sky:
        A computed sky instead of a file.
    light:
        Index of an image-based light of the glTF (EXT_lights_image_based); absent = that of the frame's scene,
        unless `file`, `sky` or `studio` is there.
    studio:
        The neutral studio that lights the scene where there is no file, sky or light; `ambient` is its brightness
        and its color. Absent = lamps. lamps = a dim room with a lamp overhead and three around the scene; even =
        the same all around, brighter above than at the sides and below.
    rotationDegrees:
        Turns the environment about the vertical axis, clockwise as seen from above. At 0 the middle of a file's
        picture lies towards +X and its right half towards +Z, and a light lies as the glTF turns it. Unit: degrees.
        Default: 0.0.
    intensity:
        Its light is multiplied by this, beside the glTF's own factor of a light; absent = 1, and 3e-5 for a sky, so
        that the sun at noon is as bright as a light's default intensity.
    background:
        What is shown where there is no surface. none = `background`, as without an environment; environment = the
        environment, exposed and tone mapped as the scene is; blurred = the environment out of focus. Default:
        "none".
    shadows:
        Whether the scene hides a part of its light. Rays take about as long as a few soft shadows. none = all of
        its light arrives everywhere, but for occlusion textures; rays = rays find what the scene hides of it.
        Default: "none".
    samples:
        Rays a pixel that look for what is hidden; more are sent where they disagree. Four times as many halve the
        noise and take four times as long. Default: 4.
    extractSun:
        What becomes of the brightest disc of a file or a light, or of the sun of a sky. auto = a bright disc
        becomes a directional light with its color, size and shadow; none = it stays in the picture; removed = it is
        taken out, and no light is added: what a report's `spec` says whose `lights` has it. Default: "auto".
    """

    file: Optional[str] = None
    sky: Optional[Union["Sky", Json]] = None
    light: Optional[int] = None
    studio: Optional[Literal["lamps", "even"]] = None
    rotationDegrees: Optional[float] = None
    intensity: Optional[float] = None
    background: Optional[Literal["none", "environment", "blurred"]] = None
    shadows: Optional[Literal["none", "rays"]] = None
    samples: Optional[int] = None
    extractSun: Optional[Literal["auto", "none", "removed"]] = None


@dataclass
class Ground:
    """A horizontal plane under the scene, seen from above alone.

    height:
        Its height; absent = a hair below the lowest point that is seen, as posed. Unit: metres.
    mode:
        What is seen of it. catcher = invisible but for the shadows on it; surface = a surface of `color` and
        `roughness`. Default: "catcher".
    color:
        Linear red, green and blue. In mode catcher view color doesn't show it, other views do. Default: [0.5, 0.5,
        0.5].
    roughness:
        0 = a mirror, 1 = matt. In mode catcher view color doesn't show it, other views do. Default: 1.0.
    size:
        Length of its sides; absent = ten times the scene's largest side, of a catcher less where no shadow can fall
        farther out. Unit: metres.
    """

    height: Optional[float] = None
    mode: Optional[Literal["catcher", "surface"]] = None
    color: Optional[Vector] = None
    roughness: Optional[float] = None
    size: Optional[float] = None


@dataclass
class Background:
    """What is shown where there is no surface; neither exposed nor tone mapped.

    color:
        Linear red, green and blue. Default: [0.6, 0.66, 0.74].
    alpha:
        0 = transparent, 1 = opaque. Default: 1.0.
    """

    color: Optional[Vector] = None
    alpha: Optional[float] = None


@dataclass
class MotionFrom:
    """What the view `motion` compares with; what is absent is as in the frame itself.

    camera:
        The camera then.
    animation:
        The animation and its time then.
    nodes:
        Places of nodes then, instead of the frame's `nodes`: of each entry only `matrix`, `translation`, `rotation`
        and `scale`.
    """

    camera: Optional[Union["Camera", Json]] = None
    animation: Optional[Union["AnimationMoment", Json]] = None
    nodes: Optional[Sequence[Union["NodeOptions", Json]]] = None


@dataclass
class SunHours:
    """What the view `sunHours` adds up: each step counts where the sun shines in its middle, from its centre. Of two
    days that are 24 hours apart the second begins at the time of day of `begin`.

    latitudeDegrees:
        Latitude of the place, north of the equator positive; required. Unit: degrees.
    longitudeDegrees:
        Longitude of the place, east of Greenwich positive; required. Unit: degrees.
    northDegrees:
        Where true north lies in the scene, clockwise from -Z as seen from above; absent = 0. Unit: degrees.
    begin:
        Date and time with a zone at which the hours begin, as a sun's `time`; required.
    end:
        Date and time with a zone at which they end, later than `begin`; required. At most 10000 steps lie between
        them, day and night.
    stepMinutes:
        Length of a step. Rays of a frame grow with the number of steps by day. Unit: minutes. Default: 10.0.
    stepDays:
        Each day that is looked at stands for so many, itself and the ones after it: 7 looks at one day of each
        week. More than 1 needs whole days from `begin` to `end`. Unit: days. Default: 1.
    """

    latitudeDegrees: Optional[float] = None
    longitudeDegrees: Optional[float] = None
    northDegrees: Optional[float] = None
    begin: Optional[str] = None
    end: Optional[str] = None
    stepMinutes: Optional[float] = None
    stepDays: Optional[int] = None


@dataclass
class Debug:
    """What the debug views show.

    light:
        Index of the light that views of one light show, or "environment": views shadow, reference and error then
        show the share of its diffuse light that arrives, by luminance; absent = the first light that casts a shadow
        in this frame, or else the first light.
    tile:
        Which tile of that light the view `tile` shows: a cascade or a face. Default: 0.
    predictEdges:
        True = the report estimates, without rays, how far the edges of this light's shadow map are from their true
        place (`predictedError.edgeDisplacement`). Costs about as much as shading twice. Default: false.
    """

    light: Optional[Union[int, str]] = None
    tile: Optional[int] = None
    predictEdges: Optional[bool] = None


@dataclass
class Quality:
    """A target for the shadows: an error or a time.

    maxError:
        Chooses the fastest settings that misclassify at most this share of the receivers in this view. The first
        frame measures them and takes as long as about fifty; later ones reuse the choice.
    maxMilliseconds:
        Chooses the most exact settings whose whole warm frame, without encoding, takes at most this long. The first
        frame measures them and takes as long as about fifty; later ones reuse the choice. Unit: milliseconds.
    """

    maxError: Optional[float] = None
    maxMilliseconds: Optional[float] = None


@dataclass
class Output:
    """The picture's file.

    format:
        File format if the Accept header names none. png = 8 bits a channel, sRGB; 16 bits by `pngBits`; exr =
        linear light, every view a named layer; npy = an array for NumPy: rows, columns and, of several, channels;
        npz = every view as an array for NumPy, and the report, in one ZIP; tiff = the numbers of an EXR, 32 bits a
        channel, of one view; jpeg = small, for previews: neither exact nor transparent; webp = smaller still, for
        previews: not exact. Default: "png".
    pngCompression:
        0 = largest file and fastest, 9 = smallest and slowest. The picture is the same at any level. 0 does not
        compress; 1 and 2 take a few milliseconds; against 2, 3 takes about four times as long for 5 to 10 % less, 6
        eight times for 10 to 20 % less, 9 a hundred times and more for 20 to 30 % less. The default is the last one
        that is quick. Default: 2.
    exrCompression:
        Compression of an EXR; all kinds are lossless. none = fastest to write, largest; rle = run lengths; zip =
        deflate, 16 rows at a time; piz = wavelets, small for noisy pictures. Default: "piz".
    exrPixelType:
        Bits of a number in an EXR: `half` has 11 bits of precision, `float` 24 and about twice the size. half = 16
        bits; float = 32 bits. Default: "half".
    pngBits:
        Bits of a channel in a PNG. With 16, views of numbers hold them: `depth` in millimetres, rounded, `ids`,
        `instances`, `materials` and `casterIds` as they are, 65535 where there is nothing or more than fits; all
        others the same as with 8, but finer. Default: 8.
    arrayColors:
        What colors are in `npy` and `npz`. srgb = bytes as in a PNG, exposed and tone mapped; linear = 32-bit
        floats as in an EXR, linear and not tone mapped. Default: "srgb".
    jpegQuality:
        1 = smallest file, 100 = closest to the picture and about ten times as large. Default: 90.
    webpQuality:
        0 = smallest file, 100 = closest to the picture and about ten times as large. Default: 85.
    """

    format: Optional[Literal["png", "exr", "npy", "npz", "tiff", "jpeg", "webp"]] = None
    pngCompression: Optional[int] = None
    exrCompression: Optional[Literal["none", "rle", "zip", "piz"]] = None
    exrPixelType: Optional[Literal["half", "float"]] = None
    pngBits: Optional[Literal[8, 16]] = None
    arrayColors: Optional[Literal["srgb", "linear"]] = None
    jpegQuality: Optional[int] = None
    webpQuality: Optional[int] = None


@dataclass
class FrameSpec:
    """Everything that a frame depends on, apart from the scene; every field may be left out.

    width:
        Width of the picture. Time of shading grows with the number of pixels. Unit: pixels. Default: 1280.
    height:
        Height of the picture. Unit: pixels. Default: 720.
    camera:
        Where the picture is taken from, and with which lens.
    lights:
        The lights; absent = those of the scene, or one sun of intensity 2 if it has none. Each shadow map needs
        tiles of its own.
    shadow:
        The shadow of every light that has no `shadow` of its own.
    shadowLightPolicy:
        Which lights cast shadows. all = every light whose shadow is enabled; first = the first directional light
        alone. Default: "all".
    atlas:
        The depth texture that holds every shadow tile.
    nodes:
        Switches and places of single nodes; of two entries for one node, the later one applies.
    volumes:
        Clouds, smoke and fog, in view `color`; they shade what the first directional light shines on that casts
        shadows. Other views show surfaces alone, and `reference`, `error`, `edgeDistance` and evaluations compare
        the shadows of surfaces alone.
    scene:
        Index of the glTF scene; absent = the file's default scene.
    materialVariant:
        Name of one of the file's material variants (KHR_materials_variants); absent = the materials that the meshes
        name.
    animation:
        The pose of an animated scene; absent = the file's rest pose.
    ambient:
        Light from the surroundings: a neutral studio, brighter above than at the sides and below.
    environment:
        Light from all around, which surfaces reflect and the scene may shade.
    ground:
        A plane under the scene that takes its shadows; absent = none.
    background:
        What is shown where there is no surface.
    exposure:
        Light is multiplied by 2 to this power before tone mapping; each step up doubles it. Unit: stops. Default:
        0.0.
    toneMapping:
        How linear light is brought into the range of a PNG; an EXR is never tone mapped. aces = a film-like curve;
        neutral = Khronos PBR Neutral: colors of surfaces stay, highlights alone are compressed; agx = AgX: soft
        contrast, bright colors fade to white; none = unchanged, clipped at 1. Default: "neutral".
    antialiasing:
        How edges of surfaces are smoothed. Four samples a pixel take two to three times as long to draw on a CPU.
        none = one sample a pixel; msaa4x = four samples a pixel. Default: "msaa4x".
    views:
        The views to draw, each once. A reply of one picture shows the first. Each view adds a pass over the
        picture; `reference`, `error` and `edgeDistance` also trace rays. color = the shaded scene; depth = distance
        along the view axis: metres in EXR, near-to-far grey in PNG; normal = world-space shading normal: -1..1 in
        EXR, 0..1 in PNG; cascades = the shaded scene tinted by cascade: green, blue, purple, red and on; grey
        without tiles; shadow = the share of `debug.light` that arrives, 0..1; 1 where it casts no shadow; atlas =
        the shadow atlas at its own size: grey with tiles outlined and named light.tile, or raw depth; tile = the
        depths of one tile, `debug.tile` of `debug.light`, at its own size; texelGrid = the shaded scene with the
        texels of `debug.light` as a checkerboard; grey without tiles; texelDensity = most pixels that a texel of
        `debug.light` spans: a heat map (1/16 to 16), or numbers; 0 = no texel; blendWeight = weight of the next
        cascade of `debug.light`, 0..1; 0 = none; bias = metres by which a point is moved for `debug.light`: a heat
        map (0.1 mm to 1 m), or numbers; 0 = no tile; casterIds = the node that casts the shadow of `debug.light`: a
        color, or its index; grey, or -1, where none does; lightContribution = the scene lit by `debug.light` alone:
        no other light, surroundings, emission or background; reference = the share of `debug.light` that rays find
        at each pixel; 1 where nothing receives its shadow; error = false shadow of `debug.light` in red, false
        light in blue; or shadow minus reference; edgeDistance = pixels from each edge of the shadow of
        `debug.light` to the nearest exact one: a heat map (0 to 16), or numbers; -1 = no edge; ids = the node that
        is seen: a color for each, or its index; black, or -1, where none is; instances = the copy of that node's
        mesh (EXT_mesh_gpu_instancing), 0 where there is but one; as `ids`; materials = the material that is seen,
        as `ids`; -1 also where a surface has none in the file; albedo = the base color of what is seen, unlit;
        black where nothing is; position = the point that is seen, in the world: metres, infinity where none is; or
        its place in the scene's bounds as a color; motion = pixels that what is seen has moved in the picture since
        `motionFrom`: x to the right, y down, infinity where nothing is or was not before the camera then; or the
        direction as a hue, the stronger the farther; sunHours = hours of direct sun in the time of `sunHours`: a
        heat map (0 to all hours of daylight) with a scale, or numbers; black, or -1, where no surface is. Default:
        ["color"].
    motionFrom:
        An earlier moment that the view `motion` compares with; required by that view.
    sunHours:
        Place and time whose hours of direct sun the view `sunHours` shows; required by that view. The frame's
        lights do not matter to it.
    debug:
        What the debug views show.
    quality:
        A target for the shadows instead of settings: technique, filter, cascades and sizes are then chosen to meet
        it.
    device:
        What draws the frame, where the server has a choice. Both draw the same picture within rounding; the time
        differs. auto = OpenGL on a GPU, or else the processor; cpu = the processor alone; gl = OpenGL, by whatever
        driver there is. Default: "auto".
    output:
        Format and compression of the picture.
    """

    width: Optional[int] = None
    height: Optional[int] = None
    camera: Optional[Union["Camera", Json]] = None
    lights: Optional[Sequence[Union["Light", Json]]] = None
    shadow: Optional[Union["Shadow", Json]] = None
    shadowLightPolicy: Optional[Literal["all", "first"]] = None
    atlas: Optional[Union["Atlas", Json]] = None
    nodes: Optional[Sequence[Union["NodeOptions", Json]]] = None
    volumes: Optional[Sequence[Union["VolumeOptions", Json]]] = None
    scene: Optional[int] = None
    materialVariant: Optional[str] = None
    animation: Optional[Union["AnimationMoment", Json]] = None
    ambient: Optional[Union["Ambient", Json]] = None
    environment: Optional[Union["EnvironmentOptions", Json]] = None
    ground: Optional[Union["Ground", Json]] = None
    background: Optional[Union["Background", Json]] = None
    exposure: Optional[float] = None
    toneMapping: Optional[Literal["aces", "neutral", "agx", "none"]] = None
    antialiasing: Optional[Literal["none", "msaa4x"]] = None
    views: Optional[Sequence[Literal["color", "depth", "normal", "cascades", "shadow", "atlas", "tile", "texelGrid", "texelDensity", "blendWeight", "bias", "casterIds", "lightContribution", "reference", "error", "edgeDistance", "ids", "instances", "materials", "albedo", "position", "motion", "sunHours"]]] = None
    motionFrom: Optional[Union["MotionFrom", Json]] = None
    sunHours: Optional[Union["SunHours", Json]] = None
    debug: Optional[Union["Debug", Json]] = None
    quality: Optional[Union["Quality", Json]] = None
    device: Optional[Literal["auto", "cpu", "gl"]] = None
    output: Optional[Union["Output", Json]] = None


@dataclass
class CameraPath:
    """A path of cameras for measuring shimmer; exactly one of `cameras` and `step`.

    cameras:
        One camera for each frame, used for every variant instead of its own.
    step:
        How far each variant's own camera moves from frame to frame. Unit: metres.
    frames:
        With `step`: number of frames; absent = 16. More make the figure steadier and take longer. Unit: frames.
    """

    cameras: Optional[Sequence[Union["Camera", Json]]] = None
    step: Optional[Vector] = None
    frames: Optional[int] = None


@dataclass
class EvaluationRequest:
    """What to measure on a scene; exactly one of `variants` and `sweep`.

    spec:
        What every variant starts from; must not have `quality`.
    variants:
        One row for each: what it changes in `spec`, as a JSON merge patch (RFC 7396): objects are merged, null
        removes a field, lists are replaced.
    sweep:
        A named set of variants, applied to all lights that cast shadows. techniques = hard and filtered shadow
        maps, shadow volumes, rays; filters = shadow maps with every filter at every size in texels; sizes = hard
        shadow maps, XSmall to XLarge, with 1, 2 and 4 cascades; all = all of these.
    repeats:
        Timed frames of each variant; their median counts. More make times steadier and take longer. Unit: frames.
        Default: 5.
    referenceSamples:
        Rays for each pixel of the reference towards a light that has a size; other lights take one. More make the
        reference less noisy and slower to trace. Unit: rays. Default: 256.
    path:
        Cameras along which shimmer is measured; absent = it is not measured.
    """

    spec: Optional[Union["FrameSpec", Json]] = None
    variants: Optional[Sequence[Json]] = None
    sweep: Optional[Literal["techniques", "filters", "sizes", "all"]] = None
    repeats: Optional[int] = None
    referenceSamples: Optional[int] = None
    path: Optional[Union["CameraPath", Json]] = None


@dataclass
class CarriedRange:
    """The view depths that one light's cascades cover.

    light:
        Index into the lights of the frame. Default: 0.
    near:
        View depth where the range begins. Unit: metres. Default: 0.0.
    far:
        View depth where the range ends, more than `near`. Unit: metres. Default: 0.0.
    """

    light: Optional[int] = None
    near: Optional[float] = None
    far: Optional[float] = None


@dataclass
class Carried:
    """What a frame of a sequence takes from the one before it. Pass it on unchanged.

    depthRanges:
        For each light with cascades the depths that they cover.
    """

    depthRanges: Optional[Sequence[Union["CarriedRange", Json]]] = None


@dataclass
class SequenceRequest:
    """Many frames of one scene; exactly one of `frames` and `keys`.

    spec:
        What every frame starts from; must not have `quality`.
    frames:
        One frame for each: what it changes in `spec`, as a JSON merge patch (RFC 7396): objects are merged, null
        removes a field, lists are replaced.
    keys:
        Patches as in `frames`, between which `count` frames lie at equal steps: the first frame is the first key,
        the last frame the last key. In between, numbers and times (of a sun) at the same place of two neighbouring
        keys are interpolated linearly; whole numbers and all else must be equal.
    count:
        With `keys`: number of frames. Unit: frames.
    stable:
        Shadows of directional lights hold still while the camera moves, and depth ranges pass from frame to frame,
        except where the spec has `stabilization` or `depthRange` itself. False = each frame is drawn as if it were
        alone, with the tightest fit. Default: true.
    framesPerSecond:
        Frame rate of a video. Every other form repeats it in its report, for making a video of the frames; it
        changes no frame. Unit: frames per second. Default: 30.0.
    videoQuality:
        Of a video (`Accept: video/webm`): 1 = smallest file, 100 = closest to the frames. Each frame is as good as
        every other, whatever size that takes: 50 is less than half as large as the default, 90 two thirds larger,
        100 three times as large. Default: 75.
    first:
        Index of the first frame that is drawn: 0, or where a sequence that broke off goes on. Default: 0.
    carried:
        What the frame before `first` left, from its reply. Needed with `first` if the sequence is stable; with
        `first` 0 it continues another sequence.
    """

    spec: Optional[Union["FrameSpec", Json]] = None
    frames: Optional[Sequence[Json]] = None
    keys: Optional[Sequence[Json]] = None
    count: Optional[int] = None
    stable: Optional[bool] = None
    framesPerSecond: Optional[float] = None
    videoQuality: Optional[int] = None
    first: Optional[int] = None
    carried: Optional[Union["Carried", Json]] = None

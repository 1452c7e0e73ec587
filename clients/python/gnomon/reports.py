"""What a server answers, as type checkers see it; at run time these are plain dicts."""

# Written by generate.py from /openapi.json; change the server's rows and run it again.
from __future__ import annotations

from typing import Any, Dict, List, Literal, TypedDict


class PredictedError(TypedDict, total=False):
    """How large shadow texels appear in the picture: for each block of 8 x 8 pixels, the largest extent of the texel
    under the nearest surface in the block, as if that surface faced the light.

    median:
        Half of the blocks have no more. Unit: pixels.
    p95:
        95 % of the blocks have no more. Unit: pixels.
    max:
        The worst block. Unit: pixels.
    edgeDisplacement:
        Expected mean of the measured `edgeDisplacement`, computed without rays from the shadow's own edges, and the
        texels and bias there; only with `debug.predictEdges`. Unit: pixels.
    edgeLength:
        Length of the shadow's edges over which that mean is taken. Unit: pixels.
    """

    median: float
    p95: float
    max: float
    edgeDisplacement: float
    edgeLength: float


class TileReport(TypedDict, total=False):
    """One tile: a cascade, or a face of a spot or point light.

    near:
        Where it begins: the view depth of a cascade, or a face's distance from the light along its direction. Unit:
        metres.
    far:
        Where it ends, in the same unit and along the same axis as `near`. Unit: metres.
    tile:
        x, y, width and height in the atlas, from its lower left corner, border included; width 0 = no surface in
        view lies in it, so it is not drawn. Unit: texels.
    border:
        Width of its border, read by filters only. Unit: texels.
    texelSize:
        Size of a texel across and along; for a face, at its far end. Unit: metres.
    matrix:
        Matrix from world space to the tile's clip space, column by column: x and y -1..1 over the whole tile, z 0
        near the light and 1 far from it, after the division by w; absent if the tile is not drawn.
    normalOffset:
        Distance that a surface is moved along its normal, multiplied by the sine of the angle between normal and
        light; for a face, at its far end. With a manual bias: `depth` times `normalOffsetScale`, whatever the
        angle. Unit: metres.
    depthBias:
        Distance that a surface is also moved towards the light, against rounding, as a fraction of the tile's
        depth; for a face, at its far end. The `depth` and `slope` of a manual bias are added to it.
    depthBiasMetres:
        `depthBias` as a length along the light. Unit: metres.
    predictedError:
        How large its texels appear; absent if it is not drawn.
    casterTriangles:
        Triangles drawn into this tile.
    culledTriangles:
        Triangles not drawn, because they can't shadow anything that this tile serves.
    reused:
        True = the tile of an earlier frame is used: nothing was drawn into it for this one, but for texels that no
        frame had read before.
    drawCalls:
        Draw calls into this tile.
    cpuMilliseconds:
        CPU time of drawing its casters; for the first tile also of finding all casters and clearing the atlas.
        Absent in a plan and if it was not drawn. Unit: milliseconds.
    gpuMilliseconds:
        The same on the device, as the driver reports it; also absent if the driver has no timer. Unit:
        milliseconds.
    """

    near: float
    far: float
    tile: List[int]
    border: int
    texelSize: List[float]
    matrix: List[float]
    normalOffset: float
    depthBias: float
    depthBiasMetres: float
    predictedError: "PredictedError"
    casterTriangles: int
    culledTriangles: int
    reused: bool
    drawCalls: int
    cpuMilliseconds: float
    gpuMilliseconds: float


class TechniqueChoice(TypedDict, total=False):
    """What technique auto chose for a light.

    technique:
        shadowMap or rayTraced; `spec` names it too, so that requesting `spec` again draws the same. auto = for each
        light rayTraced where that is estimated to cost at most twice its map, else shadowMap; shadowMap = depths
        seen from the light, filtered: fast, and as exact as its texels are fine; shadowVolume = stencilled shadow
        volumes: exact and sharp, drawn by the device `gl` alone; rayTraced = rays for every pixel: exact, and soft
        where the light has a size; lightMap = rays for every texel of the scene's surfaces, once, and a lookup in
        each frame: soft where the light has a size, for static scenes.
    why:
        The reason, in a sentence.
    mapMilliseconds:
        Estimate for the light's shadow map, from counts of the scene and the request: about what it takes on two
        cores. Not a promise for this machine. Unit: milliseconds.
    rayMilliseconds:
        The same for rays. Unit: milliseconds.
    """

    technique: Literal["auto", "shadowMap", "shadowVolume", "rayTraced", "lightMap"]
    why: str
    mapMilliseconds: float
    rayMilliseconds: float


class LightMapReport(TypedDict, total=False):
    """The texture that technique lightMap looks a shadow up in.

    reused:
        True = an earlier frame baked it; false = this one did.
    width:
        Its width. Unit: texels.
    height:
        Its height. Unit: texels.
    texelsPerMetre:
        How finely it shows the scene's surfaces.
    charts:
        Pieces that the surfaces were cut into.
    authoredInstances:
        Placed meshes whose TEXCOORD_1 is used: its pieces neither overlap nor leave 0..1.
    madeInstances:
        Placed meshes whose pieces were found here.
    bytes:
        Memory that it takes. Unit: bytes.
    bakeMilliseconds:
        Time that baking took when it was baked. Unit: milliseconds.
    """

    reused: bool
    width: int
    height: int
    texelsPerMetre: float
    charts: int
    authoredInstances: int
    madeInstances: int
    bytes: int
    bakeMilliseconds: float


class LightReport(TypedDict, total=False):
    """Decisions for one light.

    light:
        Index into the lights of `spec`.
    shadowed:
        True = its shadow was drawn.
    askedTileSize:
        Side of a tile as requested; 0 = no shadow was requested. Unit: texels.
    grantedTileSize:
        Side of its tiles in the atlas; 0 = none. Unit: texels.
    note:
        Why no shadow was drawn, or what differs from the request; empty = nothing.
    depthRange:
        View depths that a directional light's cascades cover, without a guard. Pass it as
        `shadow.depthRange.previous` of the next frame. Absent = none was drawn.
    tiles:
        Its tiles: cascades, nearest first, or faces of a spot or point light.
    predictedError:
        How large the texels of its tiles appear; absent if none was drawn.
    choice:
        What technique auto chose; absent where the request names another. The tiles of a light that rays were
        chosen for are planned, and drawn only where a view shows them.
    tracedPixels:
        Pixels that rays decided; technique rayTraced; absent in a plan. Unit: pixels.
    lightMap:
        What was baked; technique lightMap alone; absent in a plan.
    casterTriangles:
        Triangles drawn into its tiles.
    drawCalls:
        Draw calls into its tiles.
    cpuMilliseconds:
        CPU time of its tiles and rays; absent in a plan and if nothing was drawn. Unit: milliseconds.
    gpuMilliseconds:
        Device time of its tiles, as the driver reports it; also absent if the driver has no timer. Unit:
        milliseconds.
    """

    light: int
    shadowed: bool
    askedTileSize: int
    grantedTileSize: int
    note: str
    depthRange: Dict[str, Any]
    tiles: List["TileReport"]
    predictedError: "PredictedError"
    choice: "TechniqueChoice"
    tracedPixels: int
    lightMap: "LightMapReport"
    casterTriangles: int
    drawCalls: int
    cpuMilliseconds: float
    gpuMilliseconds: float


class VolumeReport(TypedDict, total=False):
    """A volume, and the light that arrives in it.

    voxels:
        Grid resolution in x, y, z; 0 if its node is hidden.
    values:
        Least and greatest value of its grid.
    reused:
        True = an earlier frame made its light; false = this one did.
    lightSize:
        Points at which its light is known, along x, y and z.
    lightBytes:
        Memory of these points. Unit: bytes.
    lightMilliseconds:
        Time that making its light took when it was made. Unit: milliseconds.
    """

    voxels: List[int]
    values: List[float]
    reused: bool
    lightSize: List[int]
    lightBytes: int
    lightMilliseconds: float


class SunReport(TypedDict, total=False):
    """The sun of an environment, turned and multiplied as the request says.

    towards:
        Direction towards it, of length 1.
    angularDiameterDegrees:
        Angle that its disc spans. Unit: degrees.
    color:
        Linear red, green and blue; the largest is 1.
    lux:
        Its light on a surface that faces it, as luminance, in the unit of a light's intensity.
    """

    towards: List[float]
    angularDiameterDegrees: float
    color: List[float]
    lux: float


class EnvironmentReport(TypedDict, total=False):
    """What was found in the environment.

    width:
        Width of the file's picture, or of the one that a light's cube was resampled to; 0 = a computed sky. Unit:
        texels.
    height:
        Its height; 0 = a computed sky. Unit: texels.
    meanRadiance:
        Luminance of the file's picture, sun included: the mean over all directions, in its own unit; 0 = a computed
        sky.
    sun:
        What was taken out of it and is the last of the lights of `spec`; absent = no sun was found or looked for.
    """

    width: int
    height: int
    meanRadiance: float
    sun: "SunReport"


class EdgeDisplacement(TypedDict, total=False):
    """Distance of the edges of a shadow from the true ones.

    mean:
        Misclassified area near true edges, divided by the length of these edges. Unit: pixels.
    median:
        Median distance from an edge pixel to the nearest true edge pixel. Unit: pixels.
    p95:
        95 % of the edge pixels are no farther. Unit: pixels.
    max:
        The worst edge pixel. Unit: pixels.
    """

    mean: float
    median: float
    p95: float
    max: float


class ErrorMetrics(TypedDict, total=False):
    """A shadow compared with rays, over the receivers: pixels whose surface receives shadows, faces the light and lies
    within its reach. Shares are of the receivers, 0..1.

    receivers:
        Number of receivers, over all lights measured. Unit: pixels.
    misclassified:
        Share that the frame and the reference classify differently: lit in one, in shadow in the other.
    falseShadow:
        Part of it: in shadow, lit in the reference.
    falseLit:
        Part of it: lit, in shadow in the reference.
    acne:
        False shadow farther than 2 pixels from every true edge: a surface shadows itself.
    leak:
        False light farther than 2 pixels from every true edge, or where the caster is nearer than the width of 2
        pixels: light leaks through, or a shadow is detached.
    edge:
        The other misclassified receivers: an edge in the wrong place.
    interior:
        Misclassified farther than 2 pixels from every true edge: wrong, not merely coarse.
    edgeDisplacement:
        Distance of the shadow's edges from the true ones; absent if there are no edges.
    meanAbsolute:
        Mean of the absolute difference.
    rms:
        Root mean square of the difference.
    shimmer:
        Flips for 1,000 points of the world and each frame along a path of cameras, minus those of the exact shadow.
    predicted:
        The same estimated without rays; absent without shadow maps.
    """

    receivers: int
    misclassified: float
    falseShadow: float
    falseLit: float
    acne: float
    leak: float
    edge: float
    interior: float
    edgeDisplacement: "EdgeDisplacement"
    meanAbsolute: float
    rms: float
    shimmer: float
    predicted: "PredictedError"


class SunHoursReport(TypedDict, total=False):
    """Hours of direct sun, over the pixels that show a surface.

    steps:
        Steps by day, each of which sent a ray from every pixel that faced the sun.
    daylightHours:
        Hours that these steps count: what a point in the open gets. Unit: hours.
    meanHours:
        Mean of the pixels. Unit: hours.
    minHours:
        Fewest hours of a pixel. Unit: hours.
    maxHours:
        Most hours of a pixel. Unit: hours.
    """

    steps: int
    daylightHours: float
    meanHours: float
    minHours: float
    maxHours: float


class QualityTrial(TypedDict, total=False):
    """Settings that were measured for a target, and what they reached.

    settings:
        Short name of the settings.
    shadow:
        Shadow options for every light that casts.
    atlas:
        The atlas used with them.
    milliseconds:
        Median time of a whole warm frame, without encoding. Unit: milliseconds.
    error:
        Share of misclassified receivers.
    """

    settings: str
    shadow: Dict[str, Any]
    atlas: Dict[str, Any]
    milliseconds: float
    error: float


class QualityReport(TypedDict, total=False):
    """How a target was met.

    met:
        False = no settings reach the target, and the best ones were chosen. Absent = the settings were measured in
        another view of the same kind, and not in this one.
    cached:
        True = the choice of an earlier frame of this scene and kind of view; nothing was measured for this one.
    chosen:
        Index into `tried`.
    tried:
        The settings that were measured, with what they reached.
    """

    met: bool
    cached: bool
    chosen: int
    tried: List["QualityTrial"]


class FrameCounts(TypedDict, total=False):
    """How much was drawn.

    sceneTriangles:
        Triangles in the chosen glTF scene.
    surveyedTriangles:
        Triangles drawn by the survey: those inside the view.
    shadedTriangles:
        Triangles drawn for shading: those of clusters that the survey saw.
    casterTriangles:
        Triangles drawn into all tiles.
    drawCalls:
        Draw calls of the whole frame.
    """

    sceneTriangles: int
    surveyedTriangles: int
    shadedTriangles: int
    casterTriangles: int
    drawCalls: int


class MemoryReport(TypedDict, total=False):
    """Memory of a frame on the device; padding by the driver is not counted.

    scene:
        Geometry, materials and textures, kept between frames. Unit: bytes.
    atlas:
        The shadow atlas. Unit: bytes.
    targets:
        Depth, surfaces, visibility and views of this frame. Unit: bytes.
    """

    scene: int
    atlas: int
    targets: int


PassReport = TypedDict(
    "PassReport",
    {
        "pass": str,
        "view": Literal["color", "depth", "normal", "cascades", "shadow", "atlas", "tile", "texelGrid", "texelDensity", "blendWeight", "bias", "casterIds", "lightContribution", "reference", "error", "edgeDistance", "ids", "instances", "materials", "albedo", "position", "motion", "sunHours"],
        "cpuMilliseconds": float,
        "gpuMilliseconds": float,
        "drawCalls": int,
        "triangles": int,
        "rays": int,
    },
    total=False,
)


class FrameReport(TypedDict, total=False):
    """Decisions, times and counts of a rendered frame.

    spec:
        The effective request: every default filled in. Sent as a request, it gives the same frame again.
    depthRange:
        Nearest and farthest surface in view; 0 0 = nothing in view. Unit: metres. Default: [0.0, 0.0].
    atlasSize:
        Width and height of the atlas; 0 0 = no atlas. Unit: texels. Default: [0, 0].
    lights:
        Decisions for each light.
    volumes:
        Grid and light of each volume.
    environment:
        What was found in the environment; absent = the studio lights the frame.
    predictedError:
        How large the texels of all tiles appear; absent if no tile was drawn.
    error:
        The shadow of `debug.light` compared with rays; only with view reference, error or edgeDistance.
    sunHours:
        What view `sunHours` found; only with that view.
    quality:
        How the target was met; only if the request names one.
    counts:
        How much was drawn.
    memory:
        Memory on the device.
    passes:
        Times and counts of each pass, in the order of drawing.
    stages:
        Time of each stage: queue, load, upload, bake, environment (where that is not the studio), volume (with
        `volumes`), survey, plan, shadow, shade, predict (with `debug.predictEdges`), reference (if a view asks for
        rays), sunHours (with that view), readback, encode. Unit: milliseconds.
    warnings:
        What differs from the file or the request, and what the picture is likely to lack: each a sentence, with
        what to set.
    """

    spec: Dict[str, Any]
    depthRange: List[float]
    atlasSize: List[int]
    lights: List["LightReport"]
    volumes: List["VolumeReport"]
    environment: "EnvironmentReport"
    predictedError: "PredictedError"
    error: "ErrorMetrics"
    sunHours: "SunHoursReport"
    quality: "QualityReport"
    counts: "FrameCounts"
    memory: "MemoryReport"
    passes: List["PassReport"]
    stages: Dict[str, float]
    warnings: List[str]


class PlanReport(TypedDict, total=False):
    """What a frame would do, decided without drawing it: boxes around what the camera may see replace its surfaces, so
    every tile covers what the frame's would, and perhaps more.

    spec:
        The effective request: every default filled in. Sent as a request, it gives the same frame again.
    depthRange:
        Nearest and farthest end of a box in view; 0 0 = nothing in view. Unit: metres. Default: [0.0, 0.0].
    atlasSize:
        Width and height that the atlas would have; 0 0 = no atlas. Unit: texels. Default: [0, 0].
    lights:
        What would be decided for each light, without times.
    environment:
        What was found in the environment; absent = the studio would light the frame.
    predictedError:
        Upper bound of how large the texels of all tiles would appear; absent if no tile would be drawn.
    warnings:
        What the frame's report would warn of, as far as it is known without drawing.
    """

    spec: Dict[str, Any]
    depthRange: List[float]
    atlasSize: List[int]
    lights: List["LightReport"]
    environment: "EnvironmentReport"
    predictedError: "PredictedError"
    warnings: List[str]


class MemorySummary(TypedDict, total=False):
    """Bytes of a loaded scene by what they hold; together its `memoryBytes`.

    vertices:
        Positions and other attributes. Unit: bytes.
    indices:
        Triangles, their spatial order, and their clusters. Unit: bytes.
    images:
        Images, as if all were decoded; each is when a frame first needs it. Unit: bytes.
    volumes:
        Files of volumes, as they were uploaded. Unit: bytes.
    environments:
        Files of environments and image-based lights, as they were uploaded and as if all were read. Unit: bytes.
    deformation:
        Data from which skinned and morphed meshes are posed. Unit: bytes.
    animations:
        Keyframes, and what else is needed to pose the scene. Unit: bytes.
    structure:
        Nodes, instances, cameras, lights and materials. Unit: bytes.
    """

    vertices: int
    indices: int
    images: int
    volumes: int
    environments: int
    deformation: int
    animations: int
    structure: int


class CameraSummary(TypedDict, total=False):
    """A camera of the scene.

    node:
        Index of its node; node:INDEX is its `camera.node`.
    name:
        Name of its node, or its own.
    type:
        perspective or orthographic.
    """

    node: int
    name: str
    type: str


class LightSummary(TypedDict, total=False):
    """A light of the scene.

    node:
        Index of its node.
    name:
        Name of its node, or its own.
    type:
        directional, spot or point.
    """

    node: int
    name: str
    type: str


class AnimationSummary(TypedDict, total=False):
    """An animation of the file.

    name:
        Its name, for `animation.name`; may be empty.
    durationSeconds:
        Time of its last keyframe. Unit: seconds.
    """

    name: str
    durationSeconds: float


class SceneSummary(TypedDict, total=False):
    """What an uploaded scene holds; counts are of its default glTF scene.

    id:
        SHA-256 of the upload, 64 lower-case hexadecimal digits.
    bytes:
        Size of the upload. Unit: bytes.
    memoryBytes:
        Size of the loaded scene. Unit: bytes.
    memory:
        `memoryBytes` by what it holds.
    scenes:
        Number of scenes in the file.
    defaultScene:
        Index of the scene that is drawn by default.
    nodes:
        Number of nodes.
    meshes:
        Number of meshes.
    instances:
        Primitives of meshes, counted as often as they are placed.
    materials:
        Number of materials.
    textures:
        Textures: images, counted as often as they are sampled differently.
    images:
        Number of images.
    triangles:
        Triangles, those of reused meshes counted each time.
    vertices:
        Number of vertices.
    skins:
        Number of skins.
    joints:
        Number of joints of all skins.
    morphTargets:
        Number of morph targets of all meshes.
    boundsMin:
        Lower corner of the scene's bounding box. Unit: metres.
    boundsMax:
        Upper corner of the scene's bounding box. Unit: metres.
    cameras:
        Its cameras.
    lights:
        Its lights.
    environmentLight:
        Index of the image-based light that lights it from all around unless a frame's `environment` says otherwise;
        absent = it has none.
    animations:
        The file's animations, in the order of their indices.
    materialVariants:
        Names of the file's material variants, for `materialVariant`.
    volumeFiles:
        Names of the upload's .npy and .vdb files, which a frame's `volumes` may show.
    environmentFiles:
        Names of the upload's .hdr and .exr files, which a frame's `environment` may be.
    extensionsUsed:
        glTF extensions that the file names.
    extensionsIgnored:
        Those that are not supported; the warnings say how that shows.
    warnings:
        What the file holds that is ignored or drawn differently.
    """

    id: str
    bytes: int
    memoryBytes: int
    memory: "MemorySummary"
    scenes: int
    defaultScene: int
    nodes: int
    meshes: int
    instances: int
    materials: int
    textures: int
    images: int
    triangles: int
    vertices: int
    skins: int
    joints: int
    morphTargets: int
    boundsMin: List[float]
    boundsMax: List[float]
    cameras: List["CameraSummary"]
    lights: List["LightSummary"]
    environmentLight: int
    animations: List["AnimationSummary"]
    materialVariants: List[str]
    volumeFiles: List[str]
    environmentFiles: List[str]
    extensionsUsed: List[str]
    extensionsIgnored: List[str]
    warnings: List[str]


class RendererInfo(TypedDict, total=False):
    """The device that draws and what it can do.

    backend:
        cpu, egl or osmesa.
    platform:
        cpu, device, surfaceless or osmesa.
    vendor:
        GL_VENDOR; of a processor its maker.
    renderer:
        GL_RENDERER; of a processor its name.
    version:
        GL_VERSION; of a processor the instruction set that is used.
    software:
        True = the CPU draws; there is no GPU. Default: false.
    maxTextureSize:
        Largest side of a texture. Unit: texels. Default: 0.
    maxSamples:
        Most samples a pixel. Default: 0.
    device:
        The device that draws. auto = OpenGL on a GPU, or else the processor; cpu = the processor alone; gl =
        OpenGL, by whatever driver there is. Default: "gl".
    fingerprint:
        Changes whenever the same request could give other bytes: with the driver, the CPU's make and the build.
    """

    backend: str
    platform: str
    vendor: str
    renderer: str
    version: str
    software: bool
    maxTextureSize: int
    maxSamples: int
    device: Literal["auto", "cpu", "gl"]
    fingerprint: str


class Limits(TypedDict, total=False):
    """Every bound on requests and scenes.

    maxFrameSide:
        Width or height of a frame. Unit: pixels.
    maxFramePixels:
        Width times height of a frame. Unit: pixels.
    maxAtlasSide:
        Side of the shadow atlas; the device may allow less. Unit: texels.
    maxAtlasBytes:
        The shadow atlas, with all its samples and moments. Unit: bytes.
    maxLights:
        Lights in one frame.
    maxCascades:
        Cascades of one light.
    maxLayers:
        Layers of nodes.
    maxLightMapSide:
        Longer side of a baked light map. Unit: texels.
    maxRaySamples:
        Rays for each pixel and light.
    maxVisibilityBytes:
        What rays and shadow volumes decide for every pixel and light of a frame. Unit: bytes.
    maxVolumes:
        Entries of a frame's `volumes`.
    maxTransferStops:
        Entries of a volume's transfer function.
    maxVolumeLights:
        Lights of a frame that has volumes.
    maxVolumeSide:
        Longest axis of a volume's grid, without the empty ends of a .vdb. Unit: voxels.
    maxVolumeVoxels:
        A volume's grid. Unit: voxels.
    minEnvironmentWidth:
        Least width of an environment's file, which is twice its height. Unit: texels.
    maxEnvironmentWidth:
        Greatest width of an environment's file, and four times the greatest side of a face of an image-based light.
        Unit: texels.
    maxRadiance:
        Greatest number in an environment.
    maxVariants:
        Variants of one evaluation.
    maxPathFrames:
        Cameras along the path of an evaluation.
    maxSequenceFrames:
        Frames of one sequence.
    maxSequenceKeys:
        Keys of one sequence.
    maxSequenceSpecBytes:
        The specs of all frames of a sequence together, as JSON. Unit: bytes.
    maxNodeOptions:
        Entries of a frame's `nodes`.
    maxReceiverGroups:
        Different pairs of `layers` and `receiveShadow` in one frame.
    maxSpecBytes:
        A request's JSON. Unit: bytes.
    maxSceneBytes:
        An upload: the model and every file that it names. Unit: bytes.
    maxBundleFiles:
        Files in one upload.
    maxJsonDepth:
        Nested objects and arrays.
    maxJsonValues:
        Values in a glTF's JSON.
    maxNodes:
        Nodes of a scene.
    maxInstances:
        Placed nodes and primitives, over all scenes of a file.
    maxTriangles:
        Triangles of a scene, reused meshes counted each time.
    maxVertices:
        Vertices over all meshes.
    maxDecodedBytes:
        A file's Draco and meshopt data, decoded. Unit: bytes.
    maxJoints:
        Joints over all skins.
    maxMorphTargets:
        Morph targets of one mesh.
    maxMorphedVertices:
        Vertices times morph targets, over all meshes.
    maxAnimations:
        Animations of a file.
    maxKeyframes:
        Numbers in the keyframes of all animations; those that several samplers read count each time.
    maxMaterials:
        Materials of a scene.
    maxImages:
        Images of a scene.
    maxImageSide:
        Width or height of an image. Unit: pixels.
    maxImagePixels:
        Pixels of all images together. Unit: pixels.
    """

    maxFrameSide: int
    maxFramePixels: int
    maxAtlasSide: int
    maxAtlasBytes: int
    maxLights: int
    maxCascades: int
    maxLayers: int
    maxLightMapSide: int
    maxRaySamples: int
    maxVisibilityBytes: int
    maxVolumes: int
    maxTransferStops: int
    maxVolumeLights: int
    maxVolumeSide: int
    maxVolumeVoxels: int
    minEnvironmentWidth: int
    maxEnvironmentWidth: int
    maxRadiance: float
    maxVariants: int
    maxPathFrames: int
    maxSequenceFrames: int
    maxSequenceKeys: int
    maxSequenceSpecBytes: int
    maxNodeOptions: int
    maxReceiverGroups: int
    maxSpecBytes: int
    maxSceneBytes: int
    maxBundleFiles: int
    maxJsonDepth: int
    maxJsonValues: int
    maxNodes: int
    maxInstances: int
    maxTriangles: int
    maxVertices: int
    maxDecodedBytes: int
    maxJoints: int
    maxMorphTargets: int
    maxMorphedVertices: int
    maxAnimations: int
    maxKeyframes: int
    maxMaterials: int
    maxImages: int
    maxImageSide: int
    maxImagePixels: int


class Capabilities(TypedDict, total=False):
    """What this server can do.

    version:
        Gnomon's version.
    renderer:
        The graphics context and what it can do.
    limits:
        Every bound on requests and scenes.
    """

    version: str
    renderer: "RendererInfo"
    limits: "Limits"


class VariantProblem(TypedDict, total=False):
    """Why a variant could not be measured.

    code:
        Kind of problem.
    pointer:
        Where: a JSON pointer into the variant's spec; /path = the evaluation's own path.
    detail:
        A sentence for people.
    limit:
        What would have been accepted.
    actual:
        What was sent.
    """

    code: str
    pointer: str
    detail: str
    limit: str
    actual: str


class EvaluationRow(TypedDict, total=False):
    """One variant: its speed and its error, or why there are none.

    variant:
        What it changes in the spec, as given or as generated.
    name:
        Short name.
    milliseconds:
        Median time of a whole warm frame, with all tiles drawn again, without encoding. Absent in an event `row`,
        and if there is a problem. Unit: milliseconds.
    stages:
        Median time of each stage. Unit: milliseconds.
    memoryBytes:
        Memory that the frame takes on the device, its scene included. Unit: bytes.
    metrics:
        Its error; absent if there is a problem.
    pareto:
        True = no other row is faster and has no more of the error that rows are `rankedBy`. Absent in an event
        `row`.
    problems:
        Why it could not be measured; absent if it was.
    """

    variant: Dict[str, Any]
    name: str
    milliseconds: float
    stages: Dict[str, float]
    memoryBytes: int
    metrics: "ErrorMetrics"
    pareto: bool
    problems: List["VariantProblem"]


class ReferenceReport(TypedDict, total=False):
    """The exact shadows that the rows were compared with.

    milliseconds:
        Time of tracing. Unit: milliseconds.
    buildMilliseconds:
        Time of building the ray tracing structure, before tracing. Unit: milliseconds.
    samples:
        Rays for each pixel towards lights that have a size, and towards an environment.
    frames:
        Number of traced references; variants that see the same share one.
    """

    milliseconds: float
    buildMilliseconds: float
    samples: int
    frames: int


class EvaluationReport(TypedDict, total=False):
    """Speed against error.

    rows:
        One for each variant, in their order.
    rankedBy:
        The metric that is a row's error. misclassified = the share of misclassified receivers; rms = the root mean
        square of the difference, where the environment's share is measured.
    reference:
        The exact shadows that the rows were compared with.
    renderer:
        The graphics context that drew the frames: times are those of this machine.
    """

    rows: List["EvaluationRow"]
    rankedBy: Literal["misclassified", "rms"]
    reference: "ReferenceReport"
    renderer: "RendererInfo"


class BakedLightReport(TypedDict, total=False):
    """One light's shadow, baked.

    light:
        Index into the lights of the request, or of the scene if the request has none.
    lightMap:
        The texture that holds it.
    """

    light: int
    lightMap: "LightMapReport"


class BakeReport(TypedDict, total=False):
    """Result of baking ahead.

    key:
        Names the bake: SHA-256 of the scene and of every field that a bake depends on.
    lights:
        The lights of technique lightMap.
    environment:
        With `environment.shadows` rays: the texture that holds what share of the environment's light arrives.
    milliseconds:
        Time of the whole bake. Unit: milliseconds.
    """

    key: str
    lights: List["BakedLightReport"]
    environment: "LightMapReport"
    milliseconds: float


class SequenceFrameReport(TypedDict, total=False):
    """Times of one frame of a sequence.

    index:
        Which frame.
    milliseconds:
        Time from its beginning to its pictures; neighbouring frames overlap. Unit: milliseconds.
    stages:
        Time of each stage. Unit: milliseconds.
    """

    index: int
    milliseconds: float
    stages: Dict[str, float]


class SequenceReport(TypedDict, total=False):
    """Times of a sequence, and what continues it.

    frames:
        One entry for each frame that was drawn.
    milliseconds:
        Time from the first frame's beginning to the last one's pictures, waiting for the client included. Unit:
        milliseconds.
    framesPerSecond:
        As requested. Unit: frames per second.
    carried:
        What the last frame leaves to a sequence that continues this one.
    warnings:
        What differs from the request, over all frames, each once; at most 32.
    renderer:
        The graphics context that drew the frames.
    """

    frames: List["SequenceFrameReport"]
    milliseconds: float
    framesPerSecond: float
    carried: Dict[str, Any]
    warnings: List[str]
    renderer: "RendererInfo"


class ProblemEntry(TypedDict, total=False):
    """One problem.

    code:
        Kind of problem. malformed = Malformed Request; invalidValue = Invalid Value; notFound = Not Found;
        methodNotAllowed = Method Not Allowed; unauthorized = Unauthorized; forbidden = Forbidden; misdirected =
        Misdirected Request; notAcceptable = Not Acceptable; preconditionFailed = Precondition Failed;
        lengthRequired = Length Required; tooLarge = Content Too Large; unsupportedMediaType = Unsupported Media
        Type; invalidScene = Invalid Scene; unsupportedFeature = Unsupported Feature; hashMismatch = Hash Mismatch;
        busy = Too Many Requests; deadlineExceeded = Deadline Exceeded; unavailable = Service Unavailable;
        insufficientStorage = Insufficient Storage; backend = Graphics Backend Failure; internal = Internal Server
        Error. Default: "internal".
    pointer:
        Where: a JSON pointer, a query key or the name of a part.
    detail:
        One sentence for people.
    limit:
        What would have been accepted.
    actual:
        What was sent, shortened.
    """

    code: Literal["malformed", "invalidValue", "notFound", "methodNotAllowed", "unauthorized", "forbidden", "misdirected", "notAcceptable", "preconditionFailed", "lengthRequired", "tooLarge", "unsupportedMediaType", "invalidScene", "unsupportedFeature", "hashMismatch", "busy", "deadlineExceeded", "unavailable", "insufficientStorage", "backend", "internal"]
    pointer: str
    detail: str
    limit: str
    actual: str


class Job(TypedDict, total=False):
    """A sequence that is drawn in the background.

    id:
        Names the job; not guessable.
    state:
        State of the job. queued = no frame was begun; running = some frames were begun; done = all frames are
        drawn; failed = a frame could not be drawn; cancelled = it was removed while a client waited for it.
    scene:
        Id of its scene.
    key:
        Name of the key that asked for it; absent = the server has no keys.
    first:
        Index of the first frame that is drawn.
    done:
        Frames that are drawn.
    of:
        Frames that are to be drawn; the last index is `first` + `of` - 1.
    bytes:
        Size of the pictures so far. Unit: bytes.
    created:
        When it was requested; RFC 3339, in UTC, as all its times.
    started:
        When its first frame was begun; absent = not yet.
    ended:
        When it was done or failed; absent = not yet.
    expires:
        When it is removed with its pictures, if no further frame is drawn.
    problems:
        Why it failed; pointers are places in the request for the sequence.
    address:
        Address of the job.
    result:
        Address of all frames, in the forms of a sequence.
    frames:
        Address of one frame, with its index for `{index}`.
    """

    id: str
    state: Literal["queued", "running", "done", "failed", "cancelled"]
    scene: str
    key: str
    first: int
    done: int
    of: int
    bytes: int
    created: str
    started: str
    ended: str
    expires: str
    problems: List["ProblemEntry"]
    address: str
    result: str
    frames: str


class NodeSummary(TypedDict, total=False):
    """A node of the file.

    node:
        Its index, for `nodes[].node`.
    name:
        Its name; may be empty, and others may have the same.
    parent:
        Index of the node above it; absent = a root.
    triangles:
        Triangles that it places itself, without those below it.
    """

    node: int
    name: str
    parent: int
    triangles: int


class NodeList(TypedDict, total=False):
    """A page of a scene's nodes, by index.

    nodes:
        The nodes.
    next:
        Where there are more: what `after` asks for the next page with.
    """

    nodes: List["NodeSummary"]
    next: int

#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/replies.h"
#include "protocol/report/report_rows.h"
#include "protocol/spec/field_rows.h"
#include "protocol/spec/limits.h"

/// One row for each member of the structs that replies are made of, but the reports (report_rows.h); see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<CameraSummary> =
    replyRows("CameraSummary", "A camera of the scene.",
              field("node", &CameraSummary::node, {.says = "Index of its node; node:INDEX is its `camera.node`."}),
              field("name", &CameraSummary::name, {.says = "Name of its node, or its own."}),
              field("type", &CameraSummary::type, {.says = "perspective or orthographic."}));
static_assert(kRowsAreComplete<CameraSummary>);

template <>
inline constexpr auto kRows<LightSummary> = replyRows(
    "LightSummary", "A light of the scene.", field("node", &LightSummary::node, {.says = "Index of its node."}),
    field("name", &LightSummary::name, {.says = "Name of its node, or its own."}),
    field("type", &LightSummary::type, {.says = "directional, spot or point."}));
static_assert(kRowsAreComplete<LightSummary>);

template <>
inline constexpr auto kRows<MemorySummary> = replyRows(
    "MemorySummary", "Bytes of a loaded scene by what they hold; together its `memoryBytes`.",
    field("vertices", &MemorySummary::vertices, {.says = "Positions and other attributes.", .unit = "bytes"}),
    field("indices", &MemorySummary::indices,
          {.says = "Triangles, their spatial order, and their clusters.", .unit = "bytes"}),
    field("images", &MemorySummary::images,
          {.says = "Images, as if all were decoded; each is when a frame first needs it.", .unit = "bytes"}),
    field("volumes", &MemorySummary::volumes, {.says = "Files of volumes, as they were uploaded.", .unit = "bytes"}),
    field("deformation", &MemorySummary::deformation,
          {.says = "Data from which skinned and morphed meshes are posed.", .unit = "bytes"}),
    field("animations", &MemorySummary::animations,
          {.says = "Keyframes, and what else is needed to pose the scene.", .unit = "bytes"}),
    field("structure", &MemorySummary::structure,
          {.says = "Nodes, instances, cameras, lights and materials.", .unit = "bytes"}));
static_assert(kRowsAreComplete<MemorySummary>);

template <>
inline constexpr auto kRows<AnimationSummary> =
    replyRows("AnimationSummary", "An animation of the file.",
              field("name", &AnimationSummary::name, {.says = "Its name, for `animation.name`; may be empty."}),
              field("durationSeconds", &AnimationSummary::durationSeconds,
                    {.says = "Time of its last keyframe.", .unit = "seconds"}));
static_assert(kRowsAreComplete<AnimationSummary>);

template <>
inline constexpr auto kRows<SceneSummary> = replyRows(
    "SceneSummary", "What an uploaded scene holds; counts are of its default glTF scene.",
    field("id", &SceneSummary::id, {.says = "SHA-256 of the upload, 64 lower-case hexadecimal digits."}),
    field("bytes", &SceneSummary::bytes, {.says = "Size of the upload.", .unit = "bytes"}),
    field("memoryBytes", &SceneSummary::memoryBytes, {.says = "Size of the loaded scene.", .unit = "bytes"}),
    field("memory", &SceneSummary::memory, {.says = "`memoryBytes` by what it holds."}),
    field("scenes", &SceneSummary::scenes, {.says = "Number of scenes in the file."}),
    field("defaultScene", &SceneSummary::defaultScene, {.says = "Index of the scene that is drawn by default."}),
    field("nodes", &SceneSummary::nodes, {.says = "Number of nodes."}),
    field("meshes", &SceneSummary::meshes, {.says = "Number of meshes."}),
    field("instances", &SceneSummary::instances,
          {.says = "Primitives of meshes, counted as often as they are placed."}),
    field("materials", &SceneSummary::materials, {.says = "Number of materials."}),
    field("textures", &SceneSummary::textures,
          {.says = "Textures: images, counted as often as they are sampled differently."}),
    field("images", &SceneSummary::images, {.says = "Number of images."}),
    field("triangles", &SceneSummary::triangles, {.says = "Triangles, those of reused meshes counted each time."}),
    field("vertices", &SceneSummary::vertices, {.says = "Number of vertices."}),
    field("skins", &SceneSummary::skins, {.says = "Number of skins."}),
    field("joints", &SceneSummary::joints, {.says = "Number of joints of all skins."}),
    field("morphTargets", &SceneSummary::morphTargets, {.says = "Number of morph targets of all meshes."}),
    field("boundsMin", &SceneSummary::boundsMin,
          {.says = "Lower corner of the scene's bounding box.", .unit = "metres"}),
    field("boundsMax", &SceneSummary::boundsMax,
          {.says = "Upper corner of the scene's bounding box.", .unit = "metres"}),
    field("cameras", &SceneSummary::cameras, {.says = "Its cameras."}),
    field("lights", &SceneSummary::lights, {.says = "Its lights."}),
    field("animations", &SceneSummary::animations, {.says = "The file's animations, in the order of their indices."}),
    field("materialVariants", &SceneSummary::materialVariants,
          {.says = "Names of the file's material variants, for `materialVariant`."}),
    field("volumeFiles", &SceneSummary::volumeFiles,
          {.says = "Names of the upload's .npy and .vdb files, which a frame's `volumes` may show."}),
    field("extensionsUsed", &SceneSummary::extensionsUsed, {.says = "glTF extensions that the file names."}),
    field("extensionsIgnored", &SceneSummary::extensionsIgnored,
          {.says = "Those that are not supported; the warnings say how that shows."}),
    field("warnings", &SceneSummary::warnings, {.says = "What the file holds that is ignored or drawn differently."}));
static_assert(kRowsAreComplete<SceneSummary>);

template <>
inline constexpr auto kRows<RendererInfo> = rows(
    "RendererInfo", "The device that draws and what it can do.",
    field("backend", &RendererInfo::backend, {.says = "cpu, egl or osmesa."}),
    field("platform", &RendererInfo::platform, {.says = "cpu, device, surfaceless or osmesa."}),
    field("vendor", &RendererInfo::vendor, {.says = "GL_VENDOR; of a processor its maker."}),
    field("renderer", &RendererInfo::renderer, {.says = "GL_RENDERER; of a processor its name."}),
    field("version", &RendererInfo::version, {.says = "GL_VERSION; of a processor the instruction set that is used."}),
    field("software", &RendererInfo::software, {.says = "True = the CPU draws; there is no GPU."}),
    field("maxTextureSize", &RendererInfo::maxTextureSize, {.says = "Largest side of a texture.", .unit = "texels"}),
    field("maxSamples", &RendererInfo::maxSamples, {.says = "Most samples a pixel."}),
    field("device", &RendererInfo::device, {.says = "The device that draws."}),
    field("fingerprint", &RendererInfo::fingerprint,
          {.says = "Changes whenever the same request could give other bytes: with the driver, the CPU's make and the "
                   "build."}));
static_assert(kRowsAreComplete<RendererInfo>);

template <>
inline constexpr auto kRows<Limits> = replyRows(
    "Limits", "Every bound on requests and scenes.",
    field("maxFrameSide", &Limits::maxFrameSide, {.says = "Width or height of a frame.", .unit = "pixels"}),
    field("maxFramePixels", &Limits::maxFramePixels, {.says = "Width times height of a frame.", .unit = "pixels"}),
    field("maxAtlasSide", &Limits::maxAtlasSide,
          {.says = "Side of the shadow atlas; the device may allow less.", .unit = "texels"}),
    field("maxAtlasBytes", &Limits::maxAtlasBytes,
          {.says = "The shadow atlas, with all its samples and moments.", .unit = "bytes"}),
    field("maxLights", &Limits::maxLights, {.says = "Lights in one frame."}),
    field("maxCascades", &Limits::maxCascades, {.says = "Cascades of one light."}),
    field("maxLayers", &Limits::maxLayers, {.says = "Layers of nodes."}),
    field("maxLightMapSide", &Limits::maxLightMapSide, {.says = "Longer side of a baked light map.", .unit = "texels"}),
    field("maxRaySamples", &Limits::maxRaySamples, {.says = "Rays for each pixel and light."}),
    field("maxVisibilityBytes", &Limits::maxVisibilityBytes,
          {.says = "What rays and shadow volumes decide for every pixel and light of a frame.", .unit = "bytes"}),
    field("maxVolumes", &Limits::maxVolumes, {.says = "Entries of a frame's `volumes`."}),
    field("maxTransferStops", &Limits::maxTransferStops, {.says = "Entries of a volume's transfer function."}),
    field("maxVolumeLights", &Limits::maxVolumeLights, {.says = "Lights of a frame that has volumes."}),
    field("maxVolumeSide", &Limits::maxVolumeSide,
          {.says = "Longest axis of a volume's grid, without the empty ends of a .vdb.", .unit = "voxels"}),
    field("maxVolumeVoxels", &Limits::maxVolumeVoxels, {.says = "A volume's grid.", .unit = "voxels"}),
    field("maxVariants", &Limits::maxVariants, {.says = "Variants of one evaluation."}),
    field("maxPathFrames", &Limits::maxPathFrames, {.says = "Cameras along the path of an evaluation."}),
    field("maxSequenceFrames", &Limits::maxSequenceFrames, {.says = "Frames of one sequence."}),
    field("maxSequenceKeys", &Limits::maxSequenceKeys, {.says = "Keys of one sequence."}),
    field("maxSequenceSpecBytes", &Limits::maxSequenceSpecBytes,
          {.says = "The specs of all frames of a sequence together, as JSON.", .unit = "bytes"}),
    field("maxNodeOptions", &Limits::maxNodeOptions, {.says = "Entries of a frame's `nodes`."}),
    field("maxReceiverGroups", &Limits::maxReceiverGroups,
          {.says = "Different pairs of `layers` and `receiveShadow` in one frame."}),
    field("maxSpecBytes", &Limits::maxSpecBytes, {.says = "A request's JSON.", .unit = "bytes"}),
    field("maxSceneBytes", &Limits::maxSceneBytes,
          {.says = "An upload: the model and every file that it names.", .unit = "bytes"}),
    field("maxBundleFiles", &Limits::maxBundleFiles, {.says = "Files in one upload."}),
    field("maxJsonDepth", &Limits::maxJsonDepth, {.says = "Nested objects and arrays."}),
    field("maxJsonValues", &Limits::maxJsonValues, {.says = "Values in a glTF's JSON."}),
    field("maxNodes", &Limits::maxNodes, {.says = "Nodes of a scene."}),
    field("maxInstances", &Limits::maxInstances, {.says = "Placed nodes and primitives, over all scenes of a file."}),
    field("maxTriangles", &Limits::maxTriangles, {.says = "Triangles of a scene, reused meshes counted each time."}),
    field("maxVertices", &Limits::maxVertices, {.says = "Vertices over all meshes."}),
    field("maxDecodedBytes", &Limits::maxDecodedBytes,
          {.says = "A file's Draco and meshopt data, decoded.", .unit = "bytes"}),
    field("maxJoints", &Limits::maxJoints, {.says = "Joints over all skins."}),
    field("maxMorphTargets", &Limits::maxMorphTargets, {.says = "Morph targets of one mesh."}),
    field("maxMorphedVertices", &Limits::maxMorphedVertices,
          {.says = "Vertices times morph targets, over all meshes."}),
    field("maxAnimations", &Limits::maxAnimations, {.says = "Animations of a file."}),
    field("maxKeyframes", &Limits::maxKeyframes,
          {.says = "Numbers in the keyframes of all animations; those that several samplers read count each time."}),
    field("maxMaterials", &Limits::maxMaterials, {.says = "Materials of a scene."}),
    field("maxImages", &Limits::maxImages, {.says = "Images of a scene."}),
    field("maxImageSide", &Limits::maxImageSide, {.says = "Width or height of an image.", .unit = "pixels"}),
    field("maxImagePixels", &Limits::maxImagePixels, {.says = "Pixels of all images together.", .unit = "pixels"}));
static_assert(kRowsAreComplete<Limits>);

template <>
inline constexpr auto kRows<ImageReply> = replyRows(
    "ImageReply", "A picture within a JSON reply.",
    field("view", &ImageReply::view, {.says = "What it shows; for an EXR, which holds every view, the first."}),
    field("contentType", &ImageReply::contentType, {.says = "Media type of the picture's format, as image/png."}),
    field("data", &ImageReply::data, {.says = "The file in base64 (RFC 4648 section 4)."}));
static_assert(kRowsAreComplete<ImageReply>);

template <>
inline constexpr auto kRows<FrameReply> =
    replyRows("FrameReply", "A frame as JSON.",
              field("report", &FrameReply::report, {.says = "What the rendering decided and took."}),
              field("images", &FrameReply::images, {.says = "One PNG for each view, or one EXR of all views."}));
static_assert(kRowsAreComplete<FrameReply>);

template <>
inline constexpr auto kRows<SceneList> = replyRows(
    "SceneList", "A page of the scenes that the server has, by id.",
    field("scenes", &SceneList::scenes, {.says = "One summary for each scene."}),
    field("next", &SceneList::next, {.says = "Where there are more: what `after` asks for the next page with."}));
static_assert(kRowsAreComplete<SceneList>);

template <>
inline constexpr auto kRows<Capabilities> = replyRows(
    "Capabilities", "What this server can do.", field("version", &Capabilities::version, {.says = "Gnomon's version."}),
    field("renderer", &Capabilities::renderer, {.says = "The graphics context and what it can do."}),
    field("limits", &Capabilities::limits, {.says = "Every bound on requests and scenes."}));
static_assert(kRowsAreComplete<Capabilities>);

} // namespace gnomon

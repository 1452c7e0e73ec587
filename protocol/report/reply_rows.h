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
              field<&CameraSummary::node>("Index of its node; node:INDEX is its `camera.node`."),
              field<&CameraSummary::name>("Name of its node, or its own."),
              field<&CameraSummary::type>("perspective or orthographic."));

template <>
inline constexpr auto kRows<LightSummary> = replyRows("LightSummary", "A light of the scene.",
                                                      field<&LightSummary::node>("Index of its node."),
                                                      field<&LightSummary::name>("Name of its node, or its own."),
                                                      field<&LightSummary::type>("directional, spot or point."));

template <>
inline constexpr auto kRows<MemorySummary> = replyRows(
    "MemorySummary", "Bytes of a loaded scene by what they hold; together its `memoryBytes`.",
    field<&MemorySummary::vertices>("Positions and other attributes.", {.unit = "bytes"}),
    field<&MemorySummary::indices>("Triangles, their spatial order, and their clusters.", {.unit = "bytes"}),
    field<&MemorySummary::images>("Images, as if all were decoded; each is when a frame first needs it.",
                                  {.unit = "bytes"}),
    field<&MemorySummary::volumes>("Files of volumes, as they were uploaded.", {.unit = "bytes"}),
    field<&MemorySummary::environments>("Files of environments and image-based lights, as they were uploaded and as if "
                                        "all were read.",
                                        {.unit = "bytes"}),
    field<&MemorySummary::deformation>("Data from which skinned and morphed meshes are posed.", {.unit = "bytes"}),
    field<&MemorySummary::animations>("Keyframes, and what else is needed to pose the scene.", {.unit = "bytes"}),
    field<&MemorySummary::structure>("Nodes, instances, cameras, lights and materials.", {.unit = "bytes"}));

template <>
inline constexpr auto kRows<AnimationSummary> =
    replyRows("AnimationSummary", "An animation of the file.",
              field<&AnimationSummary::name>("Its name, for `animation.name`; may be empty."),
              field<&AnimationSummary::durationSeconds>("Time of its last keyframe.", {.unit = "seconds"}));

template <>
inline constexpr auto kRows<SceneSummary> = replyRows(
    "SceneSummary", "What an uploaded scene holds; counts are of its default glTF scene.",
    field<&SceneSummary::id>("SHA-256 of the upload, 64 lower-case hexadecimal digits."),
    field<&SceneSummary::bytes>("Size of the upload.", {.unit = "bytes"}),
    field<&SceneSummary::memoryBytes>("Size of the loaded scene.", {.unit = "bytes"}),
    field<&SceneSummary::memory>("`memoryBytes` by what it holds."),
    field<&SceneSummary::scenes>("Number of scenes in the file."),
    field<&SceneSummary::defaultScene>("Index of the scene that is drawn by default."),
    field<&SceneSummary::nodes>("Number of nodes."), field<&SceneSummary::meshes>("Number of meshes."),
    field<&SceneSummary::instances>("Primitives of meshes, counted as often as they are placed."),
    field<&SceneSummary::materials>("Number of materials."),
    field<&SceneSummary::textures>("Textures: images, counted as often as they are sampled differently."),
    field<&SceneSummary::images>("Number of images."),
    field<&SceneSummary::triangles>("Triangles, those of reused meshes counted each time."),
    field<&SceneSummary::vertices>("Number of vertices."), field<&SceneSummary::skins>("Number of skins."),
    field<&SceneSummary::joints>("Number of joints of all skins."),
    field<&SceneSummary::morphTargets>("Number of morph targets of all meshes."),
    field<&SceneSummary::boundsMin>("Lower corner of the scene's bounding box.", {.unit = "metres"}),
    field<&SceneSummary::boundsMax>("Upper corner of the scene's bounding box.", {.unit = "metres"}),
    field<&SceneSummary::cameras>("Its cameras."), field<&SceneSummary::lights>("Its lights."),
    field<&SceneSummary::environmentLight>("Index of the image-based light that lights it from all around unless a "
                                           "frame's `environment` says otherwise; absent = it has none."),
    field<&SceneSummary::animations>("The file's animations, in the order of their indices."),
    field<&SceneSummary::materialVariants>("Names of the file's material variants, for `materialVariant`."),
    field<&SceneSummary::volumeFiles>("Names of the upload's .npy and .vdb files, which a frame's `volumes` may show."),
    field<&SceneSummary::environmentFiles>(
        "Names of the upload's .hdr and .exr files, which a frame's `environment` may be."),
    field<&SceneSummary::extensionsUsed>("glTF extensions that the file names."),
    field<&SceneSummary::extensionsIgnored>("Those that are not supported; the warnings say how that shows."),
    field<&SceneSummary::warnings>("What the file holds that is ignored or drawn differently."));

template <>
inline constexpr auto kRows<RendererInfo> = rows(
    "RendererInfo", "The device that draws and what it can do.", field<&RendererInfo::backend>("cpu, egl or osmesa."),
    field<&RendererInfo::platform>("cpu, device, surfaceless or osmesa."),
    field<&RendererInfo::vendor>("GL_VENDOR; of a processor its maker."),
    field<&RendererInfo::renderer>("GL_RENDERER; of a processor its name."),
    field<&RendererInfo::version>("GL_VERSION; of a processor the instruction set that is used."),
    field<&RendererInfo::software>("True = the CPU draws; there is no GPU."),
    field<&RendererInfo::maxTextureSize>("Largest side of a texture.", {.unit = "texels"}),
    field<&RendererInfo::maxSamples>("Most samples a pixel."), field<&RendererInfo::device>("The device that draws."),
    field<&RendererInfo::fingerprint>(
        "Changes whenever the same request could give other bytes: with the driver, the CPU's make and the build."));

template <>
inline constexpr auto kRows<Limits> = replyRows(
    "Limits", "Every bound on requests and scenes.",
    field<&Limits::maxFrameSide>("Width or height of a frame.", {.unit = "pixels"}),
    field<&Limits::maxFramePixels>("Width times height of a frame.", {.unit = "pixels"}),
    field<&Limits::maxAtlasSide>("Side of the shadow atlas; the device may allow less.", {.unit = "texels"}),
    field<&Limits::maxAtlasBytes>("The shadow atlas, with all its samples and moments.", {.unit = "bytes"}),
    field<&Limits::maxLights>("Lights in one frame."), field<&Limits::maxCascades>("Cascades of one light."),
    field<&Limits::maxLayers>("Layers of nodes."),
    field<&Limits::maxLightMapSide>("Longer side of a baked light map.", {.unit = "texels"}),
    field<&Limits::maxRaySamples>("Rays for each pixel and light."),
    field<&Limits::maxVisibilityBytes>("What rays and shadow volumes decide for every pixel and light of a frame.",
                                       {.unit = "bytes"}),
    field<&Limits::maxVolumes>("Entries of a frame's `volumes`."),
    field<&Limits::maxTransferStops>("Entries of a volume's transfer function."),
    field<&Limits::maxVolumeLights>("Lights of a frame that has volumes."),
    field<&Limits::maxVolumeSide>("Longest axis of a volume's grid, without the empty ends of a .vdb.",
                                  {.unit = "voxels"}),
    field<&Limits::maxVolumeVoxels>("A volume's grid.", {.unit = "voxels"}),
    field<&Limits::minEnvironmentWidth>("Least width of an environment's file, which is twice its height.",
                                        {.unit = "texels"}),
    field<&Limits::maxEnvironmentWidth>(
        "Greatest width of an environment's file, and four times the greatest side of a "
        "face of an image-based light.",
        {.unit = "texels"}),
    field<&Limits::maxRadiance>("Greatest number in an environment."),
    field<&Limits::maxVariants>("Variants of one evaluation."),
    field<&Limits::maxPathFrames>("Cameras along the path of an evaluation."),
    field<&Limits::maxSequenceFrames>("Frames of one sequence."),
    field<&Limits::maxSequenceKeys>("Keys of one sequence."),
    field<&Limits::maxSequenceSpecBytes>("The specs of all frames of a sequence together, as JSON.", {.unit = "bytes"}),
    field<&Limits::maxNodeOptions>("Entries of a frame's `nodes`."),
    field<&Limits::maxReceiverGroups>("Different pairs of `layers` and `receiveShadow` in one frame."),
    field<&Limits::maxSpecBytes>("A request's JSON.", {.unit = "bytes"}),
    field<&Limits::maxSceneBytes>("An upload: the model and every file that it names.", {.unit = "bytes"}),
    field<&Limits::maxBundleFiles>("Files in one upload."), field<&Limits::maxJsonDepth>("Nested objects and arrays."),
    field<&Limits::maxJsonValues>("Values in a glTF's JSON."), field<&Limits::maxNodes>("Nodes of a scene."),
    field<&Limits::maxInstances>("Placed nodes and primitives, over all scenes of a file."),
    field<&Limits::maxTriangles>("Triangles of a scene, reused meshes counted each time."),
    field<&Limits::maxVertices>("Vertices over all meshes."),
    field<&Limits::maxDecodedBytes>("A file's Draco and meshopt data, decoded.", {.unit = "bytes"}),
    field<&Limits::maxJoints>("Joints over all skins."), field<&Limits::maxMorphTargets>("Morph targets of one mesh."),
    field<&Limits::maxMorphedVertices>("Vertices times morph targets, over all meshes."),
    field<&Limits::maxAnimations>("Animations of a file."),
    field<&Limits::maxKeyframes>(
        "Numbers in the keyframes of all animations; those that several samplers read count each time."),
    field<&Limits::maxMaterials>("Materials of a scene."), field<&Limits::maxImages>("Images of a scene."),
    field<&Limits::maxImageSide>("Width or height of an image.", {.unit = "pixels"}),
    field<&Limits::maxImagePixels>("Pixels of all images together.", {.unit = "pixels"}));

template <>
inline constexpr auto kRows<ImageReply> =
    replyRows("ImageReply", "A picture within a JSON reply.",
              field<&ImageReply::view>("What it shows; for an EXR, which holds every view, the first."),
              field<&ImageReply::contentType>("Media type of the picture's format, as image/png."),
              field<&ImageReply::data>("The file in base64 (RFC 4648 section 4)."));

template <>
inline constexpr auto kRows<FrameReply> =
    replyRows("FrameReply", "A frame as JSON.", field<&FrameReply::report>("What the rendering decided and took."),
              field<&FrameReply::images>("One PNG for each view, or one EXR of all views."));

template <>
inline constexpr auto kRows<SceneList> =
    replyRows("SceneList", "A page of the scenes that the server has, by id.",
              field<&SceneList::scenes>("One summary for each scene."),
              field<&SceneList::next>("Where there are more: what `after` asks for the next page with."));

template <>
inline constexpr auto kRows<Capabilities> =
    replyRows("Capabilities", "What this server can do.", field<&Capabilities::version>("Gnomon's version."),
              field<&Capabilities::renderer>("The graphics context and what it can do."),
              field<&Capabilities::limits>("Every bound on requests and scenes."));

template <>
inline constexpr auto kRows<NodeSummary> =
    replyRows("NodeSummary", "A node of the file.", field<&NodeSummary::node>("Its index, for `nodes[].node`."),
              field<&NodeSummary::name>("Its name; may be empty, and others may have the same."),
              field<&NodeSummary::parent>("Index of the node above it; absent = a root."),
              field<&NodeSummary::triangles>("Triangles that it places itself, without those below it."));

template <>
inline constexpr auto kRows<NodePage> = rows("NodePage", "Which part of a scene's nodes is asked for.",
                                             field<&NodePage::after>("Index of the last node that is known."),
                                             field<&NodePage::limit>("The most nodes on the page."));

template <>
inline constexpr auto kRows<NodeList> =
    replyRows("NodeList", "A page of a scene's nodes, by index.", field<&NodeList::nodes>("The nodes."),
              field<&NodeList::next>("Where there are more: what `after` asks for the next page with."));

} // namespace gnomon

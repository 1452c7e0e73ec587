#pragma once

#include "protocol/capabilities.h"
#include "protocol/field_rows.h"
#include "protocol/fields.h"
#include "protocol/frame_report.h"
#include "protocol/limits.h"
#include "protocol/replies.h"
#include "protocol/scene_summary.h"

/// One row for each member of the structs that replies are made of; see field_rows.h. StageTime has none: the stages
/// are one JSON object.
namespace gnomon {

template <>
inline constexpr auto kRows<CascadeReport> = replyRows(
    "CascadeReport", "One tile as it was drawn: a cascade, or a face of a spot or point light.",
    field(
        "near", &CascadeReport::near,
        {.says = "Where it begins: the view depth of a cascade; a face's distance from the light along its direction.",
         .unit = "metres"}),
    field("far", &CascadeReport::far, {.says = "Where it ends, measured alike.", .unit = "metres"}),
    field("tile", &CascadeReport::tile,
          {.says = "x, y, width and height in the atlas, from its lower left corner, border included.",
           .unit = "texels"}),
    field("texelSize", &CascadeReport::texelSize,
          {.says = "Size of a texel across and along; of a face, at its far end.", .unit = "metres"}),
    field("casterTriangles", &CascadeReport::casterTriangles, {.says = "Triangles drawn into this tile."}),
    field("culledTriangles", &CascadeReport::culledTriangles,
          {.says = "Triangles not drawn, because they can't shadow anything that this tile serves."}));
static_assert(kRowsAreComplete<CascadeReport>);

template <>
inline constexpr auto kRows<LightReport> =
    replyRows("LightReport", "What was decided for one light.",
              field("light", &LightReport::light, {.says = "Index into the lights of `spec`."}),
              field("shadowed", &LightReport::shadowed, {.says = "True = its shadow was drawn."}),
              field("askedTileSize", &LightReport::askedTileSize,
                    {.says = "Side of a tile that was asked for; 0 = no shadow was.", .unit = "texels"}),
              field("grantedTileSize", &LightReport::grantedTileSize,
                    {.says = "Side of a tile that was given; 0 = none.", .unit = "texels"}),
              field("note", &LightReport::note,
                    {.says = "Why no shadow was drawn, or what was decided differently; empty = as asked."}),
              field("cascades", &LightReport::cascades,
                    {.says = "Its cascades, nearest first, or the faces of a spot or point light."}));
static_assert(kRowsAreComplete<LightReport>);

template <>
inline constexpr auto kRows<FrameCounts> =
    replyRows("FrameCounts", "How much was drawn.",
              field("sceneTriangles", &FrameCounts::sceneTriangles, {.says = "Triangles in the chosen glTF scene."}),
              field("surveyedTriangles", &FrameCounts::surveyedTriangles,
                    {.says = "Triangles drawn by the survey: those inside the view."}),
              field("shadedTriangles", &FrameCounts::shadedTriangles,
                    {.says = "Triangles drawn for the surfaces to light: in clusters that the survey saw."}),
              field("casterTriangles", &FrameCounts::casterTriangles, {.says = "Triangles drawn into all tiles."}),
              field("drawCalls", &FrameCounts::drawCalls, {.says = "Draw calls of the whole frame."}));
static_assert(kRowsAreComplete<FrameCounts>);

template <>
inline constexpr auto kRows<FrameReport> = rows(
    "FrameReport", "What a frame's rendering gives besides its pictures.",
    field("spec", &FrameReport::spec,
          {.says = "The effective specification: every default resolved, so that it can be asked for again."}),
    field("depthRange", &FrameReport::depthRange,
          {.says = "Nearest and farthest surface in view; 0 0 = nothing in view.", .unit = "metres"}),
    field("atlasSize", &FrameReport::atlasSize,
          {.says = "Width and height that the atlas really took; 0 0 = no atlas.", .unit = "texels"}),
    field("lights", &FrameReport::lights, {.says = "What was decided for each light."}),
    field("counts", &FrameReport::counts, {.says = "How much was drawn."}),
    field("stages", &FrameReport::stages,
          {.says = "Time that each stage took: queue, load, upload, survey, plan, shadow, shade, readback, encode.",
           .unit = "milliseconds"}),
    field("warnings", &FrameReport::warnings, {.says = "What was drawn differently from what was asked."}));
static_assert(kRowsAreComplete<FrameReport>);

template <>
inline constexpr auto kRows<CameraSummary> =
    replyRows("CameraSummary", "A camera of the scene.",
              field("node", &CameraSummary::node, {.says = "Index of its node, usable as camera.node."}),
              field("name", &CameraSummary::name, {.says = "Its node's name, or its own."}),
              field("type", &CameraSummary::type, {.says = "perspective or orthographic."}));
static_assert(kRowsAreComplete<CameraSummary>);

template <>
inline constexpr auto kRows<LightSummary> = replyRows(
    "LightSummary", "A light of the scene.", field("node", &LightSummary::node, {.says = "Index of its node."}),
    field("name", &LightSummary::name, {.says = "Its node's name, or its own."}),
    field("type", &LightSummary::type, {.says = "directional, spot or point."}));
static_assert(kRowsAreComplete<LightSummary>);

template <>
inline constexpr auto kRows<SceneSummary> = replyRows(
    "SceneSummary", "What an uploaded scene holds; counts are of its default glTF scene.",
    field("id", &SceneSummary::id, {.says = "SHA-256 of the upload, 64 lower-case hexadecimal digits."}),
    field("bytes", &SceneSummary::bytes, {.says = "Size of the upload.", .unit = "bytes"}),
    field("memoryBytes", &SceneSummary::memoryBytes, {.says = "Size of the loaded scene.", .unit = "bytes"}),
    field("scenes", &SceneSummary::scenes, {.says = "Scenes in the file."}),
    field("defaultScene", &SceneSummary::defaultScene, {.says = "Index of the scene that is drawn by default."}),
    field("nodes", &SceneSummary::nodes, {.says = "Nodes."}),
    field("meshes", &SceneSummary::meshes, {.says = "Meshes."}),
    field("materials", &SceneSummary::materials, {.says = "Materials."}),
    field("images", &SceneSummary::images, {.says = "Images."}),
    field("triangles", &SceneSummary::triangles, {.says = "Triangles, those of reused meshes counted each time."}),
    field("vertices", &SceneSummary::vertices, {.says = "Vertices."}),
    field("animations", &SceneSummary::animations, {.says = "Animations."}),
    field("boundsMin", &SceneSummary::boundsMin, {.says = "Lower corner of the scene's box.", .unit = "metres"}),
    field("boundsMax", &SceneSummary::boundsMax, {.says = "Upper corner of the scene's box.", .unit = "metres"}),
    field("cameras", &SceneSummary::cameras, {.says = "Its cameras."}),
    field("lights", &SceneSummary::lights, {.says = "Its lights."}),
    field("extensionsUsed", &SceneSummary::extensionsUsed, {.says = "glTF extensions that the file names."}),
    field("warnings", &SceneSummary::warnings,
          {.says = "What the file holds that is drawn without, or drawn differently."}));
static_assert(kRowsAreComplete<SceneSummary>);

template <>
inline constexpr auto kRows<RendererInfo> = rows(
    "RendererInfo", "What the graphics context is and can do.",
    field("backend", &RendererInfo::backend, {.says = "egl or osmesa."}),
    field("platform", &RendererInfo::platform, {.says = "device, surfaceless or osmesa."}),
    field("vendor", &RendererInfo::vendor, {.says = "GL_VENDOR."}),
    field("renderer", &RendererInfo::renderer, {.says = "GL_RENDERER."}),
    field("version", &RendererInfo::version, {.says = "GL_VERSION."}),
    field("software", &RendererInfo::software, {.says = "True = no GPU."}),
    field("maxTextureSize", &RendererInfo::maxTextureSize, {.says = "Largest side of a texture.", .unit = "texels"}),
    field("maxSamples", &RendererInfo::maxSamples, {.says = "Most samples a pixel."}),
    field("fingerprint", &RendererInfo::fingerprint,
          {.says = "Changes whenever the same request could give other bytes."}));
static_assert(kRowsAreComplete<RendererInfo>);

template <>
inline constexpr auto kRows<Limits> = replyRows(
    "Limits", "Every bound that a request or a scene meets.",
    field("maxFrameSide", &Limits::maxFrameSide, {.says = "Width or height of a frame.", .unit = "pixels"}),
    field("maxFramePixels", &Limits::maxFramePixels, {.says = "Width times height of a frame.", .unit = "pixels"}),
    field("maxAtlasSide", &Limits::maxAtlasSide,
          {.says = "Side of the shadow atlas; the device may allow less.", .unit = "texels"}),
    field("maxLights", &Limits::maxLights, {.says = "Lights in one frame."}),
    field("maxCascades", &Limits::maxCascades, {.says = "Cascades of one light."}),
    field("maxLayers", &Limits::maxLayers, {.says = "Layers of nodes."}),
    field("maxNodeOptions", &Limits::maxNodeOptions, {.says = "Entries of a frame's `nodes`."}),
    field("maxReceiverGroups", &Limits::maxReceiverGroups,
          {.says = "Different pairs of `layers` and `receiveShadow` in one frame."}),
    field("maxSpecBytes", &Limits::maxSpecBytes, {.says = "A frame's specification.", .unit = "bytes"}),
    field("maxSceneBytes", &Limits::maxSceneBytes,
          {.says = "An upload: the model and every file that it names.", .unit = "bytes"}),
    field("maxBundleFiles", &Limits::maxBundleFiles, {.says = "Files in one upload."}),
    field("maxJsonDepth", &Limits::maxJsonDepth, {.says = "Nested objects and arrays."}),
    field("maxJsonValues", &Limits::maxJsonValues, {.says = "Values in a glTF's JSON."}),
    field("maxNodes", &Limits::maxNodes, {.says = "Nodes of a scene."}),
    field("maxInstances", &Limits::maxInstances, {.says = "Nodes and primitives placed, over all scenes of a file."}),
    field("maxTriangles", &Limits::maxTriangles, {.says = "Triangles of a scene, reused meshes counted each time."}),
    field("maxVertices", &Limits::maxVertices, {.says = "Vertices over all meshes."}),
    field("maxMaterials", &Limits::maxMaterials, {.says = "Materials of a scene."}),
    field("maxImages", &Limits::maxImages, {.says = "Images of a scene."}),
    field("maxImageSide", &Limits::maxImageSide, {.says = "Width or height of an image.", .unit = "pixels"}),
    field("maxImagePixels", &Limits::maxImagePixels, {.says = "Pixels of all images together.", .unit = "pixels"}));
static_assert(kRowsAreComplete<Limits>);

template <>
inline constexpr auto kRows<ImageReply> = replyRows(
    "ImageReply", "A picture within a JSON reply.",
    field("view", &ImageReply::view, {.says = "What it shows; of an EXR, which holds every view, the first."}),
    field("contentType", &ImageReply::contentType, {.says = "image/png or image/x-exr."}),
    field("data", &ImageReply::data, {.says = "The file in base64 (RFC 4648 section 4)."}));
static_assert(kRowsAreComplete<ImageReply>);

template <>
inline constexpr auto kRows<FrameReply> =
    replyRows("FrameReply", "A frame as JSON.",
              field("report", &FrameReply::report, {.says = "What the rendering gave besides its pictures."}),
              field("images", &FrameReply::images, {.says = "A PNG for each view, or one EXR of them all."}));
static_assert(kRowsAreComplete<FrameReply>);

template <>
inline constexpr auto kRows<SceneList> = replyRows("SceneList", "The scenes that the server has.",
                                                   field("scenes", &SceneList::scenes, {.says = "One summary each."}));
static_assert(kRowsAreComplete<SceneList>);

template <>
inline constexpr auto kRows<Capabilities> =
    replyRows("Capabilities", "What this server can do.",
              field("version", &Capabilities::version, {.says = "Gnomon's own version."}),
              field("renderer", &Capabilities::renderer, {.says = "What the graphics context is and can do."}),
              field("limits", &Capabilities::limits, {.says = "Every bound that a request or a scene meets."}));
static_assert(kRowsAreComplete<Capabilities>);

} // namespace gnomon

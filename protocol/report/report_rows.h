#pragma once

#include "protocol/fields/value_type.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/metric_rows.h"
#include "protocol/spec/field_rows.h"

/// The rows of a frame's and a plan's report; see field_rows.h. StageTime has none: the stages are one JSON object.
namespace gnomon {

/// One object, so that a client can name the stage that it wants. Defined in json_codec.cpp.
bool decodeStages(const JsonNode& node, const Place& place, ProblemList& problems, void* out);
Json encodeStages(const void* stages);
Json stagesSchema();

template <>
inline constexpr CustomType kCustomType<std::vector<StageTime>>{decodeStages, encodeStages, stagesSchema};

template <>
inline constexpr auto kRows<TileReport> = replyRows(
    "TileReport", "One tile: a cascade, or a face of a spot or point light.",
    field("near", &TileReport::near,
          {.says =
               "Where it begins: the view depth of a cascade, or a face's distance from the light along its direction.",
           .unit = "metres"}),
    field("far", &TileReport::far,
          {.says = "Where it ends, in the same unit and along the same axis as `near`.", .unit = "metres"}),
    field("tile", &TileReport::tile,
          {.says = "x, y, width and height in the atlas, from its lower left corner, border included; width 0 = no "
                   "surface in view lies in it, so it is not drawn.",
           .unit = "texels"}),
    field("border", &TileReport::border, {.says = "Width of its border, read by filters only.", .unit = "texels"}),
    field("texelSize", &TileReport::texelSize,
          {.says = "Size of a texel across and along; for a face, at its far end.", .unit = "metres"}),
    field("matrix", &TileReport::matrix,
          {.says =
               "Matrix from world space to the tile's clip space, column by column: x and y -1..1 over the whole tile, "
               "z 0 near the light and 1 far from it, after the division by w; absent if the tile is not drawn."}),
    field("normalOffset", &TileReport::normalOffset,
          {.says = "Distance that a surface is moved along its normal, multiplied by the sine of the angle between "
                   "normal and light; for a face, at its far end. With a manual bias: `depth` times "
                   "`normalOffsetScale`, whatever the angle.",
           .unit = "metres"}),
    field("depthBias", &TileReport::depthBias,
          {.says =
               "Distance that a surface is also moved towards the light, against rounding, as a fraction of the tile's "
               "depth; for a face, at its far end. The `depth` and `slope` of a manual bias are added to it."}),
    field("depthBiasMetres", &TileReport::depthBiasMetres,
          {.says = "`depthBias` as a length along the light.", .unit = "metres"}),
    field("predictedError", &TileReport::predictedError,
          {.says = "How large its texels appear; absent if it is not drawn."}),
    field("casterTriangles", &TileReport::casterTriangles, {.says = "Triangles drawn into this tile."}),
    field("culledTriangles", &TileReport::culledTriangles,
          {.says = "Triangles not drawn, because they can't shadow anything that this tile serves."}),
    field("reused", &TileReport::reused,
          {.says = "True = the tile of an earlier frame is used: nothing was drawn into it for this one, but for "
                   "texels that no frame had read before."}),
    field("drawCalls", &TileReport::drawCalls, {.says = "Draw calls into this tile."}),
    field("cpuMilliseconds", &TileReport::cpuMilliseconds,
          {.says = "CPU time of drawing its casters; for the first tile also of finding all casters and clearing the "
                   "atlas. Absent in a plan and if it was not drawn.",
           .unit = "milliseconds"}),
    field("gpuMilliseconds", &TileReport::gpuMilliseconds,
          {.says = "The same on the device, as the driver reports it; also absent if the driver has no timer.",
           .unit = "milliseconds"}));
static_assert(kRowsAreComplete<TileReport>);

template <>
inline constexpr auto kRows<LightMapReport> = replyRows(
    "LightMapReport", "The texture that technique lightMap looks a shadow up in.",
    field("reused", &LightMapReport::reused, {.says = "True = an earlier frame baked it; false = this one did."}),
    field("width", &LightMapReport::width, {.says = "Its width.", .unit = "texels"}),
    field("height", &LightMapReport::height, {.says = "Its height.", .unit = "texels"}),
    field("texelsPerMetre", &LightMapReport::texelsPerMetre, {.says = "How finely it shows the scene's surfaces."}),
    field("charts", &LightMapReport::charts, {.says = "Pieces that the surfaces were cut into."}),
    field("authoredInstances", &LightMapReport::authoredInstances,
          {.says = "Placed meshes whose TEXCOORD_1 is used: its pieces neither overlap nor leave 0..1."}),
    field("madeInstances", &LightMapReport::madeInstances, {.says = "Placed meshes whose pieces were found here."}),
    field("bytes", &LightMapReport::bytes, {.says = "Memory that it takes.", .unit = "bytes"}),
    field("bakeMilliseconds", &LightMapReport::bakeMilliseconds,
          {.says = "Time that baking took when it was baked.", .unit = "milliseconds"}));
static_assert(kRowsAreComplete<LightMapReport>);

template <>
inline constexpr auto kRows<VolumeReport> = replyRows(
    "VolumeReport", "A volume, and the light that arrives in it.",
    field("voxels", &VolumeReport::voxels, {.says = "Grid resolution in x, y, z; 0 if its node is hidden."}),
    field("values", &VolumeReport::values, {.says = "Least and greatest value of its grid."}),
    field("reused", &VolumeReport::reused, {.says = "True = an earlier frame made its light; false = this one did."}),
    field("lightSize", &VolumeReport::lightSize, {.says = "Points at which its light is known, along x, y and z."}),
    field("lightBytes", &VolumeReport::lightBytes, {.says = "Memory of these points.", .unit = "bytes"}),
    field("lightMilliseconds", &VolumeReport::lightMilliseconds,
          {.says = "Time that making its light took when it was made.", .unit = "milliseconds"}));
static_assert(kRowsAreComplete<VolumeReport>);

template <>
inline constexpr auto kRows<TechniqueChoice> = replyRows(
    "TechniqueChoice", "What technique auto chose for a light.",
    field("technique", &TechniqueChoice::technique,
          {.says = "shadowMap or rayTraced; `spec` names it too, so that requesting `spec` again draws the same."}),
    field("why", &TechniqueChoice::why, {.says = "The reason, in a sentence."}),
    field("mapMilliseconds", &TechniqueChoice::mapMilliseconds,
          {.says =
               "Estimate for the light's shadow map, from counts of the scene and the request: about what it takes on "
               "two cores. Not a promise for this machine.",
           .unit = "milliseconds"}),
    field("rayMilliseconds", &TechniqueChoice::rayMilliseconds,
          {.says = "The same for rays.", .unit = "milliseconds"}));
static_assert(kRowsAreComplete<TechniqueChoice>);

template <>
inline constexpr auto kRows<LightReport> = replyRows(
    "LightReport", "Decisions for one light.",
    field("light", &LightReport::light, {.says = "Index into the lights of `spec`."}),
    field("shadowed", &LightReport::shadowed, {.says = "True = its shadow was drawn."}),
    field("askedTileSize", &LightReport::askedTileSize,
          {.says = "Side of a tile as requested; 0 = no shadow was requested.", .unit = "texels"}),
    field("grantedTileSize", &LightReport::grantedTileSize,
          {.says = "Side of its tiles in the atlas; 0 = none.", .unit = "texels"}),
    field("note", &LightReport::note,
          {.says = "Why no shadow was drawn, or what differs from the request; empty = nothing."}),
    field("depthRange", &LightReport::depthRange,
          {.says = "View depths that a directional light's cascades cover, without a guard. Pass it as "
                   "`shadow.depthRange.previous` of the next frame. Absent = none was drawn."}),
    field("tiles", &LightReport::tiles,
          {.says = "Its tiles: cascades, nearest first, or faces of a spot or point light."}),
    field("predictedError", &LightReport::predictedError,
          {.says = "How large the texels of its tiles appear; absent if none was drawn."}),
    field("choice", &LightReport::choice,
          {.says = "What technique auto chose; absent where the request names another. The tiles of a light that rays "
                   "were chosen for are planned, and drawn only where a view shows them."}),
    field("tracedPixels", &LightReport::tracedPixels,
          {.says = "Pixels that rays decided; technique rayTraced; absent in a plan.", .unit = "pixels"}),
    field("lightMap", &LightReport::lightMap, {.says = "What was baked; technique lightMap alone; absent in a plan."}),
    field("casterTriangles", &LightReport::casterTriangles, {.says = "Triangles drawn into its tiles."}),
    field("drawCalls", &LightReport::drawCalls, {.says = "Draw calls into its tiles."}),
    field("cpuMilliseconds", &LightReport::cpuMilliseconds,
          {.says = "CPU time of its tiles and rays; absent in a plan and if nothing was drawn.",
           .unit = "milliseconds"}),
    field("gpuMilliseconds", &LightReport::gpuMilliseconds,
          {.says = "Device time of its tiles, as the driver reports it; also absent if the driver has no timer.",
           .unit = "milliseconds"}));
static_assert(kRowsAreComplete<LightReport>);

template <>
inline constexpr auto kRows<PassReport> = replyRows(
    "PassReport", "One pass of a frame.",
    field(
        "pass", &PassReport::pass,
        {.says = "survey (what the camera sees), shadow (all tiles), surfaces (what each sample shows; once for each "
                 "number of samples a pixel that the views need), volumes (clouds and their shadow), visibility (what "
                 "rays and shadow volumes decide), these as often as surfaces, or view."}),
    field("view", &PassReport::view, {.says = "Which view; only for pass view."}),
    field("cpuMilliseconds", &PassReport::cpuMilliseconds,
          {.says = "CPU time from its first call to its last, whether the device has finished or not.",
           .unit = "milliseconds"}),
    field("gpuMilliseconds", &PassReport::gpuMilliseconds,
          {.says =
               "Time between its beginning and end on the device, as the driver reports it; a software driver reports "
               "the CPU's clock, which includes what other passes left to do. Absent if the driver has no timer.",
           .unit = "milliseconds"}),
    field("drawCalls", &PassReport::drawCalls, {.says = "Draw calls."}),
    field("triangles", &PassReport::triangles, {.says = "Triangles drawn."}));
static_assert(kRowsAreComplete<PassReport>);

template <>
inline constexpr auto kRows<MemoryReport> =
    replyRows("MemoryReport", "Memory of a frame on the device; padding by the driver is not counted.",
              field("scene", &MemoryReport::scene,
                    {.says = "Geometry, materials and textures, kept between frames.", .unit = "bytes"}),
              field("atlas", &MemoryReport::atlas, {.says = "The shadow atlas.", .unit = "bytes"}),
              field("targets", &MemoryReport::targets,
                    {.says = "Depth, surfaces, visibility and views of this frame.", .unit = "bytes"}));
static_assert(kRowsAreComplete<MemoryReport>);

template <>
inline constexpr auto kRows<FrameCounts> =
    replyRows("FrameCounts", "How much was drawn.",
              field("sceneTriangles", &FrameCounts::sceneTriangles, {.says = "Triangles in the chosen glTF scene."}),
              field("surveyedTriangles", &FrameCounts::surveyedTriangles,
                    {.says = "Triangles drawn by the survey: those inside the view."}),
              field("shadedTriangles", &FrameCounts::shadedTriangles,
                    {.says = "Triangles drawn for shading: those of clusters that the survey saw."}),
              field("casterTriangles", &FrameCounts::casterTriangles, {.says = "Triangles drawn into all tiles."}),
              field("drawCalls", &FrameCounts::drawCalls, {.says = "Draw calls of the whole frame."}));
static_assert(kRowsAreComplete<FrameCounts>);

template <>
inline constexpr auto kRows<FrameReport> = rows(
    "FrameReport", "Decisions, times and counts of a rendered frame.",
    field(
        "spec", &FrameReport::spec,
        {.says = "The effective request: every default filled in. Sent as a request, it gives the same frame again."}),
    field("depthRange", &FrameReport::depthRange,
          {.says = "Nearest and farthest surface in view; 0 0 = nothing in view.", .unit = "metres"}),
    field("atlasSize", &FrameReport::atlasSize,
          {.says = "Width and height of the atlas; 0 0 = no atlas.", .unit = "texels"}),
    field("lights", &FrameReport::lights, {.says = "Decisions for each light."}),
    field("volumes", &FrameReport::volumes, {.says = "Grid and light of each volume."}),
    field("predictedError", &FrameReport::predictedError,
          {.says = "How large the texels of all tiles appear; absent if no tile was drawn."}),
    field("error", &FrameReport::error,
          {.says = "The shadow of `debug.light` compared with rays; only with view reference, error or edgeDistance."}),
    field("quality", &FrameReport::quality, {.says = "How the target was met; only if the request names one."}),
    field("counts", &FrameReport::counts, {.says = "How much was drawn."}),
    field("memory", &FrameReport::memory, {.says = "Memory on the device."}),
    field("passes", &FrameReport::passes, {.says = "Times and counts of each pass, in the order of drawing."}),
    field("stages", &FrameReport::stages,
          {.says = "Time of each stage: queue, load, upload, bake, volume (with `volumes`), survey, plan, shadow, "
                   "shade, predict (with "
                   "`debug.predictEdges`), reference (if a view asks for rays), readback, encode.",
           .unit = "milliseconds"}),
    field(
        "warnings", &FrameReport::warnings,
        {.says = "What differs from the file or the request, and what the picture is likely to lack: each a sentence, "
                 "with what to set."}));
static_assert(kRowsAreComplete<FrameReport>);

template <>
inline constexpr auto kRows<PlanReport> = rows(
    "PlanReport",
    "What a frame would do, decided without drawing it: boxes around what the camera may see replace its "
    "surfaces, so every tile covers what the frame's would, and perhaps more.",
    field(
        "spec", &PlanReport::spec,
        {.says = "The effective request: every default filled in. Sent as a request, it gives the same frame again."}),
    field("depthRange", &PlanReport::depthRange,
          {.says = "Nearest and farthest end of a box in view; 0 0 = nothing in view.", .unit = "metres"}),
    field("atlasSize", &PlanReport::atlasSize,
          {.says = "Width and height that the atlas would have; 0 0 = no atlas.", .unit = "texels"}),
    field("lights", &PlanReport::lights, {.says = "What would be decided for each light, without times."}),
    field("predictedError", &PlanReport::predictedError,
          {.says = "Upper bound of how large the texels of all tiles would appear; absent if no tile would be drawn."}),
    field("warnings", &PlanReport::warnings,
          {.says = "What the frame's report would warn of, as far as it is known without drawing."}));
static_assert(kRowsAreComplete<PlanReport>);

} // namespace gnomon

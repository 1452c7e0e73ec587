#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/metric_rows.h"
#include "protocol/spec/field_rows.h"

/// The rows of a frame's and a plan's report; see field_rows.h. StageTime has none: the stages are one JSON object.
namespace gnomon {

template <>
inline constexpr auto kRows<TileReport> = replyRows(
    "TileReport", "One tile: a cascade, or a face of a spot or point light.",
    field(
        "near", &TileReport::near,
        {.says = "Where it begins: the view depth of a cascade; a face's distance from the light along its direction.",
         .unit = "metres"}),
    field("far", &TileReport::far, {.says = "Where it ends, measured alike.", .unit = "metres"}),
    field("tile", &TileReport::tile,
          {.says = "x, y, width and height in the atlas, from its lower left corner, border included; width 0 = no "
                   "surface in view lies in it, so "
                   "that it is not drawn.",
           .unit = "texels"}),
    field("border", &TileReport::border, {.says = "Of the tile on each side: only filters read it.", .unit = "texels"}),
    field("texelSize", &TileReport::texelSize,
          {.says = "Size of a texel across and along; of a face, at its far end.", .unit = "metres"}),
    field("matrix", &TileReport::matrix,
          {.says = "The tile's clip space from world space, column by column: x and y -1..1 over the whole tile, z 0 "
                   "near the light and 1 far from it, after the division by w; absent where it is not drawn."}),
    field(
        "normalOffset", &TileReport::normalOffset,
        {.says = "How far a surface is moved along its normal, times the sine of the angle between normal and light; "
                 "of a face, at its far end; of a manual bias, `depth` times `normalOffsetScale`, whatever the angle.",
         .unit = "metres"}),
    field("depthBias", &TileReport::depthBias,
          {.says = "How far a surface is moved towards the light besides, for what rounding loses, as a share of the "
                   "tile's depth; of a face, at its far end. A manual bias's `depth` and `slope` come on top."}),
    field("depthBiasMetres", &TileReport::depthBiasMetres, {.says = "The same along the light.", .unit = "metres"}),
    field("predictedError", &TileReport::predictedError,
          {.says = "How large its texels show; absent where it is not drawn."}),
    field("casterTriangles", &TileReport::casterTriangles, {.says = "Triangles drawn into this tile."}),
    field("culledTriangles", &TileReport::culledTriangles,
          {.says = "Triangles not drawn, because they can't shadow anything that this tile serves."}),
    field("reused", &TileReport::reused,
          {.says = "True = an earlier frame's tile serves, and nothing was drawn into it for this one."}),
    field("drawCalls", &TileReport::drawCalls, {.says = "Draw calls into this tile."}),
    field(
        "cpuMilliseconds", &TileReport::cpuMilliseconds,
        {.says =
             "Time to draw its casters, the first tile's to find all casters and clear the atlas, too; absent where it "
             "is not drawn, and in a plan.",
         .unit = "milliseconds"}),
    field("gpuMilliseconds", &TileReport::gpuMilliseconds,
          {.says = "Time that the driver reports for the device; absent where it has no timer, too.",
           .unit = "milliseconds"}));
static_assert(kRowsAreComplete<TileReport>);

template <>
inline constexpr auto kRows<LightReport> = replyRows(
    "LightReport", "What was decided for one light.",
    field("light", &LightReport::light, {.says = "Index into the lights of `spec`."}),
    field("shadowed", &LightReport::shadowed, {.says = "True = its shadow was drawn."}),
    field("askedTileSize", &LightReport::askedTileSize,
          {.says = "Side of a tile that was asked for; 0 = no shadow was.", .unit = "texels"}),
    field("grantedTileSize", &LightReport::grantedTileSize,
          {.says = "Side of a tile that was given; 0 = none.", .unit = "texels"}),
    field("note", &LightReport::note,
          {.says = "Why no shadow was drawn, or what was decided differently; empty = as asked."}),
    field("depthRange", &LightReport::depthRange,
          {.says = "View depths of a directional light's cascades, without a guard: to be handed in as "
                   "`shadow.depthRange.previous` of the next frame; absent = none was drawn."}),
    field("tiles", &LightReport::tiles,
          {.says = "Its cascades, nearest first, or the faces of a spot or point light."}),
    field("predictedError", &LightReport::predictedError,
          {.says = "How large its tiles' texels show; absent = none was drawn."}),
    field("tracedPixels", &LightReport::tracedPixels,
          {.says = "Pixels that rays decided; techniques hybrid and rayTraced; absent in a plan.", .unit = "pixels"}),
    field("casterTriangles", &LightReport::casterTriangles, {.says = "Triangles drawn into its tiles."}),
    field("drawCalls", &LightReport::drawCalls, {.says = "Draw calls into its tiles."}),
    field("cpuMilliseconds", &LightReport::cpuMilliseconds,
          {.says = "Time of its tiles; absent where none is drawn, and in a plan.", .unit = "milliseconds"}),
    field("gpuMilliseconds", &LightReport::gpuMilliseconds,
          {.says = "The same as the driver reports it for the device; absent where it has no timer, too.",
           .unit = "milliseconds"}));
static_assert(kRowsAreComplete<LightReport>);

template <>
inline constexpr auto kRows<PassReport> = replyRows(
    "PassReport", "One pass of a frame.",
    field("pass", &PassReport::pass,
          {.says = "survey (what the camera sees), shadow (all tiles), surfaces (once for each number of samples a "
                   "pixel that the views need), visibility (what rays and shadow volumes tell, alike) or view."}),
    field("view", &PassReport::view, {.says = "Which view; absent for other passes."}),
    field("cpuMilliseconds", &PassReport::cpuMilliseconds,
          {.says = "From its first call to its last, whether the device is done or not.", .unit = "milliseconds"}),
    field("gpuMilliseconds", &PassReport::gpuMilliseconds,
          {.says = "Between its beginning and end on the device, as the driver reports it (a software driver: by the "
                   "processor's clock, other passes' leftovers included); absent where it has no timer.",
           .unit = "milliseconds"}),
    field("drawCalls", &PassReport::drawCalls, {.says = "Draw calls."}),
    field("triangles", &PassReport::triangles, {.says = "Triangles drawn."}));
static_assert(kRowsAreComplete<PassReport>);

template <>
inline constexpr auto kRows<MemoryReport> =
    replyRows("MemoryReport", "What a frame takes on the device; a driver's padding is not counted.",
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
    field("predictedError", &FrameReport::predictedError,
          {.says = "How large the texels of all tiles show; absent = no tile is drawn."}),
    field(
        "error", &FrameReport::error,
        {.says = "The shadow of `debug.light` held against rays; present where a view shows an error or a reference."}),
    field("quality", &FrameReport::quality, {.says = "How the target was met; present where the spec names one."}),
    field("counts", &FrameReport::counts, {.says = "How much was drawn."}),
    field("memory", &FrameReport::memory, {.says = "What it takes on the device."}),
    field("passes", &FrameReport::passes, {.says = "Times and counts of each pass, in the order of drawing."}),
    field("stages", &FrameReport::stages,
          {.says = "Time that each stage took: queue, load, upload, survey, plan, shadow, shade, readback, encode.",
           .unit = "milliseconds"}),
    field("warnings", &FrameReport::warnings, {.says = "What was drawn differently from what was asked."}));
static_assert(kRowsAreComplete<FrameReport>);

template <>
inline constexpr auto kRows<PlanReport> =
    rows("PlanReport",
         "What a frame would do, decided without drawing it: the boxes around what the camera may see stand in for its "
         "surfaces, so that every tile holds what the frame's would, and perhaps more.",
         field("spec", &PlanReport::spec,
               {.says = "The effective specification: every default resolved, so that it can be asked for again."}),
         field("depthRange", &PlanReport::depthRange,
               {.says = "Nearest and farthest end of a box in view; 0 0 = nothing in view.", .unit = "metres"}),
         field("atlasSize", &PlanReport::atlasSize,
               {.says = "Width and height that the atlas would take; 0 0 = no atlas.", .unit = "texels"}),
         field("lights", &PlanReport::lights, {.says = "What would be decided for each light, without times."}),
         field("predictedError", &PlanReport::predictedError,
               {.says = "How large the texels of all tiles would show at most; absent = no tile would be drawn."}),
         field("warnings", &PlanReport::warnings, {.says = "What would be drawn differently from what was asked."}));
static_assert(kRowsAreComplete<PlanReport>);

} // namespace gnomon

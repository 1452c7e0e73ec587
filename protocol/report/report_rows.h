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
    field<&TileReport::near>(
        "Where it begins: the view depth of a cascade, or a face's distance from the light along its direction.",
        {.unit = "metres"}),
    field<&TileReport::far>("Where it ends, in the same unit and along the same axis as `near`.", {.unit = "metres"}),
    field<&TileReport::tile>("x, y, width and height in the atlas, from its lower left corner, border included; width "
                             "0 = no surface in view lies in it, so it is not drawn.",
                             {.unit = "texels"}),
    field<&TileReport::border>("Width of its border, read by filters only.", {.unit = "texels"}),
    field<&TileReport::texelSize>("Size of a texel across and along; for a face, at its far end.", {.unit = "metres"}),
    field<&TileReport::matrix>(
        "Matrix from world space to the tile's clip space, column by column: x and y -1..1 over the whole tile, z 0 "
        "near the light and 1 far from it, after the division by w; absent if the tile is not drawn."),
    field<&TileReport::normalOffset>(
        "Distance that a surface is moved along its normal, multiplied by the sine of the angle between normal and "
        "light; for a face, at its far end. With a manual bias: `depth` times `normalOffsetScale`, whatever the angle.",
        {.unit = "metres"}),
    field<&TileReport::depthBias>(
        "Distance that a surface is also moved towards the light, against rounding, as a fraction of the tile's depth; "
        "for a face, at its far end. The `depth` and `slope` of a manual bias are added to it."),
    field<&TileReport::depthBiasMetres>("`depthBias` as a length along the light.", {.unit = "metres"}),
    field<&TileReport::predictedError>("How large its texels appear; absent if it is not drawn."),
    field<&TileReport::casterTriangles>("Triangles drawn into this tile."),
    field<&TileReport::culledTriangles>(
        "Triangles not drawn, because they can't shadow anything that this tile serves."),
    field<&TileReport::reused>("True = the tile of an earlier frame is used: nothing was drawn into it for this one, "
                               "but for texels that no frame had read before."),
    field<&TileReport::drawCalls>("Draw calls into this tile."),
    field<&TileReport::cpuMilliseconds>("CPU time of drawing its casters; for the first tile also of finding all "
                                        "casters and clearing the atlas. Absent in a plan and if it was not drawn.",
                                        {.unit = "milliseconds"}),
    field<&TileReport::gpuMilliseconds>(
        "The same on the device, as the driver reports it; also absent if the driver has no timer.",
        {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<LightMapReport> = replyRows(
    "LightMapReport", "The texture that technique lightMap looks a shadow up in.",
    field<&LightMapReport::reused>("True = an earlier frame baked it; false = this one did."),
    field<&LightMapReport::width>("Its width.", {.unit = "texels"}),
    field<&LightMapReport::height>("Its height.", {.unit = "texels"}),
    field<&LightMapReport::texelsPerMetre>("How finely it shows the scene's surfaces."),
    field<&LightMapReport::charts>("Pieces that the surfaces were cut into."),
    field<&LightMapReport::authoredInstances>(
        "Placed meshes whose TEXCOORD_1 is used: its pieces neither overlap nor leave 0..1."),
    field<&LightMapReport::madeInstances>("Placed meshes whose pieces were found here."),
    field<&LightMapReport::bytes>("Memory that it takes.", {.unit = "bytes"}),
    field<&LightMapReport::bakeMilliseconds>("Time that baking took when it was baked.", {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<VolumeReport> =
    replyRows("VolumeReport", "A volume, and the light that arrives in it.",
              field<&VolumeReport::voxels>("Grid resolution in x, y, z; 0 if its node is hidden."),
              field<&VolumeReport::values>("Least and greatest value of its grid."),
              field<&VolumeReport::reused>("True = an earlier frame made its light; false = this one did."),
              field<&VolumeReport::lightSize>("Points at which its light is known, along x, y and z."),
              field<&VolumeReport::lightBytes>("Memory of these points.", {.unit = "bytes"}),
              field<&VolumeReport::lightMilliseconds>("Time that making its light took when it was made.",
                                                      {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<SunReport> = replyRows(
    "SunReport", "The sun of an environment, turned and multiplied as the request says.",
    field<&SunReport::towards>("Direction towards it, of length 1."),
    field<&SunReport::angularDiameterDegrees>("Angle that its disc spans.", {.unit = "degrees"}),
    field<&SunReport::color>("Linear red, green and blue; the largest is 1."),
    field<&SunReport::lux>("Its light on a surface that faces it, as luminance, in the unit of a light's intensity."));

template <>
inline constexpr auto kRows<EnvironmentReport> = replyRows(
    "EnvironmentReport", "What was found in the environment.",
    field<&EnvironmentReport::width>("Width of the file's picture, or of the one that a light's cube was resampled to; "
                                     "0 = a computed sky.",
                                     {.unit = "texels"}),
    field<&EnvironmentReport::height>("Its height; 0 = a computed sky.", {.unit = "texels"}),
    field<&EnvironmentReport::meanRadiance>("Luminance of the file's picture, sun included: the mean over all "
                                            "directions, in its own unit; 0 = a computed sky."),
    field<&EnvironmentReport::sun>(
        "What was taken out of it and is the last of the lights of `spec`; absent = no sun was found or looked for."));

template <>
inline constexpr auto kRows<TechniqueChoice> =
    replyRows("TechniqueChoice", "What technique auto chose for a light.",
              field<&TechniqueChoice::technique>(
                  "shadowMap or rayTraced; `spec` names it too, so that requesting `spec` again draws the same."),
              field<&TechniqueChoice::why>("The reason, in a sentence."),
              field<&TechniqueChoice::mapMilliseconds>(
                  "Estimate for the light's shadow map, from counts of the scene and the request: about what it takes "
                  "on two cores. Not a promise for this machine.",
                  {.unit = "milliseconds"}),
              field<&TechniqueChoice::rayMilliseconds>("The same for rays.", {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<LightReport> = replyRows(
    "LightReport", "Decisions for one light.", field<&LightReport::light>("Index into the lights of `spec`."),
    field<&LightReport::shadowed>("True = its shadow was drawn."),
    field<&LightReport::askedTileSize>("Side of a tile as requested; 0 = no shadow was requested.", {.unit = "texels"}),
    field<&LightReport::grantedTileSize>("Side of its tiles in the atlas; 0 = none.", {.unit = "texels"}),
    field<&LightReport::note>("Why no shadow was drawn, or what differs from the request; empty = nothing."),
    field<&LightReport::depthRange>("View depths that a directional light's cascades cover, without a guard. Pass it "
                                    "as `shadow.depthRange.previous` of the next frame. Absent = none was drawn."),
    field<&LightReport::tiles>("Its tiles: cascades, nearest first, or faces of a spot or point light."),
    field<&LightReport::predictedError>("How large the texels of its tiles appear; absent if none was drawn."),
    field<&LightReport::choice>("What technique auto chose; absent where the request names another. The tiles of a "
                                "light that rays were chosen for are planned, and drawn only where a view shows them."),
    field<&LightReport::tracedPixels>("Pixels that rays decided; technique rayTraced; absent in a plan.",
                                      {.unit = "pixels"}),
    field<&LightReport::lightMap>("What was baked; technique lightMap alone; absent in a plan."),
    field<&LightReport::casterTriangles>("Triangles drawn into its tiles."),
    field<&LightReport::drawCalls>("Draw calls into its tiles."),
    field<&LightReport::cpuMilliseconds>("CPU time of its tiles and rays; absent in a plan and if nothing was drawn.",
                                         {.unit = "milliseconds"}),
    field<&LightReport::gpuMilliseconds>(
        "Device time of its tiles, as the driver reports it; also absent if the driver has no timer.",
        {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<PassReport> = replyRows(
    "PassReport", "One pass of a frame.",
    field<&PassReport::pass>(
        "survey (what the camera sees), shadow (all tiles), surfaces (what each sample shows; once for each number of "
        "samples a pixel that the views need), volumes (clouds and their shadow), sky (rays to the environment), "
        "visibility (what rays and shadow "
        "volumes decide), these as often as surfaces, or view."),
    field<&PassReport::view>("Which view; only for pass view."),
    field<&PassReport::cpuMilliseconds>(
        "CPU time from its first call to its last, whether the device has finished or not.", {.unit = "milliseconds"}),
    field<&PassReport::gpuMilliseconds>(
        "Time between its beginning and end on the device, as the driver reports it; a software driver reports the "
        "CPU's clock, which includes what other passes left to do. Absent if the driver has no timer.",
        {.unit = "milliseconds"}),
    field<&PassReport::drawCalls>("Draw calls."), field<&PassReport::triangles>("Triangles drawn."),
    field<&PassReport::rays>("Rays sent; only for pass sky."));

template <>
inline constexpr auto kRows<MemoryReport> =
    replyRows("MemoryReport", "Memory of a frame on the device; padding by the driver is not counted.",
              field<&MemoryReport::scene>("Geometry, materials and textures, kept between frames.", {.unit = "bytes"}),
              field<&MemoryReport::atlas>("The shadow atlas.", {.unit = "bytes"}),
              field<&MemoryReport::targets>("Depth, surfaces, visibility and views of this frame.", {.unit = "bytes"}));

template <>
inline constexpr auto kRows<FrameCounts> = replyRows(
    "FrameCounts", "How much was drawn.", field<&FrameCounts::sceneTriangles>("Triangles in the chosen glTF scene."),
    field<&FrameCounts::surveyedTriangles>("Triangles drawn by the survey: those inside the view."),
    field<&FrameCounts::shadedTriangles>("Triangles drawn for shading: those of clusters that the survey saw."),
    field<&FrameCounts::casterTriangles>("Triangles drawn into all tiles."),
    field<&FrameCounts::drawCalls>("Draw calls of the whole frame."));

template <>
inline constexpr auto kRows<SunHoursReport> = replyRows(
    "SunHoursReport", "Hours of direct sun, over the pixels that show a surface.",
    field<&SunHoursReport::steps>("Steps by day, each of which sent a ray from every pixel that faced the sun."),
    field<&SunHoursReport::daylightHours>("Hours that these steps count: what a point in the open gets.",
                                          {.unit = "hours"}),
    field<&SunHoursReport::meanHours>("Mean of the pixels.", {.unit = "hours"}),
    field<&SunHoursReport::minHours>("Fewest hours of a pixel.", {.unit = "hours"}),
    field<&SunHoursReport::maxHours>("Most hours of a pixel.", {.unit = "hours"}));

template <>
inline constexpr auto kRows<FrameReport> = rows(
    "FrameReport", "Decisions, times and counts of a rendered frame.",
    field<&FrameReport::spec>(
        "The effective request: every default filled in. Sent as a request, it gives the same frame again."),
    field<&FrameReport::depthRange>("Nearest and farthest surface in view; 0 0 = nothing in view.", {.unit = "metres"}),
    field<&FrameReport::atlasSize>("Width and height of the atlas; 0 0 = no atlas.", {.unit = "texels"}),
    field<&FrameReport::lights>("Decisions for each light."),
    field<&FrameReport::volumes>("Grid and light of each volume."),
    field<&FrameReport::environment>("What was found in the environment; absent = the studio lights the frame."),
    field<&FrameReport::predictedError>("How large the texels of all tiles appear; absent if no tile was drawn."),
    field<&FrameReport::error>(
        "The shadow of `debug.light` compared with rays; only with view reference, error or edgeDistance."),
    field<&FrameReport::sunHours>("What view `sunHours` found; only with that view."),
    field<&FrameReport::quality>("How the target was met; only if the request names one."),
    field<&FrameReport::counts>("How much was drawn."), field<&FrameReport::memory>("Memory on the device."),
    field<&FrameReport::passes>("Times and counts of each pass, in the order of drawing."),
    field<&FrameReport::stages>(
        "Time of each stage: queue, load, upload, bake, environment (where that is not the studio), volume "
        "(with `volumes`), survey, plan, shadow, shade, predict "
        "(with `debug.predictEdges`), reference (if a view asks for rays), sunHours (with that view), readback, "
        "encode.",
        {.unit = "milliseconds"}),
    field<&FrameReport::warnings>("What differs from the file or the request, and what the picture is likely to lack: "
                                  "each a sentence, with what to set."));

template <>
inline constexpr auto kRows<PlanReport> = rows(
    "PlanReport",
    "What a frame would do, decided without drawing it: boxes around what the camera may see replace its surfaces, so "
    "every tile covers what the frame's would, and perhaps more.",
    field<&PlanReport::spec>(
        "The effective request: every default filled in. Sent as a request, it gives the same frame again."),
    field<&PlanReport::depthRange>("Nearest and farthest end of a box in view; 0 0 = nothing in view.",
                                   {.unit = "metres"}),
    field<&PlanReport::atlasSize>("Width and height that the atlas would have; 0 0 = no atlas.", {.unit = "texels"}),
    field<&PlanReport::lights>("What would be decided for each light, without times."),
    field<&PlanReport::environment>("What was found in the environment; absent = the studio would light the frame."),
    field<&PlanReport::predictedError>(
        "Upper bound of how large the texels of all tiles would appear; absent if no tile would be drawn."),
    field<&PlanReport::warnings>("What the frame's report would warn of, as far as it is known without drawing."));

} // namespace gnomon

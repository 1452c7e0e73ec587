#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/shadow_options.h"

/// The rows of the shadow options; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<Partition> = rows(
    "Partition", "How the depth range is cut into cascades.",
    field<&Partition::mode>("How split distances are chosen."),
    field<&Partition::pssmFactor>("In mode logarithmic: 0 = purely logarithmic, which gives the foreground the most "
                                  "texels; 1 = uniform. The default is half of each, the usual compromise.",
                                  {.range = kUnitRange}),
    field<&Partition::splits>(
        "In mode manual: far ends of the cascades as fractions of the depth range, one for each cascade, increasing.",
        {.range = {0, 1, true, false}, .maxCount = kLimits.maxCascades}));

template <>
inline constexpr auto kRows<PreviousRange> =
    rows("PreviousRange", "A range that an earlier frame's report gave.",
         field<&PreviousRange::near>("View depth where the range begins.", {.unit = "metres", .range = kPositionRange}),
         field<&PreviousRange::far>("View depth where the range ends, more than `near`.",
                                    {.unit = "metres", .range = kPositionRange}));

template <>
inline constexpr auto kRows<DepthRange> = rows(
    "DepthRange", "The depths that the cascades cover.",
    field<&DepthRange::mode>("Whether the range is computed or given. Computed is tightest, so shadows are sharpest."),
    field<&DepthRange::min>("In mode manual: where shadows begin, measured from the camera's near plane.",
                            {.unit = "metres", .range = {0, 1e9}}),
    field<&DepthRange::max>("In mode manual: where shadows end, measured from the camera's near plane, more than "
                            "`min`. Farther = coarser texels.",
                            {.unit = "metres", .range = kLengthRange}),
    field<&DepthRange::previous>("In mode automatic, for sequences: this light's `depthRange` from the report of the "
                                 "previous frame. It is kept, extended by `guardDistance` at both ends, as long as it "
                                 "covers what is in view; this keeps shadows from crawling."),
    field<&DepthRange::guardDistance>(
        "Added to both ends of `previous`; absent = 1. Larger = the range changes less often and texels are coarser.",
        {.unit = "metres", .range = {0, 1e9}}));

template <>
inline constexpr auto kRows<Filter> = rows(
    "Filter", "How the shadow map is sampled.",
    field<&Filter::type>(
        "How the texels of the map are combined. `hard` is fastest; `pcf` costs time when shading, and `pcss` more: 32 "
        "texels searched and 32 comparisons where a caster is near; the others blur every tile first."),
    field<&Filter::size>("Width of the kernel. Wider is softer and slower, and darkens concave corners farther out. "
                         "Ignored by `hard`, `pcss` and when `radius` is set.",
                         {.unit = "texels", .range = {3, 7}, .choices = choices(3, 5, 7)}),
    field<&Filter::radius>("Radius of the kernel in the world, instead of `size`: the same softness in every cascade. "
                           "Larger is slower; refused with `hard`, and with `pcss`, which takes the light's own size.",
                           {.unit = "metres", .range = kLengthRange}));

template <>
inline constexpr auto kRows<Bias> =
    rows("Bias", "How far a surface is moved before it is compared with the map, so that it does not shadow itself.",
         field<&Bias::mode>("Whether the bias is computed or given."),
         field<&Bias::depth>("In mode manual: distance towards the light; absent = 0. Larger removes acne, and "
                             "detaches shadows from their casters.",
                             {.unit = "metres", .range = kBiasRange}),
         field<&Bias::slope>("In mode manual: distance towards the light, multiplied by the tangent of the angle "
                             "between normal and light; absent = 0.",
                             {.unit = "metres", .range = kBiasRange}),
         field<&Bias::normalOffsetScale>(
             "In mode manual: distance along the surface's normal, as a multiple of `depth`; absent = 0.",
             {.range = kBiasRange}));

template <>
inline constexpr auto kRows<LightMapOptions> = rows(
    "LightMapOptions", "The texture that technique lightMap keeps a light's shadow in.",
    field<&LightMapOptions::size>(
        "Longer side of the texture at most; the scene's surfaces are shown as finely as fits. Doubling it halves the "
        "blur of edges, and takes four times the memory and the time to bake. Ignored when `texelsPerMetre` is set.",
        {.unit = "texels", .range = {16, kLimits.maxLightMapSide}}),
    field<&LightMapOptions::texelsPerMetre>(
        "How finely surfaces are shown, instead of `size`: the texture is as large as that takes.",
        {.range = {1e-6, 1e6}}),
    field<&LightMapOptions::samples>(
        "Rays for each texel towards a light that has a size. Noise falls with the square root of the number, the time "
        "to bake grows with it; frames cost the same. Lights without a size take sixteen.",
        {.unit = "rays", .range = {1, kLimits.maxRaySamples}}));

template <>
inline constexpr auto kRows<Shadow> = rows(
    "Shadow", "The shadow of a light.",
    field<&Shadow::enabled>("False = the light casts no shadow, and takes no place in the atlas."),
    field<&Shadow::technique>(
        "How the shadow is found. Size, cascades, filter, stabilization and bias affect shadow maps only; with auto, a "
        "light that sets a filter or a bias gets a map. The report says what auto chose, and why."),
    field<&Shadow::strength>("0 = no shadow, 1 = no direct light in shadow.", {.range = kUnitRange}),
    field<&Shadow::color>("Linear red, green and blue: the share of its direct light that a full shadow leaves on a "
                          "surface, whatever technique finds it. View `shadow` does not show it.",
                          {.range = kUnitRange}),
    field<&Shadow::size>(
        "Side of one shadow tile (a cascade, or a face of a spot or point light), in steps of two. Each step up halves "
        "the size of a texel, so shadows are sharper, and takes four times the space and fill time. Absent = Large for "
        "directional lights, Medium for spots, Small for point lights, which have up to six tiles."),
    field<&Shadow::importance>("Each step below high halves the tile's side. Tiles of less important lights are also "
                               "the first to shrink when the atlas is full."),
    field<&Shadow::cascadeCount>(
        "Directional lights: number of slices of the view, each with a tile of its own. More keep the foreground sharp "
        "and cost a tile each; 4 suit views to the horizon, 1 suits a single object.",
        {.unit = "cascades", .range = {1, kLimits.maxCascades}}),
    field<&Shadow::partition>("How the depth range is split into cascades."),
    field<&Shadow::depthRange>("The depths that the cascades cover."),
    field<&Shadow::stabilization>("Keeps shadow edges from crawling when the camera moves, at the price of larger "
                                  "texels. Off by default, as a single picture does not need it."),
    field<&Shadow::blendCascades>("True = each cascade fades into the next over its last 20 %, which hides the seam "
                                  "and costs a second lookup there."),
    field<&Shadow::filter>("How the shadow map is filtered."),
    field<&Shadow::bias>("How surfaces are kept from shadowing themselves."),
    field<&Shadow::blendedCasters>("How materials of alphaMode BLEND, and transmissive ones, cast shadows."),
    field<&Shadow::terminator>("Where the triangles of a curved surface turn away from the light: what a shadow is "
                               "found for there. Techniques shadowVolume and lightMap always take the triangles."),
    field<&Shadow::lightMap>(
        "Technique lightMap: how finely the shadow is baked into a texture of the scene's surfaces."),
    field<&Shadow::raySamples>("Technique rayTraced: most rays for each pixel towards a light that has a size. Only "
                               "penumbras take so many; where a pixel and its neighbours agree, one ray does, or 4 "
                               "beside materials with alpha. Lights without a size take one ray.",
                               {.unit = "rays", .range = {1, kLimits.maxRaySamples}}));

template <>
inline constexpr auto kRows<Atlas> =
    rows("Atlas", "The one depth texture that holds every tile.",
         field<&Atlas::size>("Largest side of the atlas; it takes no more than its tiles need. A smaller limit saves "
                             "memory and shrinks tiles when it is full. The device may allow less.",
                             {.unit = "texels", .range = {128, kLimits.maxAtlasSide}, .choices = kTexelSides}),
         field<&Atlas::baseSize>("Side of a tile of size Large, at most `size`. Doubling it halves the size of every "
                                 "shadow texel, at four times the memory and fill time.",
                                 {.unit = "texels", .range = {128, kLimits.maxAtlasSide}, .choices = kTexelSides}),
         field<&Atlas::samples>("Depths in each texel, each compared by itself. 4 smooths edges within a texel at four "
                                "times the memory; the device must support it.",
                                {.range = {1, 4}, .choices = choices(1, 4)}));

} // namespace gnomon

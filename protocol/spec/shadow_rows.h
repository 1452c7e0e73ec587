#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/shadow_options.h"

/// The rows of the shadow options; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<Partition> =
    rows("Partition", "How the depth range is cut into cascades.",
         field("mode", &Partition::mode, {.says = "Where the cuts lie."}),
         field("pssmFactor", &Partition::pssmFactor,
               {.says = "In mode logarithmic: 0 = purely logarithmic, 1 = uniform.", .range = kUnitRange}),
         field("splits", &Partition::splits,
               {.says = "In mode manual: the cascades' far ends as shares of the depth range, one for each cascade, "
                        "increasing.",
                .range = {0, 1, true, false},
                .maxCount = kLimits.maxCascades}));
static_assert(kRowsAreComplete<Partition>);

template <>
inline constexpr auto kRows<PreviousRange> =
    rows("PreviousRange", "A range that an earlier frame's report gave.",
         field("near", &PreviousRange::near,
               {.says = "View depth where it begins.", .unit = "metres", .range = kPositionRange}),
         field("far", &PreviousRange::far,
               {.says = "View depth where it ends, more than near.", .unit = "metres", .range = kPositionRange}));
static_assert(kRowsAreComplete<PreviousRange>);

template <>
inline constexpr auto kRows<DepthRange> = rows(
    "DepthRange", "The depths that the cascades cover.", field("mode", &DepthRange::mode, {.says = "Who decides."}),
    field("min", &DepthRange::min,
          {.says = "In mode manual: where shadows begin, from the camera's near plane.",
           .unit = "metres",
           .range = {0, 1e9}}),
    field("max", &DepthRange::max,
          {.says = "In mode manual: where shadows end, from the camera's near plane; more than min.",
           .unit = "metres",
           .range = kLengthRange}),
    field(
        "previous", &DepthRange::previous,
        {.says = "In mode automatic, for sequences: the `depthRange` that the report gave for this light in the frame "
                 "before; kept, with `guardDistance` on both ends, as long as it holds what is seen."}),
    field("guardDistance", &DepthRange::guardDistance,
          {.says = "Added to both ends of `previous`; absent = 1.", .unit = "metres", .range = {0, 1e9}}));
static_assert(kRowsAreComplete<DepthRange>);

template <>
inline constexpr auto kRows<Filter> =
    rows("Filter", "How the shadow map is sampled.", field("type", &Filter::type, {.says = "The kind of filter."}),
         field("size", &Filter::size,
               {.says = "Texels across the kernel; wider is softer and slower; nothing to hard, nor with a radius.",
                .unit = "texels",
                .range = {3, 7},
                .choices = choices(3, 5, 7)}),
         field("radius", &Filter::radius,
               {.says = "Radius of the kernel in the world, instead of `size`: the same softness in every cascade; not "
                        "with hard.",
                .unit = "metres",
                .range = kLengthRange}));
static_assert(kRowsAreComplete<Filter>);

template <>
inline constexpr auto kRows<Bias> =
    rows("Bias", "How far a surface is moved before it is held against the map, so that it doesn't shadow itself.",
         field("mode", &Bias::mode, {.says = "Who decides."}),
         field("depth", &Bias::depth,
               {.says = "In mode manual: towards the light; absent = 0.", .unit = "metres", .range = kBiasRange}),
         field("slope", &Bias::slope,
               {.says = "In mode manual: towards the light, times the tangent of the angle between normal and light; "
                        "absent = 0.",
                .unit = "metres",
                .range = kBiasRange}),
         field("normalOffsetScale", &Bias::normalOffsetScale,
               {.says = "In mode manual: along the surface's normal, as a multiple of `depth`; absent = 0.",
                .range = kBiasRange}));
static_assert(kRowsAreComplete<Bias>);

template <>
inline constexpr auto kRows<Shadow> = rows(
    "Shadow", "The shadow of a light.",
    field("enabled", &Shadow::enabled, {.says = "False = the light throws no shadow."}),
    field("technique", &Shadow::technique,
          {.says = "How the shadow is found. Sizes, cascades, filter and bias belong to shadow maps."}),
    field("strength", &Shadow::strength,
          {.says = "0 = no shadow, 1 = no direct light in shadow.", .range = kUnitRange}),
    field("size", &Shadow::size,
          {.says = "Side of one tile, of a cascade or of a spot or point light's face; larger is sharper and slower; "
                   "absent = Large for a directional light, Medium for a spot, Small for a point light."}),
    field("importance", &Shadow::importance,
          {.says = "Shrinks the tile, and decides who yields when the atlas is full: the least important first."}),
    field("cascadeCount", &Shadow::cascadeCount,
          {.says = "Directional: slices of the view, each with its own tile; more keep the foreground sharp.",
           .unit = "cascades",
           .range = {1, kLimits.maxCascades}}),
    field("partition", &Shadow::partition, {.says = "How the depth range is cut into cascades."}),
    field("depthRange", &Shadow::depthRange, {.says = "The depths that the cascades cover."}),
    field("stabilization", &Shadow::stabilization,
          {.says = "How shadow edges are kept from crawling when the camera moves; costs sharpness."}),
    field("blendCascades", &Shadow::blendCascades, {.says = "True = cross-fade over the last 20 % of each cascade."}),
    field("filter", &Shadow::filter, {.says = "How the shadow map is sampled."}),
    field("bias", &Shadow::bias, {.says = "How surfaces are kept from shadowing themselves."}),
    field("blendedCasters", &Shadow::blendedCasters, {.says = "How materials of alphaMode BLEND cast."}),
    field("raySamples", &Shadow::raySamples,
          {.says = "Technique rayTraced: rays a pixel towards a light that has a size.",
           .unit = "rays",
           .range = {1, kLimits.maxRaySamples}}));
static_assert(kRowsAreComplete<Shadow>);

template <>
inline constexpr auto kRows<Atlas> =
    rows("Atlas", "The one depth texture that holds every tile.",
         field("size", &Atlas::size,
               {.says = "Side of the atlas at most, a power of two; the device may allow less.",
                .unit = "texels",
                .range = {128, kLimits.maxAtlasSide},
                .choices = kTexelSides}),
         field("baseSize", &Atlas::baseSize,
               {.says = "Side of a tile of size Large, a power of two, at most the atlas.",
                .unit = "texels",
                .range = {128, kLimits.maxAtlasSide},
                .choices = kTexelSides}),
         field("samples", &Atlas::samples,
               {.says = "Depths in each texel, each compared by itself; 4 where the device has such textures.",
                .range = {1, 4},
                .choices = choices(1, 4)}));
static_assert(kRowsAreComplete<Atlas>);

} // namespace gnomon

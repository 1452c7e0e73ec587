#pragma once

#include "protocol/enum_rows.h"
#include "protocol/fields.h"
#include "protocol/ranges.h"
#include "protocol/shadow_options.h"

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
inline constexpr auto kRows<DepthRange> = rows(
    "DepthRange", "The depths that the cascades cover.", field("mode", &DepthRange::mode, {.says = "Who decides."}),
    field("min", &DepthRange::min,
          {.says = "In mode manual: where shadows begin, from the camera's near plane.",
           .unit = "metres",
           .range = {0, 1e9}}),
    field("max", &DepthRange::max,
          {.says = "In mode manual: where shadows end, from the camera's near plane; more than min.",
           .unit = "metres",
           .range = kLengthRange}));
static_assert(kRowsAreComplete<DepthRange>);

template <>
inline constexpr auto kRows<Filter> =
    rows("Filter", "How the shadow map is sampled.", field("type", &Filter::type, {.says = "The kind of filter."}),
         field("size", &Filter::size,
               {.says = "With pcf: texels across the kernel; wider is softer and slower.",
                .unit = "texels",
                .range = {3, 7},
                .choices = choices(3, 5, 7)}));
static_assert(kRowsAreComplete<Filter>);

template <>
inline constexpr auto kRows<Shadow> = rows(
    "Shadow", "The shadow of a light.",
    field("enabled", &Shadow::enabled, {.says = "False = the light throws no shadow."}),
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
    field("filter", &Shadow::filter, {.says = "How the shadow map is sampled."}));
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
                .choices = kTexelSides}));
static_assert(kRowsAreComplete<Atlas>);

} // namespace gnomon

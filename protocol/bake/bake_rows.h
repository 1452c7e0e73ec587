#pragma once

#include "protocol/bake/bake_report.h"
#include "protocol/report/report_rows.h"

/// The rows of a bake's answers; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<BakedLightReport> =
    replyRows("BakedLightReport", "One light's shadow, baked.",
              field("light", &BakedLightReport::light,
                    {.says = "Index into the lights of the request, or of the scene if the request has none."}),
              field("lightMap", &BakedLightReport::lightMap, {.says = "The texture that holds it."}));
static_assert(kRowsAreComplete<BakedLightReport>);

template <>
inline constexpr auto kRows<BakeReport> = replyRows(
    "BakeReport", "Result of baking ahead.",
    field("key", &BakeReport::key,
          {.says = "Names the bake: SHA-256 of the scene and of every field that a bake depends on."}),
    field("lights", &BakeReport::lights, {.says = "The lights of technique lightMap."}),
    field("milliseconds", &BakeReport::milliseconds, {.says = "Time of the whole bake.", .unit = "milliseconds"}));
static_assert(kRowsAreComplete<BakeReport>);

template <>
inline constexpr auto kRows<BakeStep> =
    replyRows("BakeStep", "Progress of a bake: the data of an event `progress`.",
              field("key", &BakeStep::key, {.says = "Names the bake, also for stopping it."}),
              field("light", &BakeStep::light, {.says = "Index of the light that is baked."}),
              field("share", &BakeStep::share, {.says = "Share of this light's texels that are done, 0..1."}),
              field("done", &BakeStep::done, {.says = "Lights finished."}),
              field("of", &BakeStep::of, {.says = "Number of lights to bake."}));
static_assert(kRowsAreComplete<BakeStep>);

} // namespace gnomon

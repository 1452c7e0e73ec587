#pragma once

#include "protocol/bake/bake.h"
#include "protocol/report/report_rows.h"

/// The rows of a bake's answers; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<BakedLightReport> = replyRows(
    "BakedLightReport", "One light's shadow, baked.",
    field<&BakedLightReport::light>("Index into the lights of the request, or of the scene if the request has none."),
    field<&BakedLightReport::lightMap>("The texture that holds it."));

template <>
inline constexpr auto kRows<BakeReport> = replyRows(
    "BakeReport", "Result of baking ahead.",
    field<&BakeReport::key>("Names the bake: SHA-256 of the scene and of every field that a bake depends on."),
    field<&BakeReport::lights>("The lights of technique lightMap."),
    field<&BakeReport::environment>("With `environment.shadows` rays: the texture that holds what share of the "
                                    "environment's light arrives."),
    field<&BakeReport::milliseconds>("Time of the whole bake.", {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<BakeStep> = replyRows(
    "BakeStep", "Progress of a bake: the data of an event `progress`.",
    field<&BakeStep::key>("Names the bake, also for stopping it."),
    field<&BakeStep::light>("Index of the light that is baked; absent = the environment."),
    field<&BakeStep::share>("Share of its texels that are done, 0..1."), field<&BakeStep::done>("Lights finished."),
    field<&BakeStep::of>("Number of lights to bake, the environment among them."));

} // namespace gnomon

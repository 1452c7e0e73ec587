#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/error_metrics.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/field_rows.h"

/// The rows of error metrics and of what a target led to; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<PredictedError> = replyRows(
    "PredictedError",
    "How large shadow texels appear in the picture: for each block of 8 x 8 pixels, the largest extent of the "
    "texel under the nearest surface in the block, as if that surface faced the light.",
    field("median", &PredictedError::median, {.says = "Half of the blocks have no more.", .unit = "pixels"}),
    field("p95", &PredictedError::p95, {.says = "95 % of the blocks have no more.", .unit = "pixels"}),
    field("max", &PredictedError::max, {.says = "The worst block.", .unit = "pixels"}),
    field("edgeDisplacement", &PredictedError::edgeDisplacement,
          {.says = "Expected mean of the measured `edgeDisplacement`, computed without rays from the shadow's own "
                   "edges, and the texels and bias there; only with `debug.predictEdges`.",
           .unit = "pixels"}),
    field("edgeLength", &PredictedError::edgeLength,
          {.says = "Length of the shadow's edges over which that mean is taken.", .unit = "pixels"}));
static_assert(kRowsAreComplete<PredictedError>);

template <>
inline constexpr auto kRows<EdgeDisplacement> = replyRows(
    "EdgeDisplacement", "Distance of the edges of a shadow from the true ones.",
    field("mean", &EdgeDisplacement::mean,
          {.says = "Misclassified area near true edges, divided by the length of these edges.", .unit = "pixels"}),
    field("median", &EdgeDisplacement::median,
          {.says = "Median distance from an edge pixel to the nearest true edge pixel.", .unit = "pixels"}),
    field("p95", &EdgeDisplacement::p95, {.says = "95 % of the edge pixels are no farther.", .unit = "pixels"}),
    field("max", &EdgeDisplacement::max, {.says = "The worst edge pixel.", .unit = "pixels"}));
static_assert(kRowsAreComplete<EdgeDisplacement>);

template <>
inline constexpr auto kRows<ErrorMetrics> = replyRows(
    "ErrorMetrics",
    "A shadow compared with rays, over the receivers: pixels whose surface receives shadows, faces the "
    "light and lies within its reach. Shares are of the receivers, 0..1.",
    field("receivers", &ErrorMetrics::receivers,
          {.says = "Number of receivers, over all lights measured.", .unit = "pixels"}),
    field("misclassified", &ErrorMetrics::misclassified,
          {.says = "Share that the frame and the reference classify differently: lit in one, in shadow in the other."}),
    field("falseShadow", &ErrorMetrics::falseShadow, {.says = "Part of it: in shadow, lit in the reference."}),
    field("falseLit", &ErrorMetrics::falseLit, {.says = "Part of it: lit, in shadow in the reference."}),
    field("acne", &ErrorMetrics::acne,
          {.says = "False shadow farther than 2 pixels from every true edge: a surface shadows itself."}),
    field("leak", &ErrorMetrics::leak,
          {.says = "False light farther than 2 pixels from every true edge, or where the caster is nearer than the "
                   "width of 2 pixels: light leaks through, or a shadow is detached."}),
    field("edge", &ErrorMetrics::edge, {.says = "The other misclassified receivers: an edge in the wrong place."}),
    field("interior", &ErrorMetrics::interior,
          {.says = "Misclassified farther than 2 pixels from every true edge: wrong, not merely coarse."}),
    field("edgeDisplacement", &ErrorMetrics::edgeDisplacement,
          {.says = "Distance of the shadow's edges from the true ones; absent if there are no edges."}),
    field("meanAbsolute", &ErrorMetrics::meanAbsolute, {.says = "Mean of the absolute difference."}),
    field("rms", &ErrorMetrics::rms, {.says = "Root mean square of the difference."}),
    field("shimmer", &ErrorMetrics::shimmer,
          {.says = "Flips for 1,000 points of the world and each frame along a path of cameras, minus those of the "
                   "exact shadow."}),
    field("predicted", &ErrorMetrics::predicted,
          {.says = "The same estimated without rays; absent without shadow maps."}));
static_assert(kRowsAreComplete<ErrorMetrics>);

template <>
inline constexpr auto kRows<QualityTrial> =
    replyRows("QualityTrial", "Settings that were measured for a target, and what they reached.",
              field("settings", &QualityTrial::settings, {.says = "Short name of the settings."}),
              field("shadow", &QualityTrial::shadow, {.says = "Shadow options for every light that casts."}),
              field("atlas", &QualityTrial::atlas, {.says = "The atlas used with them."}),
              field("milliseconds", &QualityTrial::milliseconds,
                    {.says = "Median time of a whole warm frame, without encoding.", .unit = "milliseconds"}),
              field("error", &QualityTrial::error, {.says = "Share of misclassified receivers."}));
static_assert(kRowsAreComplete<QualityTrial>);

template <>
inline constexpr auto kRows<QualityReport> = replyRows(
    "QualityReport", "How a target was met.",
    field("met", &QualityReport::met, {.says = "False = no settings reach the target, and the best ones were chosen."}),
    field("cached", &QualityReport::cached,
          {.says = "True = the choice of an earlier frame of this scene and kind of view; nothing was measured for "
                   "this one."}),
    field("chosen", &QualityReport::chosen, {.says = "Index into `tried`."}),
    field("tried", &QualityReport::tried, {.says = "The settings that were measured, with what they reached."}));
static_assert(kRowsAreComplete<QualityReport>);

} // namespace gnomon

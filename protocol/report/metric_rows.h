#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/error_metrics.h"
#include "protocol/spec/field_rows.h"
#include "protocol/spec/quality.h"

/// The rows of error metrics and of what a target led to; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<PredictedError> = replyRows(
    "PredictedError",
    "How large shadow texels show in the picture: over its blocks of 8 x 8 pixels, the largest extent of the "
    "texel under the nearest surface in the block, as if that faced the light.",
    field("median", &PredictedError::median, {.says = "Half of the blocks have no more.", .unit = "pixels"}),
    field("p95", &PredictedError::p95, {.says = "95 % of the blocks have no more.", .unit = "pixels"}),
    field("max", &PredictedError::max, {.says = "Of the worst block.", .unit = "pixels"}),
    field("edgeDisplacement", &PredictedError::edgeDisplacement,
          {.says = "What the mean of `edgeDisplacement` is expected to be, from the shadow's own edges, the "
                   "texels and the bias under them; only where the view `shadow` is drawn as EXR, or an error "
                   "view.",
           .unit = "pixels"}),
    field("edgeLength", &PredictedError::edgeLength,
          {.says = "Of the shadow's edges that it is the mean of.", .unit = "pixels"}));
static_assert(kRowsAreComplete<PredictedError>);

template <>
inline constexpr auto kRows<EdgeDisplacement> =
    replyRows("EdgeDisplacement", "How far the edges of a shadow lie from the true ones.",
              field("mean", &EdgeDisplacement::mean,
                    {.says = "The misclassified area near true edges, divided by their length.", .unit = "pixels"}),
              field("median", &EdgeDisplacement::median,
                    {.says = "From an edge pixel to the nearest true edge pixel.", .unit = "pixels"}),
              field("p95", &EdgeDisplacement::p95, {.says = "95 % of the edge pixels have no more.", .unit = "pixels"}),
              field("max", &EdgeDisplacement::max, {.says = "Of the worst edge pixel.", .unit = "pixels"}));
static_assert(kRowsAreComplete<EdgeDisplacement>);

template <>
inline constexpr auto kRows<ErrorMetrics> = replyRows(
    "ErrorMetrics",
    "A shadow held against rays, over the receivers: pixels whose surface receives shadows, faces the "
    "light and lies within its reach. Shares are of the receivers, 0..1.",
    field("receivers", &ErrorMetrics::receivers, {.says = "Over all lights that were measured.", .unit = "pixels"}),
    field("misclassified", &ErrorMetrics::misclassified, {.says = "Shadow where light is, or light where shadow is."}),
    field("falseShadow", &ErrorMetrics::falseShadow, {.says = "Of these: shadow where light is."}),
    field("falseLit", &ErrorMetrics::falseLit, {.says = "Of these: light where shadow is."}),
    field("acne", &ErrorMetrics::acne, {.says = "False shadow farther than 2 pixels from every true edge."}),
    field(
        "leak", &ErrorMetrics::leak,
        {.says = "False light farther than that, or where what hides the light is nearer than the width of 2 pixels."}),
    field("edge", &ErrorMetrics::edge, {.says = "The other misclassified ones: an edge in the wrong place."}),
    field("interior", &ErrorMetrics::interior, {.says = "Misclassified farther than 2 pixels from every true edge."}),
    field("edgeDisplacement", &ErrorMetrics::edgeDisplacement,
          {.says = "How far edges are off; absent where there are none."}),
    field("meanAbsolute", &ErrorMetrics::meanAbsolute, {.says = "Mean of the absolute difference."}),
    field("rms", &ErrorMetrics::rms, {.says = "Root of the mean of the squared difference."}),
    field("shimmer", &ErrorMetrics::shimmer,
          {.says = "Flips in 1,000 points of the world and a frame along a path of cameras, less the true ones."}),
    field("predicted", &ErrorMetrics::predicted,
          {.says = "What the plan predicts without rays; absent without shadow maps."}));
static_assert(kRowsAreComplete<ErrorMetrics>);

template <>
inline constexpr auto kRows<QualityTrial> =
    replyRows("QualityTrial", "Settings that were tried for a target, and what they reached.",
              field("settings", &QualityTrial::settings, {.says = "A short name."}),
              field("shadow", &QualityTrial::shadow, {.says = "What every light that casts is given."}),
              field("atlas", &QualityTrial::atlas, {.says = "The atlas that goes with it."}),
              field("milliseconds", &QualityTrial::milliseconds,
                    {.says = "Of a whole warm frame, encoding apart: the median.", .unit = "milliseconds"}),
              field("error", &QualityTrial::error, {.says = "Share of misclassified receivers."}));
static_assert(kRowsAreComplete<QualityTrial>);

template <>
inline constexpr auto kRows<QualityReport> = replyRows(
    "QualityReport", "How a target was met.",
    field("met", &QualityReport::met, {.says = "False = nothing reaches it, and the best there is was chosen."}),
    field("cached", &QualityReport::cached,
          {.says = "True = chosen for an earlier frame of this scene and kind of view; nothing was tried anew."}),
    field("chosen", &QualityReport::chosen, {.says = "Index into `tried`."}),
    field("tried", &QualityReport::tried, {.says = "Settings with what they reached."}));
static_assert(kRowsAreComplete<QualityReport>);

} // namespace gnomon

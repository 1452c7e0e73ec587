#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/field_rows.h"

/// The rows of error metrics and of what a target led to; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<PredictedError> =
    replyRows("PredictedError",
              "How large shadow texels appear in the picture: for each block of 8 x 8 pixels, the largest extent of "
              "the texel under the nearest surface in the block, as if that surface faced the light.",
              field<&PredictedError::median>("Half of the blocks have no more.", {.unit = "pixels"}),
              field<&PredictedError::p95>("95 % of the blocks have no more.", {.unit = "pixels"}),
              field<&PredictedError::max>("The worst block.", {.unit = "pixels"}),
              field<&PredictedError::edgeDisplacement>(
                  "Expected mean of the measured `edgeDisplacement`, computed without rays from the shadow's own "
                  "edges, and the texels and bias there; only with `debug.predictEdges`.",
                  {.unit = "pixels"}),
              field<&PredictedError::edgeLength>("Length of the shadow's edges over which that mean is taken.",
                                                 {.unit = "pixels"}));

template <>
inline constexpr auto kRows<EdgeDisplacement> = replyRows(
    "EdgeDisplacement", "Distance of the edges of a shadow from the true ones.",
    field<&EdgeDisplacement::mean>("Misclassified area near true edges, divided by the length of these edges.",
                                   {.unit = "pixels"}),
    field<&EdgeDisplacement::median>("Median distance from an edge pixel to the nearest true edge pixel.",
                                     {.unit = "pixels"}),
    field<&EdgeDisplacement::p95>("95 % of the edge pixels are no farther.", {.unit = "pixels"}),
    field<&EdgeDisplacement::max>("The worst edge pixel.", {.unit = "pixels"}));

template <>
inline constexpr auto kRows<ErrorMetrics> = replyRows(
    "ErrorMetrics",
    "A shadow compared with rays, over the receivers: pixels whose surface receives shadows, faces the light and lies "
    "within its reach. Shares are of the receivers, 0..1.",
    field<&ErrorMetrics::receivers>("Number of receivers, over all lights measured.", {.unit = "pixels"}),
    field<&ErrorMetrics::misclassified>(
        "Share that the frame and the reference classify differently: lit in one, in shadow in the other."),
    field<&ErrorMetrics::falseShadow>("Part of it: in shadow, lit in the reference."),
    field<&ErrorMetrics::falseLit>("Part of it: lit, in shadow in the reference."),
    field<&ErrorMetrics::acne>("False shadow farther than 2 pixels from every true edge: a surface shadows itself."),
    field<&ErrorMetrics::leak>("False light farther than 2 pixels from every true edge, or where the caster is nearer "
                               "than the width of 2 pixels: light leaks through, or a shadow is detached."),
    field<&ErrorMetrics::edge>("The other misclassified receivers: an edge in the wrong place."),
    field<&ErrorMetrics::interior>(
        "Misclassified farther than 2 pixels from every true edge: wrong, not merely coarse."),
    field<&ErrorMetrics::edgeDisplacement>(
        "Distance of the shadow's edges from the true ones; absent if there are no edges."),
    field<&ErrorMetrics::meanAbsolute>("Mean of the absolute difference."),
    field<&ErrorMetrics::rms>("Root mean square of the difference."),
    field<&ErrorMetrics::shimmer>(
        "Flips for 1,000 points of the world and each frame along a path of cameras, minus those of the exact shadow."),
    field<&ErrorMetrics::predicted>("The same estimated without rays; absent without shadow maps."));

template <>
inline constexpr auto kRows<QualityTrial> =
    replyRows("QualityTrial", "Settings that were measured for a target, and what they reached.",
              field<&QualityTrial::settings>("Short name of the settings."),
              field<&QualityTrial::shadow>("Shadow options for every light that casts."),
              field<&QualityTrial::atlas>("The atlas used with them."),
              field<&QualityTrial::milliseconds>("Median time of a whole warm frame, without encoding.",
                                                 {.unit = "milliseconds"}),
              field<&QualityTrial::error>("Share of misclassified receivers."));

template <>
inline constexpr auto kRows<QualityReport> = replyRows(
    "QualityReport", "How a target was met.",
    field<&QualityReport::met>("False = no settings reach the target, and the best ones were chosen. Absent = the "
                               "settings were measured in another view of the same kind, and not in this one."),
    field<&QualityReport::cached>(
        "True = the choice of an earlier frame of this scene and kind of view; nothing was measured for this one."),
    field<&QualityReport::chosen>("Index into `tried`."),
    field<&QualityReport::tried>("The settings that were measured, with what they reached."));

} // namespace gnomon

#pragma once

#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/error_metrics.h"
#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// Rays a pixel towards a light that has a size, at least.
inline constexpr int kReferenceSamples = 256;

/// One light's shadow, and what rays say about it.
struct MeasuredShadow {
  Reference truth;          ///< of that light alone; of none where the frame has no light
  std::vector<float> shown; ///< S: the share of it that the technique lets through, full strength; a value a pixel
  ErrorMetrics errors;      ///< without shimmer and predicted
};

/// Traces light `light` of a frame (-1 = it has none) and holds `shown` against it.
Result<MeasuredShadow> measureShadow(const ResolvedFrame& frame, const TracedScene& traced, int light,
                                     std::vector<float> shown);

} // namespace gnomon

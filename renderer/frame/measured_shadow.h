#pragma once

#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/error_metrics.h"
#include "protocol/spec/output_options.h"
#include "renderer/image/image.h"
#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"

/// Pictures that compare the shadow of debug.light with rays.
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

/// reference: V. error: S - V, 0 where no receiver. edgeDistance: pixels, -1 = no edge, infinity where V has none.
Image errorNumbers(const MeasuredShadow& measured, View view);

/// V as grey, 0 black.
Image referencePicture(const MeasuredShadow& measured);

/// error: false shadow red, false light blue. edgeDistance: the edge pixels of S by their distance, a heat map from 0
/// to 16 pixels. Over `color`, a picture of the same size, in dim grey.
Image errorPicture(const MeasuredShadow& measured, View view, const Image& color);

} // namespace gnomon

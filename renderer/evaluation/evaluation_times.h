#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/evaluation/evaluation_steps.h"

namespace gnomon {

/// What a variant's frames took.
struct VariantTimes {
  double milliseconds = 0;       ///< whole frames: the median
  std::vector<StageTime> stages; ///< medians, each by itself
  std::uint64_t memoryBytes = 0; ///< of the last frame
  Problems problems;             ///< not empty = no figures
};

/// Draws one frame of each variant that is not counted, then `repeats` rounds of one frame each. `indices`: of the
/// variants to draw. A problem where the whole evaluation ends.
Result<std::vector<VariantTimes>> timeVariants(const Evaluation& evaluation, std::span<const std::size_t> indices,
                                               const DrawFrame& draw, EvaluationSteps& steps);

/// Of an even number the mean of the middle two; `values` holds at least one.
double median(std::vector<double> values);

} // namespace gnomon

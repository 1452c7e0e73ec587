#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

inline constexpr std::size_t kMaxTransferPoints = kLimits.maxTransferStops;
inline constexpr double kMaxExtinction = 1e6; ///< per metre

/// What a medium does to light at one place.
struct Matter {
  glm::dvec3 color{0};   ///< the share of each component that is scattered of what is taken away, 0..1
  double extinction = 0; ///< what is taken away, per metre, >= 0

  bool operator==(const Matter&) const = default;
};

struct TransferPoint {
  double value = 0; ///< of the grid
  Matter matter;

  bool operator==(const TransferPoint&) const = default;
};

/// Piecewise linear between its points; the first and last go on beyond them. Values increase.
struct TransferFunction {
  std::vector<TransferPoint> points;

  bool operator==(const TransferFunction&) const = default;
};

/// A function of these points, or all that is wrong with them, as "/INDEX/value", "/INDEX/color/0" or
/// "/INDEX/extinction".
Result<TransferFunction> makeTransferFunction(std::vector<TransferPoint> points);

Matter matterOf(const TransferFunction& function, double value);

/// The largest extinction of any value from `low` to `high`. REQUIRES: low <= high.
double largestExtinction(const TransferFunction& function, double low, double high);

/// The largest extinction of any value.
double largestExtinction(const TransferFunction& function);

} // namespace gnomon

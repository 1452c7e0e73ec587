#include "renderer/shadow/depth_range.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kDefaultMin = 0.0;
constexpr double kDefaultMax = 50.0;

/// A range thinner than this share of its own depth can't be cut into cascades that floats tell apart.
constexpr double kThinnest = 1e-5;

DepthInterval widened(DepthInterval range) {
  const double magnitude = std::max({std::abs(range.near), std::abs(range.far), 1e-6});
  const double missing = kThinnest * magnitude - (range.far - range.near);
  if (missing > 0.0) range.far += missing;
  return range;
}

} // namespace

double depthSlack(const CameraView& view, double depth) {
  const double slack = 1e-5 * std::abs(depth);
  return view.perspective ? slack : slack + 2e-7 * (view.far - view.near);
}

std::optional<DepthInterval> depthRangeOf(const CameraView& view, const ReceiverDepths& receivers,
                                          const DepthRange& options) {
  if (receivers.range.empty()) return std::nullopt;
  if (options.mode == DepthRangeMode::manual) {
    return widened({view.near + options.min.value_or(kDefaultMin), view.near + options.max.value_or(kDefaultMax)});
  }
  const double nearest = receivers.range.nearest;
  const double farthest = receivers.range.farthest;
  return widened({nearest - depthSlack(view, nearest), farthest + depthSlack(view, farthest)});
}

} // namespace gnomon

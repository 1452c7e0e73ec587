#include "renderer/shadow/splits.h"

#include <cmath>
#include <cstddef>

namespace gnomon {
namespace {

constexpr double kBlendShare = 0.2;

/// Where the logarithm begins for a range that reaches the eye or lies behind it, as a share of the range's length.
constexpr double kSubstituteNear = 1e-3;

double logarithmicSplit(const DepthInterval& range, double fraction) {
  const double length = range.far - range.near;
  const double near = range.near > 0.0 ? range.near : kSubstituteNear * length;
  return range.near + near * (std::pow((near + length) / near, fraction) - 1.0);
}

} // namespace

std::vector<double> splitDistances(const Partition& partition, int cascadeCount, const DepthInterval& range) {
  const double length = range.far - range.near;
  std::vector<double> splits{range.near};
  if (partition.mode == PartitionMode::manual) {
    for (const double fraction : partition.splits) {
      splits.push_back(fraction < 1.0 ? range.near + fraction * length : range.far);
    }
    return splits;
  }
  // 1 = uniform, 0 = logarithmic
  const double uniformShare = partition.mode == PartitionMode::uniform ? 1.0 : partition.pssmFactor;
  for (int k = 1; k < cascadeCount; ++k) {
    const double fraction = static_cast<double>(k) / cascadeCount;
    const double uniform = range.near + fraction * length;
    splits.push_back(uniformShare * uniform + (1.0 - uniformShare) * logarithmicSplit(range, fraction));
  }
  splits.push_back(range.far);
  return splits;
}

std::vector<CascadeInterval> cascadeIntervals(const std::vector<double>& splits, bool blendCascades, bool fadeOut) {
  std::vector<CascadeInterval> intervals;
  double near = splits.front();
  for (std::size_t i = 1; i < splits.size(); ++i) {
    const bool last = i + 1 == splits.size();
    const bool fades = last ? fadeOut : blendCascades;
    const double far = splits[i];
    const double blendNear = fades ? far - kBlendShare * (far - splits[i - 1]) : far;
    intervals.push_back({near, far, blendNear});
    near = blendNear;
  }
  return intervals;
}

} // namespace gnomon

#pragma once

#include <vector>

#include "protocol/spec/shadow_options.h"

namespace gnomon {

/// From one view depth to another, metres.
struct DepthInterval {
  double near = 0;
  double far = 0;
};

/// The distances between cascades: n cascades, n + 1 view depths, strictly increasing. The first is range.near; the
/// last is range.far, except in mode manual where the last fraction is less than 1: the rest is uncovered by choice.
/// Manual: range.near + fraction * length, one cascade for each fraction (cascadeCount is not looked at).
/// Logarithmic: Zhang et al., "Parallel-Split Shadow Maps for Large-scale Virtual Environments", 2006, with
/// pssmFactor = 1 - lambda. Where range.near <= 0, which only an orthographic camera gives, the distances are laid out
/// as if the range began at a thousandth of its length.
std::vector<double> splitDistances(const Partition& partition, int cascadeCount, const DepthInterval& range);

/// What one cascade serves.
struct CascadeInterval {
  double near = 0;      ///< view depth from which a pixel may read it: the previous cascade's blend zone included
  double far = 0;       ///< its split
  double blendNear = 0; ///< where it begins to fade into the next, or to lit; = far where it does not fade
};

/// A blend zone is the last 20 % of a cascade's own interval between its splits. The next cascade serves from the
/// beginning of that zone, so that both have texels for every pixel in it. The last cascade fades only on `fadeOut`.
std::vector<CascadeInterval> cascadeIntervals(const std::vector<double>& splits, bool blendCascades, bool fadeOut);

} // namespace gnomon

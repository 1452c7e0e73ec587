#include "renderer/shadow/depth_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "renderer/shadow/shadow_plan.h"

namespace gnomon {
namespace {

constexpr double kDefaultGuard = 1.0;

/// Factors by which the ends of a held range move: a little at a time outwards, so that it is not longer than it need
/// be; inwards only where much is won, so that it does not move to and fro.
constexpr double kOutwards = 1.1;
constexpr double kInwards = 2.0;

/// A range thinner than this share of its own depth can't be cut into cascades that floats distinguish.
constexpr double kThinnest = 1e-5;

/// `view`: depths are measured from its eye, not from the one that was asked for (CameraView::ahead).
DepthInterval widened(const CameraView& view, DepthInterval range) {
  const double magnitude = std::max({std::abs(range.near - view.ahead), std::abs(range.far - view.ahead), 1e-6});
  const double missing = kThinnest * magnitude - (range.far - range.near);
  if (missing > 0.0) range.far += missing;
  return range;
}

/// The least start * factor^n, n >= 0, that is at least `target`. REQUIRES: start > 0, factor > 1.
double steppedUp(double start, double target, double factor) {
  double reached = start;
  if (target > start) reached *= std::pow(factor, std::floor(std::log(target / start) / std::log(factor)));
  while (reached < target) reached *= factor;
  return reached;
}

/// The greatest start / factor^n, n >= 0, that is at most `target`. REQUIRES: start > 0, target > 0, factor > 1.
double steppedDown(double start, double target, double factor) {
  double reached = start;
  if (target < start) reached /= std::pow(factor, std::floor(std::log(start / target) / std::log(factor)));
  while (reached > target) reached /= factor;
  return reached;
}

/// The greatest start * factor^n, n >= 0, that is at most `target`. REQUIRES: 0 < start <= target, factor > 1.
double raisedTo(double start, double target, double factor) {
  const double reached = start * std::pow(factor, std::floor(std::log(target / start) / std::log(factor)));
  return reached > target ? reached / factor : reached;
}

double loweredTo(double start, double target, double factor) {
  const double reached = start / std::pow(factor, std::floor(std::log(start / target) / std::log(factor)));
  return reached < target ? reached * factor : reached;
}

/// With the guard, but no farther than surfaces can lie: between the camera's planes, with room for rounding.
DepthInterval guarded(const CameraView& view, const DepthInterval& base, double guard) {
  const double near = view.near + view.ahead;
  const double far = view.far + view.ahead;
  return {std::max(base.near - guard, near - 3.0 * depthSlack(view, view.near)),
          std::min(base.far + guard, std::isinf(far) ? far : far + 3.0 * depthSlack(view, view.far))};
}

/// REQUIRES: both intervals lie in front of the eye of a perspective view, where what is farther appears smaller.
DepthInterval movedByFactors(const DepthInterval& previous, const DepthInterval& covered,
                             const DepthInterval& surfaces) {
  DepthInterval moved = previous;
  if (surfaces.near < covered.near) {
    moved.near = steppedDown(previous.near, surfaces.near, kOutwards);
  } else if (surfaces.near >= kInwards * previous.near) {
    moved.near = raisedTo(previous.near, surfaces.near, kInwards);
  }
  if (surfaces.far > covered.far) {
    moved.far = steppedUp(previous.far, surfaces.far, kOutwards);
  } else if (kInwards * surfaces.far <= previous.far) {
    moved.far = loweredTo(previous.far, surfaces.far, kInwards);
  }
  return moved;
}

DepthInterval moved(const CameraView& view, const DepthInterval& previous, const DepthInterval& covered,
                    const DepthInterval& surfaces) {
  if (view.perspective && previous.near > 0.0 && surfaces.near > 0.0)
    return movedByFactors(previous, covered, surfaces);
  const bool outside = surfaces.near < covered.near || surfaces.far > covered.far;
  const bool tooLong = kInwards * (surfaces.far - surfaces.near) <= previous.far - previous.near;
  return outside || tooLong ? surfaces : previous;
}

std::string movedNote(const DepthInterval& previous, const DepthInterval& surfaces, bool outside) {
  std::ostringstream text;
  text << "the depth range was planned again: the previous one, " << previous.near << ".." << previous.far << " m, "
       << (outside ? "does not cover" : "is far longer than") << " this frame's " << surfaces.near << ".."
       << surfaces.far << " m";
  return text.str();
}

PlannedRange heldOrMoved(const CameraView& view, const DepthInterval& surfaces, const DepthInterval& previous,
                         double guard) {
  const DepthInterval held = guarded(view, previous, guard);
  const bool outside = surfaces.near < held.near || surfaces.far > held.far;
  DepthInterval base = moved(view, previous, held, surfaces);
  if (!(base.near < base.far)) base = surfaces;
  const DepthInterval covered = guarded(view, base, guard);
  if (!outside && covered.near == held.near && covered.far == held.far) return {previous, held, {}};
  return {base, covered, movedNote(previous, surfaces, outside)};
}

constexpr double kBlendShare = 0.2;

/// Where the logarithm begins for a range that reaches the eye or lies behind it, as a share of the range's length.
constexpr double kSubstituteNear = 1e-3;
/// Where it begins at the nearest, likewise: else most cascades would lie within centimetres of the eye.
constexpr double kLeastNear = 1e-4;

double logarithmicSplit(const DepthInterval& range, double fraction) {
  const double length = range.far - range.near;
  const double near = range.near > 0.0 ? std::max(range.near, kLeastNear * length) : kSubstituteNear * length;
  return range.near + near * (std::pow((near + length) / near, fraction) - 1.0);
}

} // namespace

double depthSlack(const CameraView& view, double depth) {
  const double slack = 1e-5 * std::abs(depth);
  return view.perspective ? slack : slack + 2e-7 * (drawnFar(view) - drawnNear(view));
}

std::optional<PlannedRange> depthRangeOf(const CameraView& view, const ReceiverDepths& receivers,
                                         const DepthRange& options) {
  if (receivers.range.empty()) return std::nullopt;
  const double near = view.near + view.ahead;
  if (options.mode == DepthRangeMode::manual) {
    const DepthInterval asked = widened(view, {near + *options.min, near + *options.max});
    return PlannedRange{asked, asked, {}};
  }
  const double nearest = receivers.range.nearest;
  const double farthest = receivers.range.farthest;
  const DepthInterval surfaces = widened(
      view, {nearest - depthSlack(view, nearest) + view.ahead, farthest + depthSlack(view, farthest) + view.ahead});
  if (!options.previous) return PlannedRange{surfaces, surfaces, {}};
  return heldOrMoved(view, surfaces, {options.previous->near, options.previous->far},
                     options.guardDistance.value_or(kDefaultGuard));
}

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

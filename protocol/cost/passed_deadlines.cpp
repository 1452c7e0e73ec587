#include "protocol/cost/passed_deadlines.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t kMostBounds = 64;
constexpr std::chrono::minutes kBoundHolds{10};
constexpr int kProof = 2; ///< deadlines

bool isNoMore(const FrameCost& cost, const FrameCost& than) {
  return std::equal(cost.parts.begin(), cost.parts.end(), than.parts.begin(),
                    [](double part, double other) { return part <= other; });
}

} // namespace

void PassedDeadlines::passed(const FrameCost& cost, double milliseconds, Clock::time_point now) {
  Bound bound{cost, milliseconds, 1, now};
  const auto same = std::ranges::find(bounds_, cost.parts, [](const Bound& each) { return each.cost.parts; });
  if (same != bounds_.end()) {
    bound.milliseconds = std::max(milliseconds, same->milliseconds);
    if (now - same->last <= kBoundHolds) bound.times += same->times;
    bounds_.erase(same);
  }
  if (bounds_.size() == kMostBounds) bounds_.erase(bounds_.begin());
  bounds_.push_back(bound);
}

void PassedDeadlines::done(const FrameCost& cost, double milliseconds) {
  std::erase_if(bounds_,
                [&](const Bound& bound) { return isNoMore(bound.cost, cost) && milliseconds < bound.milliseconds; });
}

double PassedDeadlines::atLeast(const FrameCost& cost, Clock::time_point now) const {
  double least = 0;
  for (const Bound& bound : bounds_) {
    const bool isKnown = bound.times >= kProof && now - bound.last <= kBoundHolds;
    if (isKnown && isNoMore(bound.cost, cost)) least = std::max(least, bound.milliseconds);
  }
  return least;
}

} // namespace gnomon

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <random>
#include <rapidcheck.h>

#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/shadow_plan.h"
#include "tests/renderer/core/random_view.h"

namespace gnomon {

/// A frame whose survey and lights are drawn at random, and the generator for more choices about it.
struct RandomPlan {
  PlanInput input;
  unsigned seed = 0;
};

inline std::ostream& operator<<(std::ostream& out, const RandomPlan& plan) {
  out << RandomView{plan.input.view} << "\n  frame " << plan.input.frameWidth << " x " << plan.input.frameHeight
      << " range " << plan.input.receivers.range.nearest << " .. " << plan.input.receivers.range.farthest << " seed "
      << plan.seed;
  for (const ShadowCaster& caster : plan.input.casters) {
    out << "\n  light " << caster.light << " direction " << caster.direction.x << ' ' << caster.direction.y << ' '
        << caster.direction.z << " size " << static_cast<int>(*caster.shadow.size) << " count "
        << caster.shadow.cascadeCount << " partition " << static_cast<int>(caster.shadow.partition.mode)
        << (caster.shadow.depthRange.mode == DepthRangeMode::manual ? " manual range" : " automatic range")
        << " stabilization " << static_cast<int>(caster.shadow.stabilization) << " filter " << caster.shadow.filter.size
        << " radius " << caster.shadow.filter.radius.value_or(0);
  }
  return out;
}

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * std::generate_canonical<double, 53>(engine_); }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  bool chance(double share) { return between(0, 1) < share; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
      const double length = glm::length(v);
      if (length > 0.1 && length < 1.0) return v / length;
    }
  }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

/// Spans anywhere between `nearest` and `farthest`, some blocks empty.
inline ReceiverDepths randomReceivers(Dice& dice, int width, int height, double nearest, double farthest) {
  ReceiverDepths receivers;
  receivers.width = width;
  receivers.height = height;
  receivers.columns = (width + receivers.blockSize - 1) / receivers.blockSize;
  receivers.rows = (height + receivers.blockSize - 1) / receivers.blockSize;
  const double emptyShare = dice.between(0, 0.9);
  const double spread = dice.between(0, 1);
  for (int i = 0; i < receivers.columns * receivers.rows; ++i) {
    DepthSpan span;
    if (!dice.chance(emptyShare)) {
      const double share = dice.between(0, 1) * dice.between(0, 1);
      span.nearest = static_cast<float>(nearest + share * (farthest - nearest));
      span.farthest = dice.chance(0.5)
                          ? span.nearest
                          : static_cast<float>(span.nearest + spread * dice.between(0, 1) * (farthest - span.nearest));
      span.farthest = std::max(span.nearest, span.farthest);
      DepthSpan& range = receivers.range;
      range = range.empty() ? span
                            : DepthSpan{std::min(range.nearest, span.nearest), std::max(range.farthest, span.farthest)};
    }
    receivers.blocks.push_back(span);
  }
  return receivers;
}

inline Shadow randomShadow(Dice& dice) {
  Shadow shadow;
  shadow.size = static_cast<ShadowSize>(dice.below(5));
  shadow.importance = static_cast<ShadowImportance>(dice.below(3));
  shadow.cascadeCount = 1 + dice.below(8);
  shadow.partition.mode = static_cast<PartitionMode>(dice.below(3));
  shadow.partition.pssmFactor = dice.between(0, 1);
  if (shadow.partition.mode == PartitionMode::manual) {
    for (int i = 1; i <= shadow.cascadeCount; ++i) {
      const double low = (i - 0.8) / shadow.cascadeCount;
      shadow.partition.splits.push_back(i == shadow.cascadeCount && dice.chance(0.7)
                                            ? 1.0
                                            : dice.between(low, static_cast<double>(i) / shadow.cascadeCount));
    }
  }
  if (dice.chance(0.4)) {
    shadow.depthRange.mode = DepthRangeMode::manual;
    shadow.depthRange.min = dice.chance(0.3) ? 0.0 : dice.between(0, 20);
    shadow.depthRange.max = *shadow.depthRange.min + dice.between(0.1, 300);
  }
  if (shadow.depthRange.mode == DepthRangeMode::automatic && dice.chance(0.4)) {
    const double near = dice.between(-5, 100);
    shadow.depthRange.previous = PreviousRange{near, near + dice.between(0.1, 500)};
    if (dice.chance(0.7)) shadow.depthRange.guardDistance = dice.between(0, 20);
  }
  shadow.stabilization = static_cast<Stabilization>(dice.below(3));
  shadow.blendCascades = dice.chance(0.7);
  shadow.filter.type = dice.chance(0.5) ? FilterType::pcf : static_cast<FilterType>(dice.below(6));
  if (shadow.filter.type != FilterType::hard && shadow.filter.type != FilterType::pcss && dice.chance(0.3))
    shadow.filter.radius = dice.between(0.01, 3);
  shadow.filter.size = 3 + 2 * dice.below(3);
  return shadow;
}

inline glm::dvec3 randomLightDirection(Dice& dice) {
  switch (dice.below(6)) {
    case 0:
      return {0, -1, 0};
    case 1:
      return {0, 1, 0};
    case 2:
      return glm::normalize(glm::dvec3(dice.between(-1, 1) * 1e-6, -1, dice.between(-1, 1) * 1e-6));
    default:
      return dice.direction();
  }
}

inline RandomPlan randomPlan(const CameraView& view, unsigned seed) {
  Dice dice(seed);
  RandomPlan plan;
  plan.seed = seed;
  PlanInput& input = plan.input;
  input.view = view;
  input.frameWidth = 1 + dice.below(300);
  input.frameHeight = 1 + dice.below(200);
  const double farthest = view.near + (std::min(view.far, view.near + 2000.0) - view.near) * dice.between(0.001, 1);
  input.receivers = randomReceivers(dice, input.frameWidth, input.frameHeight, view.near, farthest);
  const double size = dice.between(1, 1000);
  input.sceneBounds.add(view.eye - dice.direction() * size);
  input.sceneBounds.add(view.eye + dice.direction() * size);
  input.atlas.size = 1 << (7 + dice.below(6));
  input.atlas.baseSize = 1 << (7 + dice.below(4));
  const int lights = 1 + dice.below(5);
  for (int i = 0; i < lights; ++i) {
    input.casters.push_back({i * 2, randomLightDirection(dice), randomShadow(dice)});
    input.casters.back().lightRadius = dice.chance(0.2) ? 0.0 : std::pow(10.0, dice.between(-3, 0));
  }
  return plan;
}

} // namespace gnomon

namespace rc {

template <>
struct Arbitrary<gnomon::RandomPlan> {
  static Gen<gnomon::RandomPlan> arbitrary() {
    return gen::map(gen::pair(gen::arbitrary<gnomon::RandomView>(), gen::noShrink(gen::arbitrary<unsigned>())),
                    [](const auto& both) { return gnomon::randomPlan(both.first.view, both.second); });
  }
};

} // namespace rc

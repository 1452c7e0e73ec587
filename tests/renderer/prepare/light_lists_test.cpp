#include <algorithm>
#include <gtest/gtest.h>

#include "renderer/prepare/lit_light.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

constexpr int kWidth = 200; // not a whole number of squares, nor of blocks
constexpr int kHeight = 140;

CameraView anyView(Dice& dice) {
  CameraView view;
  turn(view, dice.between(-3, 3), dice.between(-1.5, 1.5));
  view.perspective = dice.chance(0.7);
  const double half = view.perspective ? dice.between(0.1, 1.5) : dice.between(2, 10);
  view.halfSize = {half * kWidth / kHeight, half};
  view.near = 0.1;
  view.far = 100;
  return view;
}

LitLight anyLight(Dice& dice) {
  LitLight light;
  light.direction = dice.direction();
  light.type = static_cast<LightType>(dice.below(3));
  light.position = dice.direction() * dice.between(0, 20);
  light.range = dice.chance(0.2) ? 0.0 : dice.between(0.5, 8);
  light.innerCone = dice.between(0, 1.4);
  light.outerCone = light.innerCone + dice.between(0.05, 0.1);
  return light;
}

/// Where the light is, and whether any of it arrives (KHR_lights_punctual).
bool arrives(const LitLight& light, const glm::dvec3& point) {
  if (light.type == LightType::directional) return true;
  const glm::dvec3 offset = light.position - point;
  if (light.range > 0 && glm::length(offset) >= light.range) return false;
  if (light.type != LightType::spot) return true;
  return glm::dot(light.direction, -glm::normalize(offset)) > std::cos(light.outerCone);
}

TEST(LightLists, HoldEveryLightThatReachesASurfaceAndNoneTwice) {
  std::size_t listed = 0;
  std::size_t all = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Dice dice(seed);
    const CameraView view = anyView(dice);
    const ReceiverDepths depths = randomReceivers(dice, kWidth, kHeight, 0.5, 20);
    std::vector<LitLight> lights;
    for (int i = 0; i < 30; ++i) lights.push_back(anyLight(dice));
    const auto lists = lightLists(view, depths, lights);
    const int columns = (kWidth + 63) / 64;
    for (int i = 0; i < 2000; ++i) {
      const double x = dice.between(0, kWidth);
      const double y = dice.between(0, kHeight); // from the top
      const DepthSpan& span = depths.blocks[static_cast<std::size_t>(int(y) / 8 * depths.columns + int(x) / 8)];
      if (span.empty()) continue;
      const double depth = dice.between(span.nearest, span.farthest);
      const glm::dvec3 across =
          view.right * (view.halfSize.x * (2 * x / kWidth - 1)) - view.up * (view.halfSize.y * (2 * y / kHeight - 1));
      const glm::dvec3 point = view.forward * depth + across * (view.perspective ? depth : 1.0);
      const auto region = static_cast<std::size_t>(int(y) / 64 * columns + int(x) / 64);
      const auto first = lists.begin() + lists.at(2 * region);
      const auto last = lists.begin() + lists.at(2 * region + 1);
      for (std::uint32_t l = 0; l < lights.size(); ++l) {
        const auto times = std::count(first, last, l);
        ASSERT_LE(times, 1);
        if (arrives(lights[l], point)) {
          ASSERT_EQ(times, 1) << "light " << l << ", seed " << seed;
        }
        listed += static_cast<std::size_t>(times);
        ++all;
      }
    }
  }
  EXPECT_LT(listed, all * 8 / 10) << "and many are left out";
}

TEST(LightLists, ASquareWithoutSurfacesListsNothing) {
  ReceiverDepths empty;
  empty.width = empty.height = 64;
  empty.columns = empty.rows = 8;
  empty.blocks.resize(64);
  Dice dice(1);
  const auto lists = lightLists(anyView(dice), empty, std::vector<LitLight>(7));
  EXPECT_EQ(lists, (std::vector<std::uint32_t>{2, 2}));
}

} // namespace
} // namespace gnomon

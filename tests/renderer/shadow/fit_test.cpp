#include "renderer/shadow/fit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shadow/tile_size.h"
#include "tests/renderer/shadow/plan_lookup.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

std::vector<glm::dvec3> corners(const CameraView& view, const DepthInterval& depths) {
  std::vector<glm::dvec3> result;
  for (const double depth : {depths.near, depths.far}) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) result.push_back(pointAt(view, {x, y}, depth));
    }
  }
  return result;
}

double radiusAround(const glm::dvec3& center, const std::vector<glm::dvec3>& points) {
  double radius = 0;
  for (const glm::dvec3& point : points) radius = std::max(radius, glm::length(point - center));
  return radius;
}

TEST(Slice, X24_M17_TheSphereHoldsTheCornersAndNoneOnTheAxisIsSmaller) {
  EXPECT_TRUE(rc::check([](const RandomView& random, unsigned seed) {
    Dice dice(seed);
    const CameraView& view = random.view;
    const double near = view.near + dice.between(0, 10);
    const DepthInterval depths{near, near + dice.between(0.01, 500)};
    const auto points = corners(view, depths);
    const Sphere sphere = sliceSphere(view, depths);
    RC_ASSERT(std::abs(radiusAround(sphere.center, points) - sphere.radius) < 1e-9 * sphere.radius);
    for (int i = 0; i <= 100; ++i) {
      const double depth = depths.near + (depths.far - depths.near) * i / 100.0;
      RC_ASSERT(radiusAround(view.forward * depth, points) > sphere.radius * (1 - 1e-9));
    }
  }));
}

TEST(Slice, X24_ASteppedLensHoldsTheLensAndKeepsItsSizeWhileItZooms) {
  EXPECT_TRUE(rc::check([](const RandomView& random) {
    const CameraView stepped = steppedLens(random.view);
    const glm::dvec2 low = random.view.center - random.view.halfSize;
    const glm::dvec2 high = random.view.center + random.view.halfSize;
    if (random.view.center == glm::dvec2(0)) {
      const double wider = glm::length(stepped.halfSize) / glm::length(random.view.halfSize);
      RC_ASSERT(wider > 1 - 1e-8 && wider < std::sqrt(2.0) * (1 + 1e-8));
    } else {
      RC_ASSERT(glm::all(glm::lessThanEqual(stepped.center - stepped.halfSize, low)));
      RC_ASSERT(glm::all(glm::greaterThanEqual(stepped.center + stepped.halfSize, high)));
    }
  }));
  CameraView view;
  view.halfSize = {0.647, 0.364};
  const CameraView wide = steppedLens(view);
  for (int i = 0; i < 12; ++i) {
    view.halfSize *= 1.0025;
    const Sphere zoomed = sliceSphere(steppedLens(view), {1, 10});
    EXPECT_EQ(zoomed.radius, sliceSphere(wide, {1, 10}).radius) << i;
    EXPECT_EQ(zoomed.center, sliceSphere(wide, {1, 10}).center) << i;
  }
}

TEST(Slice, ReachIsTheFarthestCorner) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& unit) {
    const DepthInterval depths{random.view.near, random.view.near + 100 * unit.value + 0.1};
    const double farthest = radiusAround(glm::dvec3(0), corners(random.view, depths));
    RC_ASSERT(std::abs(sliceReach(random.view, depths) - farthest) < 1e-9 * farthest);
  }));
}

PlanInput stablePlan(Stabilization mode, const glm::dvec3& eye, double yaw, double pitch) {
  PlanInput input = simplePlan(1, 200);
  input.view.halfSize = {0.8, 0.45};
  input.view.eye = eye;
  turn(input.view, yaw, pitch);
  Shadow& shadow = input.casters[0].shadow;
  shadow.stabilization = mode;
  shadow.depthRange = {DepthRangeMode::manual, 0, 100};
  return input;
}

/// Texel coordinates of a point of the world.
glm::dvec2 texelOf(const ShadowTile& tile, const PlanInput& input, const glm::dvec3& world) {
  return glm::dvec2(tileCoordinates(tile, world - input.view.eye));
}

void expectMovesByMultiplesOf(int texels, Stabilization mode) {
  EXPECT_TRUE(rc::check([&](unsigned seed) {
    Dice dice(seed);
    const double reach = dice.chance(0.3) ? 1e6 : 100;
    const glm::dvec3 eye = dice.direction() * reach;
    const glm::dvec3 direction = randomLightDirection(dice);
    PlanInput first = stablePlan(mode, eye, dice.between(-3, 3), dice.between(-1.5, 1.5));
    PlanInput second =
        stablePlan(mode, eye + dice.direction() * dice.between(0, 5), dice.between(-3, 3), dice.between(-1.5, 1.5));
    first.casters[0].direction = second.casters[0].direction = direction;
    const ShadowPlan a = planShadows(first);
    const ShadowPlan b = planShadows(second);
    RC_ASSERT(a.tiles.size() == 4u && b.tiles.size() == 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      RC_ASSERT(a.tiles[i].space.fit.texelSize == b.tiles[i].space.fit.texelSize);
      RC_ASSERT(a.tiles[i].space.fit.depthExtent == b.tiles[i].space.fit.depthExtent);
      RC_ASSERT(a.tiles[i].depthBias == b.tiles[i].depthBias);
      RC_ASSERT(a.tiles[i].space.fit.normalOffset == b.tiles[i].space.fit.normalOffset);
      const glm::dvec2 moved =
          texelOf(a.tiles[i], first, eye) - texelOf(b.tiles[i], second, eye); // of one and the same point
      const glm::dvec2 steps = moved / static_cast<double>(texels);
      // Doubles place a point 1e6 m out to 1e-10 m; the least texel here is millimetres.
      RC_ASSERT(std::abs(steps.x - std::round(steps.x)) < 1e-5);
      RC_ASSERT(std::abs(steps.y - std::round(steps.y)) < 1e-5);
    }
  }));
}

TEST(StableFit, X24_ProjectionSnappingMovesByWholeTexelsAndKeepsItsExtents) {
  expectMovesByMultiplesOf(1, Stabilization::projectionSnapping);
}

TEST(StableFit, X24_ViewSnappingMovesByFourTexels) {
  expectMovesByMultiplesOf(4, Stabilization::viewSnapping);
}

TEST(StableFit, X24_HoldsTheWholeSliceHoweverItIsSnapped) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const auto mode = dice.chance(0.5) ? Stabilization::projectionSnapping : Stabilization::viewSnapping;
    PlanInput input = stablePlan(mode, dice.direction() * 50.0, dice.between(-3, 3), dice.between(-1.5, 1.5));
    input.casters[0].direction = dice.direction();
    input.atlas.baseSize = 1 << (7 + dice.below(4));
    const ShadowPlan plan = planShadows(input);
    for (const ShadowTile& tile : plan.tiles) {
      for (int i = 0; i < 50; ++i) {
        const glm::dvec2 ndc(dice.between(-1, 1) > 0 ? 1 : -1, dice.between(-1, 1));
        const glm::dvec3 point = pointAt(input.view, ndc, dice.chance(0.5) ? tile.near : tile.far);
        RC_ASSERT(isServed(tile, point));
        RC_ASSERT(isServed(tile, point + dice.direction() * tile.space.fit.normalOffset));
      }
    }
  }));
}

TEST(TightFit, M16_M18_FillsTheTileOnBothAxes) {
  Aabb box;
  box.add(glm::dvec3(-3, 2, 10));
  box.add(glm::dvec3(5, 3, 40));
  const FitTarget target{1024, kernelOf({FilterType::pcf, 5}), 60, 100};
  const Fit fit = tightFit(box, target);
  const double inner = 1024 - 2 * target.kernel.border;
  EXPECT_NEAR(fit.texelSize.x * inner, 8 + 2 * fit.normalOffset, 1e-12);
  EXPECT_NEAR(fit.texelSize.y * inner, 1 + 2 * fit.normalOffset, 1e-12);
  EXPECT_GT(fit.texelSize.x, 5 * fit.texelSize.y);
  EXPECT_LT(fit.depthNear, 10 - fit.normalOffset);
  EXPECT_GT(fit.depthNear + fit.depthExtent, 40 + fit.normalOffset);
}

TEST(TightFit, IsNeverFinerThanFloatsCanTell) {
  Aabb box;
  box.add(glm::dvec3(1000, 0, 0));
  box.add(glm::dvec3(1000 + 1e-9, 1e-9, 0));
  const Fit fit = tightFit(box, {1024, kernelOf({}), 1000, 2000});
  EXPECT_GT(fit.texelSize.x, 1000 * 0x1p-24);
  EXPECT_LT(fit.texelSize.x, 1000 * 0x1p-15);
}

TEST(TightFit, X4_TheSmallestTileHoldsEveryKernelAndStep) {
  Aabb box;
  box.add(glm::dvec3(-1));
  box.add(glm::dvec3(1));
  for (const int size : {3, 5, 7}) {
    const FitTarget target{kSmallestTile, kernelOf({FilterType::pcf, size}), 5, 10};
    const Fit tight = tightFit(box, target);
    EXPECT_GT(tight.texelSize.x, 0);
    EXPECT_LT(tight.texelSize.x, 0.2);
    const Fit stable = stableFit({glm::dvec3(0), 1}, LightBasis{}, glm::dvec3(0), 4, target);
    EXPECT_GT(stable.texelSize.x, 0);
    EXPECT_LT(stable.texelSize.x, 0.2);
  }
}

} // namespace
} // namespace gnomon

// A depth range that goes from frame to frame.
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {
namespace {

ReceiverDepths surfacesBetween(double nearest, double farthest) {
  ReceiverDepths receivers;
  receivers.range = {static_cast<float>(nearest), static_cast<float>(farthest)};
  return receivers;
}

DepthRange after(const DepthInterval& previous, std::optional<double> guard = std::nullopt) {
  DepthRange options;
  options.previous = PreviousRange{previous.near, previous.far};
  options.guardDistance = guard;
  return options;
}

CameraView viewFrom(double near) {
  CameraView view;
  view.near = near;
  return view;
}

void expectHeld(const PlannedRange& range, double nearest, double farthest) {
  EXPECT_LT(range.covered.near, nearest);
  EXPECT_GT(range.covered.far, farthest);
  EXPECT_LT(range.base.near, range.base.far);
}

TEST(DepthRangeSequence, X20_ThePriorRangeAndItsGuardStillCoverTheMovedCamera) {
  const CameraView view = viewFrom(0.1);
  const PlannedRange first = *depthRangeOf(view, surfacesBetween(5, 40), {});
  for (const double step : {-0.99, -0.5, 0.0, 0.5, 0.99}) {
    const PlannedRange next = *depthRangeOf(view, surfacesBetween(5 + step, 40 + step), after(first.base));
    EXPECT_EQ(next.base.near, first.base.near) << step;
    EXPECT_EQ(next.base.far, first.base.far) << step;
    EXPECT_EQ(next.covered.near, first.base.near - 1);
    EXPECT_EQ(next.covered.far, first.base.far + 1);
    EXPECT_EQ(next.note, "");
    expectHeld(next, 5 + step, 40 + step);
  }
}

TEST(DepthRangeSequence, X20_AFrameThatLeavesTheGuardedRangeIsPlannedAnewAndSaysSo) {
  const PlannedRange next = *depthRangeOf(viewFrom(0.1), surfacesBetween(3.5, 47), after({5, 40}, 2.0));
  EXPECT_DOUBLE_EQ(next.base.near, 5) << "3.5 lies within the guard";
  EXPECT_NEAR(next.base.far, 40 * 1.1 * 1.1, 1e-9);
  EXPECT_NE(next.note.find("planned again"), std::string::npos);
  expectHeld(next, 3.5, 47);
}

TEST(DepthRangeSequence, X19_EndsMoveOutwardsByTenthsAndInwardsByHalves) {
  const CameraView view = viewFrom(0.01);
  EXPECT_NEAR(depthRangeOf(view, surfacesBetween(10, 100.5), after({10, 100}, 0.0))->base.far, 110, 1e-9);
  EXPECT_NEAR(depthRangeOf(view, surfacesBetween(9.9, 100), after({10, 100}, 0.01))->base.near, 10 / 1.1, 1e-9);
  EXPECT_EQ(depthRangeOf(view, surfacesBetween(19, 51), after({10, 100}, 0.0))->base.far, 100) << "not yet half";
  EXPECT_EQ(depthRangeOf(view, surfacesBetween(19, 51), after({10, 100}, 0.0))->base.near, 10) << "not yet twice";
  const PlannedRange shrunk = *depthRangeOf(view, surfacesBetween(21, 24), after({5, 100}, 0.0));
  EXPECT_EQ(shrunk.base.far, 25);
  EXPECT_EQ(shrunk.base.near, 20);
  EXPECT_NE(shrunk.note.find("longer"), std::string::npos);
}

TEST(DepthRangeSequence, X20_TheNearEndStaysInFrontOfAPerspectiveCamera) {
  const CameraView view = viewFrom(0.05);
  const PlannedRange range = *depthRangeOf(view, surfacesBetween(0.3, 8), after({0.3, 9}, 5.0));
  EXPECT_GT(range.covered.near, 0);
  EXPECT_LT(range.covered.near, 0.05);
  EXPECT_GT(depthRangeOf(view, surfacesBetween(0.3, 8), after({-4, 9}))->covered.near, 0);
  EXPECT_GT(depthRangeOf(view, surfacesBetween(0.3, 8), after({-4, -2}))->covered.near, 0);
}

TEST(DepthRangeSequence, X20_ARangeOfAnotherPlaceIsLeft) {
  const CameraView view = viewFrom(0.1);
  for (const DepthInterval previous : {DepthInterval{1e-9, 1e-8}, {1e8, 1e9}, {9.99, 10.01}, {-5, 5}}) {
    const PlannedRange range = *depthRangeOf(view, surfacesBetween(2, 3), after(previous, 0.0));
    expectHeld(range, 2, 3);
    EXPECT_LT(range.base.far, 6.7) << previous.near;
  }
}

/// A camera that walks, turns its head and looks around corners: every frame's surfaces are inside, and the range
/// changes in few of them.
TEST(DepthRangeSequence, X18_X19_X20_AMovingCameraSeesEverySurfaceAndChangesTheRangeSeldom) {
  for (const bool perspective : {true, false}) {
    CameraView view = viewFrom(perspective ? 0.1 : -20.0);
    view.perspective = perspective;
    if (!perspective) view.far = 500;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-1, 1);
    double nearest = 4;
    double farthest = 60;
    DepthRange options;
    int changes = 0;
    DepthInterval last{0, 0};
    constexpr int kFrames = 600;
    for (int frame = 0; frame < kFrames; ++frame) {
      nearest = std::clamp(nearest * (1 + 0.02 * jitter(random)), 0.2, 20.0);
      farthest = std::clamp(farthest * (1 + 0.03 * jitter(random)), 25.0, 400.0);
      if (frame % 150 == 149) farthest = farthest > 150 ? 30 : 300; // around a corner
      const double shift = perspective ? 0 : -12;
      const PlannedRange range = *depthRangeOf(view, surfacesBetween(nearest + shift, farthest + shift), options);
      expectHeld(range, nearest + shift, farthest + shift);
      EXPECT_TRUE(range.covered.near > 0 || !perspective);
      if (range.base.near != last.near || range.base.far != last.far) {
        EXPECT_TRUE(frame == 0 || !range.note.empty());
        ++changes;
      }
      last = range.base;
      options = after(range.base);
    }
    EXPECT_LT(changes, kFrames / 10) << perspective;
    EXPECT_GT(changes, 3) << "the corners at least";
  }
}

} // namespace
} // namespace gnomon

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/prepare/box_depths.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

/// A wall that fills the picture, 10 m before the camera, but for an open block at (column, row).
ReceiverDepths wall(int column, int row) {
  ReceiverDepths depths{8, 64, 64, 8, 8, std::vector<DepthSpan>(64, {10, 10}), {10, 10}};
  depths.blocks[static_cast<std::size_t>(row * 8 + column)] = {};
  return depths;
}

Aabb boxAt(const glm::dvec3& center, double half) {
  return {center - half, center + half};
}

std::uint8_t visible(const CameraView& view, const ReceiverDepths& depths, const Aabb& box) {
  const std::vector<Aabb> boxes{box};
  const std::vector<std::uint8_t> drawn{1};
  return visibleBoxes(view, depths, boxes, drawn)[0];
}

TEST(Occlusion, WhatStandsBehindTheWallIsHidden) {
  const CameraView view;
  EXPECT_EQ(visible(view, wall(0, 0), boxAt({0, 0, -20}, 2)), 0);
  EXPECT_EQ(visible(view, wall(0, 0), boxAt({0, 0, -10}, 1)), 1) << "in the wall";
  EXPECT_EQ(visible(view, wall(0, 0), boxAt({0, 0, -5}, 1)), 1) << "before it";
}

TEST(Occlusion, WhatReachesTheCameraIsNeverHidden) {
  const CameraView view;
  EXPECT_EQ(visible(view, wall(0, 0), boxAt({0, 0, 0}, 30)), 1);
}

TEST(Occlusion, WhatTheSurveyDidNotDrawIsNotLookedAt) {
  const std::vector<Aabb> boxes{boxAt({0, 0, -5}, 1)};
  const std::vector<std::uint8_t> drawn{0};
  EXPECT_EQ(visibleBoxes(CameraView{}, wall(0, 0), boxes, drawn)[0], 0);
}

TEST(Occlusion, ABoxThatIsNotDrawnYetIsHiddenOnlyBehindClosedBlocks) {
  ReceiverDepths closed = wall(0, 0);
  for (DepthSpan& block : closed.blocks) block.open = false;
  const std::vector<Aabb> boxes{boxAt({0, 0, -20}, 2), boxAt({0, 0, -5}, 1)};
  const std::vector<std::uint8_t> wanted{1, 1};
  EXPECT_THAT(unhiddenBoxes(CameraView{}, closed, boxes, wanted), ElementsAre(0, 1));
  closed.blocks[4 * 8 + 4].open = true; // one sample in it shows no surface
  EXPECT_THAT(unhiddenBoxes(CameraView{}, closed, boxes, wanted), ElementsAre(1, 1));
  closed.blocks[4 * 8 + 4] = {}; // nothing in it yet
  EXPECT_THAT(unhiddenBoxes(CameraView{}, closed, boxes, wanted), ElementsAre(1, 1));
}

TEST(Occlusion, NeverHidesABoxWithAPointThatABlockShows) {
  EXPECT_TRUE(rc::check([] {
    CameraView view;
    view.perspective = *rc::gen::arbitrary<bool>();
    if (!view.perspective) view.halfSize = {8, 8};
    const auto unit = [] { return *rc::gen::inRange(-999, 1000) / 1000.0; };
    const glm::dvec2 ndc(unit(), unit());
    const double depth = 1 + 20 * (1 + unit());
    const glm::dvec3 point = pointAt(view, ndc, depth);
    ReceiverDepths depths = wall(0, 0);
    const auto column = static_cast<std::size_t>((ndc.x * 0.5 + 0.5) * 8);
    const auto row = static_cast<std::size_t>((0.5 - ndc.y * 0.5) * 8);
    depths.blocks[row * 8 + column] = {static_cast<float>(depth), static_cast<float>(depth)};
    const glm::dvec3 reach(1 + unit(), 1 + unit(), 1 + unit());
    RC_ASSERT(visible(view, depths, {point - reach, point + reach * 0.5}) == 1);
  }));
}

} // namespace
} // namespace gnomon

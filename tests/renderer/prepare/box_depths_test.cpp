#include "renderer/prepare/box_depths.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/renderer/core/random_view.h"

namespace gnomon {
namespace {

ReceiverDepths depthsOf(const CameraView& view, const std::vector<Aabb>& boxes, int width = 64, int height = 64) {
  return boxDepths(view, width, height, boxes, std::vector<std::uint8_t>(boxes.size(), 1));
}

const DepthSpan& blockAt(const ReceiverDepths& depths, int column, int row) {
  return depths.blocks[static_cast<std::size_t>(row * depths.columns + column)];
}

TEST(BoxDepths, ABoxSpansItsOwnDepthsInItsOwnBlocks) {
  const ReceiverDepths depths = depthsOf(CameraView{}, {Aabb{{-1, -1, -12}, {1, 1, -10}}});
  EXPECT_NEAR(depths.range.nearest, 10, 1e-3);
  EXPECT_NEAR(depths.range.farthest, 12, 1e-3);
  EXPECT_TRUE(blockAt(depths, 0, 0).empty());
  EXPECT_FALSE(blockAt(depths, 4, 4).empty());
  EXPECT_TRUE(blockAt(depths, 4, 4).open) << "a box hides nothing";
}

TEST(BoxDepths, AGroundUnderTheCameraIsAsFarAsEachBlockSeesIt) {
  CameraView view; // 90 degrees, 2 m above a ground of 200 x 200 m
  const ReceiverDepths depths = depthsOf(view, {Aabb{{-100, -2, -100}, {100, -2, 100}}});
  EXPECT_TRUE(blockAt(depths, 4, 2).empty()) << "above the horizon";
  EXPECT_NEAR(depths.range.nearest, 2, 0.1);
  EXPECT_NEAR(depths.range.farthest, 100, 0.1);
  EXPECT_LT(blockAt(depths, 4, 7).farthest, 3);
}

TEST(BoxDepths, NothingInViewGivesNoRange) {
  EXPECT_TRUE(depthsOf(CameraView{}, {Aabb{{-1, -1, 10}, {1, 1, 12}}}).range.empty());
  EXPECT_TRUE(depthsOf(CameraView{}, {}).range.empty());
  const std::vector<Aabb> boxes{Aabb{{-1, -1, -12}, {1, 1, -10}}};
  EXPECT_TRUE(boxDepths(CameraView{}, 64, 64, boxes, std::vector<std::uint8_t>{0}).range.empty()) << "not drawn";
}

TEST(BoxDepths, X18_ThePointThatAnyPixelShowsLiesInItsBlocksSpan) {
  EXPECT_TRUE(rc::check([](const RandomView& random) {
    const CameraView& view = random.view;
    const auto unit = [] { return (*rc::gen::arbitrary<RandomUnit>()).value; };
    const int width = 1 + static_cast<int>(unit() * 200);
    const int height = 1 + static_cast<int>(unit() * 200);
    const glm::dvec2 pixel(unit() * width, unit() * height); // from the upper left corner
    const glm::dvec2 ndc(2 * pixel.x / width - 1, 1 - 2 * pixel.y / height);
    const double farthest = std::min(view.far, view.near + 500.0);
    const double depth = view.near + unit() * (farthest - view.near);
    const glm::dvec3 point = pointAt(view, ndc, depth);
    const double size = unit() < 0.3 ? 1000.0 : 10.0;
    const Aabb box{point - size * glm::dvec3(unit(), unit(), unit()),
                   point + size * glm::dvec3(unit(), unit(), unit())};

    const ReceiverDepths depths = depthsOf(view, {box}, width, height);
    const DepthSpan& span = blockAt(depths, std::min(static_cast<int>(pixel.x) / 8, depths.columns - 1),
                                    std::min(static_cast<int>(pixel.y) / 8, depths.rows - 1));
    RC_ASSERT(!span.empty());
    RC_ASSERT(span.nearest <= depth);
    RC_ASSERT(span.farthest >= depth);
    RC_ASSERT(depths.range.nearest <= span.nearest && depths.range.farthest >= span.farthest);
    RC_ASSERT(std::isfinite(depths.range.farthest));
  }));
}

} // namespace
} // namespace gnomon

#include "renderer/shadow/predicted_error.h"

#include <gtest/gtest.h>

#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

/// A wall across the whole picture, `depth` metres away, and a tile whose texels face the camera.
struct Wall {
  CameraView view;
  ReceiverDepths receivers;
  ShadowTile tile;

  explicit Wall(float depth) {
    receivers = {8, 64, 48, 8, 6, std::vector<DepthSpan>(48, {depth, depth}), {depth, depth}};
    view.halfSize = {1, 0.75};
    tile.near = 1;
    tile.far = 100;
    tile.rect.width = tile.rect.height = 256;
    tile.space.size = 256;
    tile.space.fit.texelSize = {0.5, 0.25};
  }

  std::vector<float> extents() const { return texelExtents(view, seenBlocks(view, receivers), tile); }
};

TEST(PredictedError, H2_InTheMiddleItIsTheTexelsDiagonalOverThePixel) {
  const Wall wall(10);
  const std::vector<float> extents = wall.extents();
  ASSERT_EQ(extents.size(), 48u);
  // At 10 m a pixel is 20 / 64 m; a texel that faces the camera covers the same everywhere.
  for (const float extent : extents) EXPECT_NEAR(extent, std::hypot(0.5, 0.25) / (20.0 / 64), 1e-4);
}

TEST(PredictedError, H2_ATexelAlongTheViewShowsAtTheEdgeAlone) {
  Wall wall(10);
  wall.receivers = {8, 8, 8, 1, 1, {{10, 10}}, {10, 10}};
  wall.view.halfSize = {1, 1};
  wall.tile.space.basis = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  wall.tile.space.fit.texelSize = {0.5, 0};
  EXPECT_NEAR(wall.extents().at(0), 0, 1e-9) << "straight ahead";
  wall.receivers.width = 16;
  wall.receivers.columns = 2;
  wall.receivers.blocks.resize(2, {10, 10});
  // ndc 0.5: the picture's 8 pixels a half move by 0.5 * 0.5 / 10.
  EXPECT_NEAR(wall.extents().at(1), 0.5 * 0.5 / 10 * 8, 1e-5);
}

TEST(PredictedError, H2_OnlyWhatTheTileServesCounts) {
  Wall wall(10);
  wall.tile.far = 9;
  EXPECT_TRUE(wall.extents().empty());
  wall.tile.far = 100;
  wall.receivers.blocks[0] = {};
  EXPECT_EQ(wall.extents().size(), 47u);
  wall.tile.rect.width = 0;
  EXPECT_TRUE(wall.extents().empty()) << "not drawn";
}

TEST(PredictedError, H2_TheNearestServedSurfaceOfABlockCounts) {
  Wall wall(10);
  wall.receivers.blocks.assign(48, {5, 10});
  wall.tile.near = 8;
  for (const float extent : wall.extents()) {
    EXPECT_NEAR(extent, std::hypot(0.5, 0.25) / (16.0 / 64), 1e-4);
  }
}

TEST(PredictedError, H2_PercentilesAreNearestRanks) {
  EXPECT_FALSE(errorOf({}));
  std::vector<float> extents;
  for (int i = 100; i > 0; --i) extents.push_back(static_cast<float>(i));
  const PredictedError error = *errorOf(extents);
  EXPECT_EQ(error.median, 50);
  EXPECT_EQ(error.p95, 95);
  EXPECT_EQ(error.max, 100);
  EXPECT_EQ(errorOf({7})->median, 7);
}

TEST(PredictedError, H2_EveryTileWithReceiversHasOneAndHalfTheTexelsDoubleIt) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const ShadowPlan plan = planShadows(random.input);
    const PredictedErrors errors = predictErrors(random.input, plan);
    RC_ASSERT(errors.tiles.size() == plan.tiles.size());
    RC_ASSERT(errors.lights.size() == plan.lights.size());
    for (const auto& error : errors.tiles) {
      if (!error) continue;
      RC_ASSERT(std::isfinite(error->max) && error->median > 0);
      RC_ASSERT(error->median <= error->p95 && error->p95 <= error->max && error->max <= errors.all->max);
    }
    const SeenBlocks seen = seenBlocks(random.input.view, random.input.receivers);
    for (const ShadowTile& tile : plan.tiles) {
      ShadowTile coarse = tile;
      coarse.space.fit.texelSize *= 2.0;
      const auto fine = errorOf(texelExtents(random.input.view, seen, tile));
      const auto doubled = errorOf(texelExtents(random.input.view, seen, coarse));
      RC_ASSERT(fine.has_value() == doubled.has_value());
      if (fine) RC_ASSERT(std::abs(doubled->max / fine->max - 2) < 1e-4);
    }
  }));
}

} // namespace
} // namespace gnomon

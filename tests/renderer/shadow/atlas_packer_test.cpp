#include <algorithm>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <numeric>

#include "renderer/shadow/tile_size.h"
#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::vector<TileSquare> randomSquares(Dice& dice) {
  std::vector<TileSquare> squares;
  const int count = 1 + dice.below(40);
  for (int i = 0; i < count; ++i) squares.push_back({i / 3, i % 3, 1 << (6 + dice.below(6))});
  return squares;
}

TEST(AtlasPacker, X9_SquaresNeverOverlapAndStayInsideTheLeastArea) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const auto squares = randomSquares(dice);
    const AtlasLayout layout = packSquares(squares);
    std::int64_t area = 0;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const Rect& rect = layout.rects[i];
      RC_ASSERT(rect.width == squares[i].size && rect.height == squares[i].size);
      RC_ASSERT(rect.x >= 0 && rect.y >= 0);
      RC_ASSERT(rect.x + rect.width <= layout.width && rect.y + rect.height <= layout.height);
      for (std::size_t j = 0; j < i; ++j) RC_ASSERT(!overlap(rect, layout.rects[j]));
      area += static_cast<std::int64_t>(rect.width) * rect.height;
    }
    RC_ASSERT(static_cast<std::int64_t>(layout.width) * layout.height < 2 * area);
    RC_ASSERT(layout.width == layout.height || layout.width == 2 * layout.height);
  }));
}

TEST(AtlasPacker, X10_AnyOrderGivesTheSameRectangles) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const auto squares = randomSquares(dice);
    const AtlasLayout layout = packSquares(squares);
    std::vector<std::size_t> order(squares.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), dice.engine());
    std::vector<TileSquare> shuffled;
    for (const std::size_t i : order) shuffled.push_back(squares[i]);
    const AtlasLayout other = packSquares(shuffled);
    for (std::size_t i = 0; i < order.size(); ++i) RC_ASSERT(other.rects[i] == layout.rects[order[i]]);
  }));
}

TEST(AtlasPacker, X8_SixteenLargeTilesOrFourExtraLargeFillTheAtlas) {
  const std::vector<TileRequest> large{{0, 4, 1024}, {1, 4, 1024}, {2, 4, 1024}, {3, 4, 1024}};
  EXPECT_THAT(grantTileSizes(large, 4096), ElementsAre(1024, 1024, 1024, 1024));
  const std::vector<TileRequest> extraLarge{{0, 4, 2048}};
  EXPECT_THAT(grantTileSizes(extraLarge, 4096), ElementsAre(2048));
  const std::vector<TileSquare> squares{{0, 0, 2048}, {0, 1, 2048}, {0, 2, 2048}, {0, 3, 2048}};
  const AtlasLayout layout = packSquares(squares);
  EXPECT_EQ(layout.width, 4096);
  EXPECT_EQ(layout.height, 4096);
}

TEST(AtlasPacker, X11_TheLastOfTheLargestIsHalvedFirst) {
  const std::vector<TileRequest> five{{0, 4, 1024}, {1, 4, 1024}, {2, 4, 1024}, {3, 4, 1024}, {4, 4, 1024}};
  EXPECT_THAT(grantTileSizes(five, 4096), ElementsAre(1024, 1024, 1024, 512, 512));
  const std::vector<TileRequest> reversed{{4, 4, 1024}, {3, 4, 1024}, {2, 4, 1024}, {1, 4, 1024}, {0, 4, 1024}};
  EXPECT_THAT(grantTileSizes(reversed, 4096), ElementsAre(512, 512, 1024, 1024, 1024));
}

TEST(AtlasPacker, X9_ASmallTileBesideFourThatFillTheAtlas) {
  const std::vector<TileRequest> requests{{0, 1, 256}, {1, 4, 2048}};
  EXPECT_THAT(grantTileSizes(requests, 4096), ElementsAre(256, 1024));
  const std::vector<TileSquare> squares{{0, 0, 256}, {1, 0, 1024}, {1, 1, 1024}, {1, 2, 1024}, {1, 3, 1024}};
  const AtlasLayout layout = packSquares(squares);
  EXPECT_EQ(layout.width, 4096); // 4 x 1024^2 + 256^2 need more than 2048 x 2048
  EXPECT_EQ(layout.height, 2048);
}

TEST(AtlasPacker, X11_WhatCannotBeHalvedFurtherIsRefusedLastLightFirst) {
  const std::vector<TileRequest> requests{{0, 4, 128}, {1, 4, 128}, {2, 4, 128}};
  EXPECT_THAT(grantTileSizes(requests, 128), ElementsAre(64, 0, 0)); // 4 x 64^2 fill 128^2
  EXPECT_THAT(grantTileSizes(requests, 32), ElementsAre(0, 0, 0));
}

TEST(AtlasPacker, X11_GrantsFitAreNeverLargerThanAskedAndSmallestAtWorst) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    std::vector<TileRequest> requests;
    const int count = 1 + dice.below(16);
    for (int i = 0; i < count; ++i) requests.push_back({i, dice.below(5), 1 << (6 + dice.below(8))});
    const int side = 1 << (7 + dice.below(6));
    const auto sizes = grantTileSizes(requests, side);
    std::int64_t area = 0;
    bool refused = false;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      RC_ASSERT(sizes[i] == 0 || (sizes[i] >= kSmallestTile && sizes[i] <= requests[i].size));
      area += static_cast<std::int64_t>(requests[i].tileCount) * sizes[i] * sizes[i];
      if (refused) RC_ASSERT(sizes[i] == 0); // a light is never refused for the sake of a later one
      refused = sizes[i] == 0;
    }
    RC_ASSERT(area <= static_cast<std::int64_t>(side) * side);
    RC_ASSERT(sizes[0] > 0);
  }));
}

TEST(AtlasPacker, X9_X11_WhatFillsUpTo95PercentIsGrantedInFullAndFits) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const int side = 1 << (9 + dice.below(4));
    const std::int64_t room = std::int64_t{side} * side * 95 / 100;
    std::vector<TileRequest> requests;
    std::vector<TileSquare> squares;
    std::int64_t area = 0;
    for (int misses = 0; misses < 20;) {
      const int size = 1 << (5 + dice.below(8));
      const int tiles = 1 + dice.below(6);
      if (size > side || area + std::int64_t{tiles} * size * size > room) {
        ++misses;
        continue;
      }
      area += std::int64_t{tiles} * size * size;
      const int light = static_cast<int>(requests.size());
      requests.push_back({light, tiles, size, static_cast<ShadowImportance>(dice.below(3))});
      for (int tile = 0; tile < tiles; ++tile) squares.push_back({light, tile, size});
    }
    const auto sizes = grantTileSizes(requests, side);
    for (std::size_t i = 0; i < requests.size(); ++i) RC_ASSERT(sizes[i] == requests[i].size);
    const AtlasLayout layout = packSquares(squares);
    RC_ASSERT(layout.width <= side && layout.height <= side);
  }));
}

TEST(AtlasPacker, NothingNeedsNoAtlas) {
  const AtlasLayout layout = packSquares({});
  EXPECT_EQ(layout.width, 0);
  EXPECT_EQ(layout.height, 0);
}

TEST(AtlasPacker, X11_TheLeastImportantYieldFirstHoweverSmall) {
  using enum ShadowImportance;
  const std::vector<TileRequest> requests{{0, 1, 256, low}, {1, 4, 1024, high}, {2, 1, 512, low}};
  EXPECT_EQ(grantTileSizes(requests, 2048), (std::vector<int>{256, 512, 512}))
      << "nobody is refused while anybody can shrink";
  const std::vector<TileRequest> roomy{{0, 1, 256, low}, {1, 3, 1024, high}, {2, 4, 512, medium}, {3, 1, 1024, low}};
  EXPECT_EQ(grantTileSizes(roomy, 2048), (std::vector<int>{256, 1024, 256, 512}));
}

} // namespace
} // namespace gnomon

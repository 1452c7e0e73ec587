#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

constexpr std::array kSizes{ShadowSize::XLarge, ShadowSize::Large, ShadowSize::Medium, ShadowSize::Small,
                            ShadowSize::XSmall};

constexpr ShadowImportance kHigh = ShadowImportance::high;

TEST(TileSize, X2_X3_X4_FiveSizesByFiveViewports) {
  struct Row {
    int width, height;
    std::array<int, 5> sides; // XLarge .. XSmall
  };
  const std::array<Row, 5> rows{{{320, 240, {1024, 512, 256, 128, 64}},
                                 {512, 300, {1024, 512, 256, 128, 64}},
                                 {513, 300, {2048, 1024, 512, 256, 128}},
                                 {1280, 720, {2048, 1024, 512, 256, 128}},
                                 {1080, 4096, {2048, 1024, 512, 256, 128}}}};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      EXPECT_EQ(askedTileSize(kSizes[i], kHigh, 1024, std::max(row.width, row.height)), row.sides[i])
          << row.width << ' ' << i;
    }
  }
}

TEST(TileSize, X5_EachStepOfImportanceHalves) {
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::high, 1024, 1280), 1024);
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::medium, 1024, 1280), 512);
  EXPECT_EQ(askedTileSize(ShadowSize::Large, ShadowImportance::low, 1024, 1280), 256);
  EXPECT_EQ(askedTileSize(ShadowSize::XSmall, ShadowImportance::low, 1024, 100), 4);
  EXPECT_EQ(askedTileSize(ShadowSize::XSmall, ShadowImportance::low, 1024, 3), 1);
}

TEST(TileSize, X4_WhatCoversNoPixelAsksForNothing) {
  for (const ShadowSize size : kSizes) EXPECT_EQ(askedTileSize(size, kHigh, 1024, 0), 0);
}

TEST(TileSize, X4_IsThePowerOfTwoOverTheScaledFrameForEverySide) {
  for (int side = 1; side <= 8192; ++side) {
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      const double factor = std::ldexp(2.0, -static_cast<int>(i));
      double power = 1.0 / 1024;
      while (power < side * factor) power *= 2;
      const double expected = std::max(1.0, std::min(2048 * factor, power));
      ASSERT_EQ(askedTileSize(kSizes[i], kHigh, 2048, side), static_cast<int>(expected)) << side << ' ' << i;
    }
  }
}

} // namespace
} // namespace gnomon

#include "renderer/shadow/tile_size.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

constexpr std::array kSizes{ShadowSize::XLarge, ShadowSize::Large, ShadowSize::Medium, ShadowSize::Small,
                            ShadowSize::XSmall};

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
      EXPECT_EQ(askedTileSize(kSizes[i], 1024, row.width, row.height), row.sides[i]) << row.width << ' ' << i;
    }
  }
}

TEST(TileSize, X4_AFrameWithoutPixelsAsksForNothing) {
  for (const ShadowSize size : kSizes) EXPECT_EQ(askedTileSize(size, 1024, 0, 0), 0);
}

TEST(TileSize, X4_IsThePowerOfTwoOverTheScaledFrameForEverySide) {
  for (int side = 1; side <= 8192; ++side) {
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      const double factor = std::ldexp(2.0, -static_cast<int>(i));
      double power = 1.0 / 1024;
      while (power < side * factor) power *= 2;
      const double expected = std::max(1.0, std::min(2048 * factor, power));
      ASSERT_EQ(askedTileSize(kSizes[i], 2048, side, 1), static_cast<int>(expected)) << side << ' ' << i;
    }
  }
}

} // namespace
} // namespace gnomon

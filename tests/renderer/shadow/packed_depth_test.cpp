// Why depths of three cascades in the channels of one 8-bit target are not offered (row M12): the article's boxes, and
// what 8 bits and the bias that they need do to a shadow near its caster.
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shadow/filter_kernel.h"

namespace gnomon {
namespace {

/// Metres from the least to the greatest depth of one of the article's maps: twice its box.
constexpr double kDepthExtents[] = {2 * 3.3, 2 * 6.8, 2 * 13.0};
constexpr double kArticleBias = 0.01; ///< of the extent
constexpr double kCubeSpacing = 0.25; ///< metres between its cubes

/// The height, metres, below which some caster over a floor throws no shadow on it: heights and floors are swept, a
/// depth is stored in `levels` steps, and the floor is moved by `bias` of the extent.
double lostBelow(double extent, double levels, double bias) {
  double lost = 0;
  for (double floor = 0.5; floor < 0.6; floor += 0.00037) {
    for (double height = 0; height < 0.1 * extent; height += 0.001 * extent) {
      const double stored = std::round((floor - height / extent) * levels) / levels;
      if (floor - bias <= stored) lost = std::max(lost, height);
    }
  }
  return lost;
}

TEST(PackedDepth, M12_EightBitsLoseTheShadowsThatAFloatKeeps) {
  for (const double extent : kDepthExtents) {
    const double quantum = extent / 255;
    const double eightBit = lostBelow(extent, 255, kArticleBias);
    EXPECT_GT(eightBit, kArticleBias * extent);
    EXPECT_LT(eightBit, kArticleBias * extent + quantum);
    const double ours = depthBias(100, extent); // a scene of 100 m
    EXPECT_LE(lostBelow(extent, 0x1p24, ours), 0.001 * extent) << "the least step of the sweep";
    EXPECT_LT(ours * extent, 0.001) << "less than a millimetre";
  }
  EXPECT_LT(lostBelow(kDepthExtents[0], 255, kArticleBias), kCubeSpacing);
  EXPECT_GT(lostBelow(kDepthExtents[2], 255, kArticleBias), kCubeSpacing) << "a whole cube hovers unseen";
}

TEST(PackedDepth, M12_WithoutABiasEightBitsShadowTheFloorItself) {
  int acne = 0;
  for (int i = 0; i < 1000; ++i) {
    const double floor = 0.5 + 0.0001 * i;
    acne += floor > std::round(floor * 255) / 255 ? 1 : 0; // held against its own stored depth
  }
  EXPECT_GT(acne, 400);
}

} // namespace
} // namespace gnomon

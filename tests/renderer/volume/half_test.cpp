#include "renderer/volume/half.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace gnomon {
namespace {

TEST(Half, EveryNumberComesBackAsItself) {
  for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    if ((half & 0x7c00u) == 0x7c00u) continue;
    const int exponent = half >> 10 & 31;
    const double fraction = half & 1023;
    const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    ASSERT_EQ(fromHalf(half), half & 0x8000u ? -size : size) << bits;
    ASSERT_EQ(toHalf(fromHalf(half)), half);
  }
}

TEST(Half, WhatIsNotFiniteStaysSo) {
  EXPECT_EQ(fromHalf(0x7c00), std::numeric_limits<float>::infinity());
  EXPECT_EQ(fromHalf(0xfc00), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(fromHalf(0x7e01)));
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  for (std::uint16_t half = 0; half < 0x7bff; ++half) {
    const float low = fromHalf(half), high = fromHalf(static_cast<std::uint16_t>(half + 1));
    const float middle = low + (high - low) / 2;
    ASSERT_EQ(toHalf(middle), half % 2 == 0 ? half : half + 1) << half;
    ASSERT_EQ(toHalf(std::nextafter(middle, 0.0f)), half);
    ASSERT_EQ(toHalf(std::nextafter(middle, 1e9f)), half + 1);
  }
  EXPECT_EQ(toHalf(1e9f), 0x7bff);
  EXPECT_EQ(toHalf(-std::numeric_limits<float>::infinity()), 0xfbff);
}

} // namespace
} // namespace gnomon

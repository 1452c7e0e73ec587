#include "renderer/cpu/shadow/largest_seen.h"

#include <gtest/gtest.h>

#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {
namespace {

/// A picture that shows nothing.
DepthBuffer picture(int width, int height, int samples) {
  DepthBuffer surfaces;
  surfaces.width = width;
  surfaces.height = height;
  surfaces.samples = samples;
  surfaces.triangles.assign(surfaces.places(), kNoNumber);
  return surfaces;
}

void show(DepthBuffer& surfaces, std::uint32_t triangle, int x0, int y0, int width, int height) {
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x) {
      for (int s = 0; s < surfaces.samples; ++s) surfaces.triangles[surfaces.at(x, y, s)] = triangle;
    }
  }
}

TEST(LargestSeen, AreThoseThatFillSquaresInOrder) {
  for (const int samples : {1, 4}) {
    DepthBuffer surfaces = picture(200, 120, samples);
    show(surfaces, 70, 0, 0, 200, 64);
    show(surfaces, 9, 32, 64, 64, 32);
    show(surfaces, 5, 130, 70, 30, 40); // large, but few squares
    EXPECT_EQ(largestSeen(surfaces), (std::vector<std::uint32_t>{9, 70}));
  }
}

TEST(LargestSeen, AreNoneWhereTheyFillLittleOrNothingIsSeen) {
  EXPECT_TRUE(largestSeen(picture(200, 120, 1)).empty());
  DepthBuffer small = picture(8, 8, 1);
  show(small, 3, 0, 0, 8, 8);
  EXPECT_TRUE(largestSeen(small).empty());
  DepthBuffer surfaces = picture(640, 480, 1);
  show(surfaces, 3, 0, 0, 64, 64); // a hundredth of it
  EXPECT_TRUE(largestSeen(surfaces).empty());
  show(surfaces, 3, 64, 0, 128, 64);
  EXPECT_EQ(largestSeen(surfaces), (std::vector<std::uint32_t>{3}));
}

TEST(LargestSeen, AreAtMostSixteenOfTheLargest) {
  DepthBuffer surfaces = picture(320, 320, 1);
  for (int i = 0; i < 20; ++i) {
    // Strips of 16 pixels, whose length grows with the number.
    show(surfaces, static_cast<std::uint32_t>(100 + i), 0, 16 * i, 160 + 8 * i, 16);
  }
  const std::vector<std::uint32_t> largest = largestSeen(surfaces);
  EXPECT_EQ(largest.size(), 16u);
  EXPECT_EQ(largest.front(), 104u);
  EXPECT_EQ(largest.back(), 119u);
}

} // namespace
} // namespace gnomon::cpu

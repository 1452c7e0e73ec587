#include "renderer/reference/distance_transform.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

float bruteForce(const std::vector<std::uint8_t>& marks, int width, int x, int y) {
  double least = kFar;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const int across = static_cast<int>(i) % width - x;
    const int along = static_cast<int>(i) / width - y;
    if (marks[i] != 0) least = std::min(least, std::sqrt(static_cast<double>(across * across + along * along)));
  }
  return static_cast<float>(least);
}

TEST(DistanceTransform, OneMarkIsMeasuredFromEverywhere) {
  std::vector<std::uint8_t> marks(5 * 4);
  marks[1 * 5 + 2] = 1;
  const auto distances = distancesTo(marks, 5, 4);
  EXPECT_EQ(distances[1 * 5 + 2], 0.0f);
  EXPECT_EQ(distances[1 * 5 + 4], 2.0f);
  EXPECT_EQ(distances[3 * 5 + 2], 2.0f);
  EXPECT_EQ(distances[3 * 5 + 0], std::sqrt(8.0f));
}

TEST(DistanceTransform, NoMarkIsInfinitelyFar) {
  EXPECT_EQ(distancesTo(std::vector<std::uint8_t>(6), 3, 2), std::vector<float>(6, kFar));
  EXPECT_TRUE(distancesTo({}, 0, 0).empty());
}

TEST(DistanceTransform, LongDistancesAreExact) {
  std::vector<std::uint8_t> marks(16384 * 2);
  marks[0] = 1;
  const auto distances = distancesTo(marks, 16384, 2);
  EXPECT_EQ(distances.back(), static_cast<float>(std::sqrt(16383.0 * 16383.0 + 1.0)));
}

RC_GTEST_PROP(DistanceTransform, EqualsWhatTryingEveryMarkGives, ()) {
  const int width = *rc::gen::inRange(1, 24);
  const int height = *rc::gen::inRange(1, 24);
  const int rarity = *rc::gen::element(1, 3, 20, 200);
  std::vector<std::uint8_t> marks;
  for (int i = 0; i < width * height; ++i) marks.push_back(*rc::gen::inRange(0, rarity) == 0 ? 1 : 0);
  const auto distances = distancesTo(marks, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      RC_ASSERT(distances[static_cast<std::size_t>(y * width + x)] == bruteForce(marks, width, x, y));
    }
  }
}

} // namespace
} // namespace gnomon

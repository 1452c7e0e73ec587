#include <gtest/gtest.h>
#include <random>

#include "renderer/bake/light_map.h"
#include "tests/renderer/bake/share_at.h"

namespace gnomon {
namespace {

TEST(EvenBlocks, HoldWhatIsReadAnywhereInABlock) {
  std::mt19937 random(7);
  for (const glm::ivec2 size : {glm::ivec2(2, 2), glm::ivec2(8, 9), glm::ivec2(61, 40), glm::ivec2(64, 64)}) {
    LightMap map{size.x, size.y, {}};
    map.shares.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 65535);
    std::uniform_int_distribution<int> x(0, size.x - 1), y(0, size.y - 1);
    for (int spot = 0; spot < 5; ++spot) {
      map.shares[static_cast<std::size_t>(y(random) * size.x + x(random))] = static_cast<std::uint16_t>(9000 * spot);
    }
    const EvenBlocks even = evenBlocks(map);
    std::uniform_real_distribution<float> u(0, static_cast<float>(size.x)), v(0, static_cast<float>(size.y));
    for (int i = 0; i < 2000; ++i) {
      const glm::vec2 place(u(random), v(random));
      const glm::ivec2 texel = glm::clamp(glm::ivec2(place - 0.5f), glm::ivec2(0), size - 2) / EvenBlocks::kSide;
      const std::uint16_t share = even.shares[static_cast<std::size_t>(texel.y * even.columns + texel.x)];
      if (share == EvenBlocks::kUneven) continue;
      EXPECT_FLOAT_EQ(testing::shareAt(map, place), static_cast<float>(share) / 65535.0f);
    }
  }
}

TEST(EvenBlocks, SeeTheTexelsBesideThem) {
  LightMap map{16, 16, std::vector<std::uint16_t>(256, 0)};
  map.shares[8 * 16 + 8] = 500; // the lowest left texel of the last block
  EXPECT_EQ(evenBlocks(map).shares[0], EvenBlocks::kUneven);
  map.shares[8 * 16 + 8] = 0;
  map.shares[9 * 16 + 9] = 500;
  EXPECT_EQ(evenBlocks(map).shares[0], 0);
  EXPECT_EQ(evenBlocks(map).shares[1], 0);
  EXPECT_EQ(evenBlocks(map).shares[3], EvenBlocks::kUneven);
}

LightMap halfLit(int side) {
  LightMap map{side, side, {}};
  for (int i = 0; i < side * side; ++i) map.shares.push_back(i % side < side / 2 ? 0 : 65535);
  return map;
}

TEST(EvenTriangles, HoldWhatIsReadAnywhereInATriangle) {
  std::mt19937 random(8);
  const LightMap map = halfLit(100);
  std::uniform_real_distribution<float> place(-3, 103), step(-9, 9), weight(0, 1);
  std::vector<glm::vec2> corners;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec2 first(place(random), place(random));
    for (int corner = 0; corner < 3; ++corner) corners.push_back(first + glm::vec2(step(random), step(random)));
  }
  const std::vector<std::uint16_t> shares = evenTriangles(map, evenBlocks(map), corners);
  ASSERT_EQ(shares.size(), 3001u);
  int uneven = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    const glm::vec2* at = &corners[3 * i];
    uneven += shares[i] == EvenBlocks::kUneven ? 1 : 0;
    for (int k = 0; k < 50 && shares[i] != EvenBlocks::kUneven; ++k) {
      const float u = weight(random);
      const float v = weight(random) * (1 - u);
      const glm::vec2 within = at[0] + u * (at[1] - at[0]) + v * (at[2] - at[0]);
      EXPECT_FLOAT_EQ(testing::shareAt(map, within), static_cast<float>(shares[i]) / 65535.0f);
    }
  }
  EXPECT_GT(uneven, 100);
  EXPECT_LT(uneven, 1000) << "those away from the edge";
}

TEST(EvenTriangles, SeeTheEdgeWithinABlock) {
  const LightMap map = halfLit(8);
  const std::vector<glm::vec2> corners{{1, 1}, {3, 1}, {1, 3}, {5, 1}, {7, 1}, {5, 3}, {3, 1}, {5, 1}, {3, 3}};
  const std::vector<std::uint16_t> shares = evenTriangles(map, evenBlocks(map), corners);
  EXPECT_EQ(shares[0], 0);
  EXPECT_EQ(shares[1], 65535);
  EXPECT_EQ(shares[2], EvenBlocks::kUneven);
}

TEST(EvenBlocks, AShareThatSaysUnevenIsReadTexelByTexel) {
  const LightMap map{8, 8, std::vector<std::uint16_t>(64, EvenBlocks::kUneven)};
  EXPECT_EQ(evenBlocks(map).shares[0], EvenBlocks::kUneven);
}

} // namespace
} // namespace gnomon

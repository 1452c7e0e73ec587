#include "renderer/bake/even_blocks.h"

#include <gtest/gtest.h>
#include <random>

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
      EXPECT_FLOAT_EQ(shareAt(map, place), static_cast<float>(share) / 65535.0f);
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

TEST(EvenBlocks, AShareThatSaysUnevenIsReadTexelByTexel) {
  const LightMap map{8, 8, std::vector<std::uint16_t>(64, EvenBlocks::kUneven)};
  EXPECT_EQ(evenBlocks(map).shares[0], EvenBlocks::kUneven);
}

} // namespace
} // namespace gnomon

#include "renderer/bake/pack_rectangles.h"

#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>

namespace gnomon {
namespace {

TEST(PackRectangles, KeepsThemApartAndInTheStrip) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const int width = *rc::gen::inRange(8, 200);
    std::vector<glm::ivec2> sizes(*rc::gen::inRange<std::size_t>(0, 120));
    for (glm::ivec2& size : sizes) {
      size = {1 + static_cast<int>(random() % static_cast<unsigned>(width)), 1 + static_cast<int>(random() % 40)};
    }
    const RectanglePacking packing = packRectangles(sizes, width);
    RC_ASSERT(packing.rects.size() == sizes.size());
    std::vector<std::uint8_t> taken(static_cast<std::size_t>(width) * static_cast<std::size_t>(packing.height));
    int highest = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const Rect& rect = packing.rects[i];
      RC_ASSERT(rect.width == sizes[i].x && rect.height == sizes[i].y);
      RC_ASSERT(rect.x >= 0 && rect.x + rect.width <= width && rect.y >= 0);
      highest = std::max(highest, rect.y + rect.height);
      RC_ASSERT(highest <= packing.height);
      for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (int x = rect.x; x < rect.x + rect.width; ++x) {
          std::uint8_t& texel = taken[static_cast<std::size_t>(y * width + x)];
          RC_ASSERT(texel == 0);
          texel = 1;
        }
      }
    }
    RC_ASSERT(packing.height == highest);
  }));
}

TEST(PackRectangles, WastesLittleWhereManyAreSmall) {
  std::mt19937 random(7);
  std::vector<glm::ivec2> sizes;
  double area = 0;
  for (int i = 0; i < 2000; ++i) {
    sizes.emplace_back(3 + random() % 40, 3 + random() % 40);
    area += sizes.back().x * sizes.back().y;
  }
  const RectanglePacking packing = packRectangles(sizes, 1024);
  EXPECT_LT(1024.0 * packing.height, 1.12 * area);
}

} // namespace
} // namespace gnomon

#include "renderer/reference/light_source.h"

#include <array>
#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

TEST(LightSamples, FillTheDiscEvenlyForAnyCount) {
  for (const std::uint32_t count : {16u, 100u, 256u, 1000u}) {
    for (const std::uint64_t seed : {0ull, 0x123456789abcdef0ull, ~0ull}) {
      std::array<int, 4> quadrants{};
      int inner = 0; // within half the area
      glm::dvec2 sum(0);
      for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 p = discSample(i, count, seed);
        ASSERT_LE(glm::length(p), 1 + 1e-12);
        ++quadrants[std::size_t((p.x > 0 ? 1 : 0) + (p.y > 0 ? 2 : 0))];
        inner += glm::dot(p, p) < 0.5 ? 1 : 0;
        sum += p;
      }
      const double slack = 3 + 0.03 * count;
      EXPECT_NEAR(inner, 0.5 * count, slack);
      for (const int quadrant : quadrants) EXPECT_NEAR(quadrant, 0.25 * count, slack);
      EXPECT_LT(glm::length(sum / double(count)), 1.5 / std::sqrt(double(count)) / 2);
    }
  }
}

TEST(LightSamples, SeedsDifferFromPointToPointAndStayForOne) {
  std::set<std::uint64_t> seeds;
  SurfacePoint point;
  for (std::uint32_t instance = 0; instance < 4; ++instance) {
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
      for (const double x : {0.0, 1e-300, 1.0, 1.0 + 0x1p-52, -1.0}) {
        point.instance = instance;
        point.triangle = triangle;
        point.position = {x, 2, 3};
        seeds.insert(seedOf(point));
        EXPECT_EQ(seedOf(point), seedOf(SurfacePoint(point)));
      }
    }
  }
  EXPECT_EQ(seeds.size(), 4u * 4 * 5);
}

} // namespace
} // namespace gnomon

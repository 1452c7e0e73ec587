#include "renderer/bake/flat_triangles.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <rapidcheck.h>
#include <vector>

namespace gnomon {
namespace {

constexpr double kSlack = 1e-9;

bool isInside(const FlatTriangle& t, const glm::dvec2& p) {
  const double turn = signedArea(t) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (turn * signedArea({t[i], t[(i + 1) % 3], p}) <= 1e-6) return false;
  }
  return true;
}

FlatTriangle anyTriangle(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const glm::dvec2 middle(unit(random), unit(random));
  FlatTriangle t;
  for (glm::dvec2& corner : t) corner = middle + size * glm::dvec2(unit(random), unit(random));
  return t;
}

TEST(FlatTriangles, ThatShareASideOrACornerDoNotOverlap) {
  const FlatTriangle a{{{0, 0}, {1, 0}, {0, 1}}};
  const FlatTriangle beyond{{{1, 0}, {1, 1}, {0, 1}}};
  const FlatTriangle folded{{{1, 0}, {0, 1}, {0.1, 0.1}}};
  EXPECT_FALSE(overlap(a, beyond, kSlack));
  EXPECT_TRUE(overlap(a, folded, kSlack));
  EXPECT_FALSE(overlap(a, {{{1, 0}, {2, 0}, {2, 1}}}, kSlack));
  EXPECT_TRUE(overlap(a, a, kSlack));
  EXPECT_TRUE(overlap(a, {{{0.2, 0.2}, {0.2, 0.3}, {0.3, 0.2}}}, kSlack)) << "one within the other";
  EXPECT_FALSE(overlap(a, {{{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.2}}}, kSlack)) << "one without an area";
}

TEST(FlatTriangles, OverlapWhereAPointLiesInBoth) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const FlatTriangle a = anyTriangle(random, 0.7), b = anyTriangle(random, *rc::gen::element(0.7, 0.05));
    bool common = false;
    for (int y = -60; y <= 60; ++y) {
      for (int x = -60; x <= 60; ++x) {
        const glm::dvec2 p(x / 35.0, y / 35.0);
        common = common || (isInside(a, p) && isInside(b, p));
      }
    }
    RC_ASSERT(overlap(a, b, kSlack) == overlap(b, a, kSlack));
    if (common) RC_ASSERT(overlap(a, b, kSlack));
  }));
}

TEST(FlatTriangles, AnyOverlapIsThatOfEveryPair) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    std::vector<FlatTriangle> triangles;
    const int count = *rc::gen::inRange(0, 40);
    for (int i = 0; i < count; ++i) triangles.push_back(anyTriangle(random, *rc::gen::element(0.5, 0.1, 0.02)));
    bool any = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) any = any || overlap(triangles[i], triangles[k], kSlack);
    }
    RC_ASSERT(anyOverlap(triangles, kSlack) == any);
  }));
}

TEST(FlatTriangles, AGridOfNeighboursDoesNotOverlap) {
  std::vector<FlatTriangle> triangles;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const glm::dvec2 p(x * 0.1, y * 0.1), right(0.1, 0), up(0, 0.1);
      triangles.push_back({p, p + right, p + up});
      triangles.push_back({p + right, p + right + up, p + up});
    }
  }
  EXPECT_FALSE(anyOverlap(triangles, kSlack));
  triangles.push_back({{{5.01, 5.02}, {5.03, 5.02}, {5.02, 5.03}}});
  EXPECT_TRUE(anyOverlap(triangles, kSlack));
}

} // namespace
} // namespace gnomon

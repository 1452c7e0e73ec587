#include "renderer/bake/flat_triangles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <rapidcheck.h>
#include <vector>

#include "renderer/core/stop.h"

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

bool anyPairOverlaps(const std::vector<FlatTriangle>& triangles, double slack) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (overlap(triangles[i], triangles[k], slack)) return true;
    }
  }
  return false;
}

/// Two long triangles for each of `count` strips `along`, side by side; they touch where `share` of their room is 1.
std::vector<FlatTriangle> strips(int count, const glm::dvec2& along, double share) {
  std::vector<FlatTriangle> triangles;
  const glm::dvec2 step = glm::dvec2(-along.y, along.x) / static_cast<double>(count);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 low = static_cast<double>(i) * step;
    const glm::dvec2 high = share < 1 ? low + share * step : static_cast<double>(i + 1) * step;
    triangles.push_back({low, low + along, high});
    triangles.push_back({low + along, high + along, high});
  }
  return triangles;
}

/// A disc of `count` corners, around `hub`.
std::vector<FlatTriangle> fan(int count, const glm::dvec2& hub) {
  const auto rim = [&](int i) {
    const double angle = 6.283185307179586 * (i % count) / count;
    return glm::dvec2(std::cos(angle), std::sin(angle));
  };
  std::vector<FlatTriangle> triangles;
  for (int i = 0; i < count; ++i) triangles.push_back({hub, rim(i), rim(i + 1)});
  return triangles;
}

/// `anyOverlap`, or nothing where it takes a thousand times as long as it should and is stopped.
std::optional<bool> anyOverlapSoon(const std::vector<FlatTriangle>& triangles) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const Result<bool> any = untilStopped([&] { return std::chrono::steady_clock::now() < deadline; },
                                        [&] { return Result<bool>(anyOverlap(triangles, kSlack)); });
  return any ? std::optional(*any) : std::nullopt;
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

// On a coarse raster sides and corners often touch, and needles narrower than the slack lie along each other. What
// overlaps one before is mostly left out, so that both answers are frequent.
TEST(FlatTriangles, AnyOverlapIsThatOfEveryPairWhereManyTouch) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const double slack = *rc::gen::element(kSlack, 1e-6, 0.03);
    const bool needles = *rc::gen::arbitrary<bool>(), keepAll = *rc::gen::inRange(0, 30) == 0;
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<FlatTriangle> triangles;
    for (int i = 0; i < 80; ++i) {
      FlatTriangle t = anyTriangle(random, 0.4);
      for (glm::dvec2& corner : t) corner = glm::round(corner * 8.0) / 8.0;
      if (needles) t[2] = glm::mix(t[0], t[1], unit(random)) + 2 * slack * glm::dvec2(unit(random), unit(random));
      const bool isIn = std::any_of(triangles.begin(), triangles.end(),
                                    [&](const FlatTriangle& before) { return overlap(before, t, slack); });
      if (keepAll || !isIn) triangles.push_back(t);
    }
    RC_ASSERT(anyOverlap(triangles, slack) == anyPairOverlaps(triangles, slack));
    triangles.push_back(anyTriangle(random, 0.05));
    RC_ASSERT(anyOverlap(triangles, slack) == anyPairOverlaps(triangles, slack));
  }));
}

TEST(FlatTriangles, ThatAreLongAndSlantedTakeNoLonger) {
  for (const glm::dvec2& along : {glm::dvec2(1, 1), glm::dvec2(1, 0.3)}) {
    for (const double share : {0.9, 1.0}) {
      std::vector<FlatTriangle> triangles = strips(4096, along, share);
      EXPECT_EQ(anyOverlapSoon(triangles), false);
      const glm::dvec2 hidden = triangles[3000][0] + 0.4 * along;
      triangles.push_back({hidden, hidden + 1e-3 * along, hidden + 1e-5 * glm::dvec2(-along.y, along.x)});
      EXPECT_EQ(anyOverlapSoon(triangles), true);
    }
  }
}

TEST(FlatTriangles, OfAFanTakeNoLonger) {
  for (const glm::dvec2& hub : {glm::dvec2(0, 0), glm::dvec2(0.7, 0.1), glm::dvec2(1, 0)}) {
    std::vector<FlatTriangle> triangles = fan(4096, hub);
    EXPECT_EQ(anyOverlapSoon(triangles), false);
    triangles.push_back({{{-0.5, 0.5}, {-0.5, 0.50001}, {-0.50001, 0.5}}});
    EXPECT_EQ(anyOverlapSoon(triangles), true);
  }
}

TEST(FlatTriangles, ThinnerThanTheSlackTakeNoLongerOnTopOfEachOther) {
  std::vector<FlatTriangle> triangles;
  for (int i = 0; i < 20000; ++i) triangles.push_back({{{0, 0}, {1, 0.5}, {0.5, 0.25 + 1e-14 * (i + 1)}}});
  EXPECT_EQ(anyOverlapSoon(triangles), false);
}

// Slices of unlike length take longer than the halving before them: the search itself has to end.
TEST(FlatTriangles, SearchEndsWhenItIsStopped) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> length(0.3, 1);
  std::vector<FlatTriangle> triangles = fan(200'000, {0, 0});
  for (FlatTriangle& t : triangles) {
    const double scale = length(random);
    for (glm::dvec2& corner : t) corner *= scale;
  }
  for (const int wanted : {0, 1, 200}) {
    int asked = 0;
    const auto goOn = [&] { return asked++ < wanted; };
    const Result<bool> any = untilStopped(goOn, [&] { return Result<bool>(anyOverlap(triangles, kSlack)); });
    ASSERT_FALSE(any);
    EXPECT_EQ(any.problems().front().code, ProblemCode::unavailable);
    EXPECT_EQ(asked, wanted + 1);
  }
}

} // namespace
} // namespace gnomon

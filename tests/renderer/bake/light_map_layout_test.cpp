#include "renderer/bake/light_map_layout.h"

#include <gtest/gtest.h>
#include <set>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Point;

const Primitive& primitiveOf(const Scene& scene, std::uint32_t instance) {
  return scene.primitives[static_cast<std::size_t>(scene.scenes[0].instances[instance].primitive)];
}

double areaOf(const Scene& scene, const Primitive& primitive, std::uint32_t triangle) {
  const std::uint32_t* corner = &scene.indices[primitive.firstIndex + 3 * std::size_t{triangle}];
  const glm::vec3* at = &scene.positions[primitive.baseVertex];
  const glm::dvec3 a(at[corner[0]]), b(at[corner[1]]), c(at[corner[2]]);
  return glm::length(glm::cross(b - a, c - a));
}

Scene sphereAndFloor() {
  GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  testing::addSphere(builder, {0, 2, 0}, 1, 24);
  return load(builder);
}

TEST(SurfaceCharts, HoldEveryTriangleOnceWithoutFoldsAndNearItsSize) {
  const Scene scene = sphereAndFloor();
  const std::vector<SurfaceChart> charts = chartsOf(scene, primitiveOf(scene, 1), glm::dmat4(1));
  EXPECT_GT(charts.size(), 4u);
  EXPECT_LT(charts.size(), 40u);
  std::set<std::uint32_t> seen;
  for (const SurfaceChart& chart : charts) {
    ASSERT_EQ(chart.triangles.size(), chart.flat.size());
    EXPECT_FALSE(anyOverlap(chart.flat, 1e-9));
    for (std::size_t i = 0; i < chart.flat.size(); ++i) {
      EXPECT_TRUE(seen.insert(chart.triangles[i]).second);
      const double own = areaOf(scene, primitiveOf(scene, 1), chart.triangles[i]);
      EXPECT_GT(std::abs(signedArea(chart.flat[i])), 0.25 * own);
      EXPECT_LT(std::abs(signedArea(chart.flat[i])), 1.0001 * own);
    }
  }
  std::size_t withArea = 0;
  for (std::uint32_t i = 0; i < primitiveOf(scene, 1).indexCount / 3; ++i) {
    withArea += areaOf(scene, primitiveOf(scene, 1), i) > 1e-12 ? 1 : 0; // at the poles rounding makes slivers
  }
  EXPECT_EQ(seen.size(), withArea);
}

/// Two turns of a stair, seen from above each over the other.
TEST(SurfaceCharts, AStairThatWindsOverItselfIsCut) {
  GlbBuilder builder;
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 4 * glm::pi<double>() * i / kSteps;
    for (const double radius : {1.0, 2.0}) {
      points.push_back({float(radius * std::cos(angle)), float(0.05 * i), float(radius * std::sin(angle))});
    }
    if (i == kSteps) break;
    const auto at = std::uint32_t(2 * i);
    for (const std::uint32_t corner : {at, at + 2, at + 1, at + 1, at + 2, at + 3}) indices.push_back(corner);
  }
  const int positions = builder.addPoints(points);
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", builder.addIndices(indices)}}));
  const Scene scene = load(builder);
  const std::vector<SurfaceChart> charts = chartsOf(scene, scene.primitives[0], glm::dmat4(1));
  EXPECT_GE(charts.size(), 2u);
  EXPECT_LE(charts.size(), 12u);
  for (const SurfaceChart& chart : charts) EXPECT_FALSE(anyOverlap(chart.flat, 1e-9));
}

/// A square of two triangles with these second texture coordinates.
Scene squareWith(const std::vector<std::array<float, 2>>& coordinates) {
  GlbBuilder builder;
  const int positions = builder.addPoints({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
  const int first = builder.addAccessor(std::vector<std::array<float, 2>>(4), "VEC2", 5126, 4);
  const int second = builder.addAccessor(coordinates, "VEC2", 5126, 4);
  const int indices = builder.addIndices({0, 1, 2, 0, 2, 3});
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
                       {"indices", indices}}));
  return load(builder);
}

TEST(SurfaceCharts, AuthoredOnesAreTakenWhereTheyAreSound) {
  const auto chartsFor = [](const std::vector<std::array<float, 2>>& coordinates) {
    const Scene scene = squareWith(coordinates);
    return authoredChartsOf(scene, scene.primitives[0], glm::dmat4(1));
  };
  const auto sound = chartsFor({{0.1f, 0.1f}, {0.5f, 0.1f}, {0.5f, 0.5f}, {0.1f, 0.5f}});
  ASSERT_TRUE(sound.has_value());
  ASSERT_EQ(sound->size(), 1u);
  EXPECT_NEAR((*sound)[0].size.x, 2, 1e-6) << "as large as in the world";
  EXPECT_NEAR((*sound)[0].size.y, 2, 1e-6);
  EXPECT_FALSE(chartsFor({{0.1f, 0.1f}, {1.5f, 0.1f}, {0.5f, 0.5f}, {0.1f, 0.5f}})) << "beyond 1";
  EXPECT_FALSE(chartsFor({{0.1f, 0.1f}, {0.5f, 0.1f}, {0.5f, 0.5f}, {0.4f, 0.11f}})) << "one over the other";
  EXPECT_FALSE(chartsFor({{0.1f, 0.1f}, {0.5f, 0.1f}, {0.9f, 0.1f}, {0.1f, 0.5f}})) << "a triangle without an area";
}

TEST(LightMapLayout, GivesEveryChartTexelsOfItsOwn) {
  const Scene scene = sphereAndFloor();
  const auto layout = lightMapLayout(scene, scene.scenes[0], {8.0, {}});
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->texelsPerMetre, 8);
  std::vector<int> owner(static_cast<std::size_t>(layout->width * layout->height), -1);
  for (std::size_t i = 0; i < layout->charts.size(); ++i) {
    const PlacedChart& chart = layout->charts[i];
    for (int y = chart.rect.y; y < chart.rect.y + chart.rect.height; ++y) {
      for (int x = chart.rect.x; x < chart.rect.x + chart.rect.width; ++x) {
        int& texel = owner[static_cast<std::size_t>(y * layout->width + x)];
        EXPECT_EQ(texel, -1);
        texel = static_cast<int>(i);
      }
    }
    for (const std::uint32_t triangle : chart.triangles) {
      for (const glm::dvec2& corner : layout->flat({chart.instance, triangle})) {
        // Half a texel more is read around it.
        EXPECT_GE(corner.x - 0.5, chart.rect.x);
        EXPECT_GE(corner.y - 0.5, chart.rect.y);
        EXPECT_LE(corner.x + 0.5, chart.rect.x + chart.rect.width);
        EXPECT_LE(corner.y + 0.5, chart.rect.y + chart.rect.height);
      }
    }
  }
}

TEST(LightMapLayout, FillsTheSizeThatIsAskedFor) {
  const Scene scene = sphereAndFloor();
  for (const int size : {64, 500, 2048}) {
    const auto layout = lightMapLayout(scene, scene.scenes[0], {{}, size});
    ASSERT_TRUE(layout) << size;
    EXPECT_LE(std::max(layout->width, layout->height), size);
    EXPECT_GE(std::max(layout->width, layout->height), size * 9 / 10);
  }
}

TEST(LightMapLayout, WhatDoesNotFitIsAProblemAtItsField) {
  const Scene scene = sphereAndFloor();
  const auto fine = lightMapLayout(scene, scene.scenes[0], {5000.0, {}});
  ASSERT_FALSE(fine);
  EXPECT_EQ(fine.problems()[0].pointer, "/texelsPerMetre");
  const auto small = lightMapLayout(scene, scene.scenes[0], {{}, 6});
  ASSERT_FALSE(small);
  EXPECT_EQ(small.problems()[0].pointer, "/size");
}

TEST(LightMapLayout, TheLeastSizeThatIsToldFitsAndNoLesserOneDoes) {
  const Scene scene = sphereAndFloor();
  const auto fits = [&](int size) { return lightMapLayout(scene, scene.scenes[0], {{}, size}); };
  const auto small = fits(6);
  ASSERT_FALSE(small);
  const std::string limit = small.problems()[0].limit;
  EXPECT_TRUE(limit.ends_with(".." + std::to_string(kLimits.maxLightMapSide))) << limit;
  const int least = std::stoi(limit);
  ASSERT_GT(least, 7);
  EXPECT_TRUE(fits(least));
  const auto less = fits(least - 1);
  ASSERT_FALSE(less);
  EXPECT_EQ(less.problems()[0].limit, limit);
}

} // namespace
} // namespace gnomon

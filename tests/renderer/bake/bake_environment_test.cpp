#include "renderer/bake/bake_environment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/rays/sky_rays.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

constexpr int kSamples = 4;

SkyLight skyOf(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
  return {std::make_shared<const EnvironmentSampler>(radiance, 1)};
}

SkyLight uniformSky() {
  return skyOf([](const glm::dvec3&) { return glm::vec3(1, 2, 3); });
}

/// Most of whose light comes from a few degrees.
SkyLight sunnySky() {
  return skyOf([](const glm::dvec3& d) { return d.x > 0.6 && d.y > 0.7 ? glm::vec3(500, 400, 300) : glm::vec3(1); });
}

struct Bake {
  Bake(const GlbBuilder& builder, const SkyLight& sky, double texelsPerMetre, int samples = kSamples)
      : traced(builder), layout(*lightMapLayout(traced.scene.scene(), traced.scene.view(), {texelsPerMetre, {}})) {
    maps = *bakeEnvironment(traced.input(), sky, layout, samples, {});
  }

  /// What each texel in the instance's charts has, by the world's place of its middle, where that lies in a triangle.
  template <class Take>
  void forEachTexel(std::uint32_t instance, const Take& take) const {
    const TracedSky sky(traced.input());
    for (const PlacedChart& chart : layout.charts) {
      if (chart.instance != instance) continue;
      for (const std::uint32_t triangle : chart.triangles) {
        const FlatTriangle t = layout.flat({instance, triangle});
        const double area = signedArea(t);
        for (int y = chart.rect.y; y < chart.rect.y + chart.rect.height; ++y) {
          for (int x = chart.rect.x; x < chart.rect.x + chart.rect.width; ++x) {
            const glm::dvec2 middle(x + 0.5, y + 0.5);
            const glm::dvec2 weights(signedArea({t[0], middle, t[2]}) / area, signedArea({t[0], t[1], middle}) / area);
            if (weights.x < 0 || weights.y < 0 || weights.x + weights.y > 1) continue;
            const glm::dvec3 place = sky.pointInFront({instance, triangle}, weights).position + traced.anchor();
            take(place, glm::dvec3(maps[0].at(x, y), maps[1].at(x, y), maps[2].at(x, y)) / 65535.0);
          }
        }
      }
    }
  }

  Traced traced;
  LightMapLayout layout;
  std::array<LightMap, 3> maps;
};

bool allAre(const LightMap& map, std::uint16_t share) {
  return std::all_of(map.shares.begin(), map.shares.end(), [&](std::uint16_t each) { return each == share; });
}

TEST(BakeEnvironment, AnOpenPlaneGetsAllOfItInEveryTexel) {
  GlbBuilder builder;
  testing::addSquare(builder, 2, 0);
  for (const SkyLight& sky : {uniformSky(), sunnySky()}) {
    const Bake bake(builder, sky, 16);
    ASSERT_GT(bake.maps[0].shares.size(), 1000u);
    for (const LightMap& map : bake.maps) EXPECT_TRUE(allAre(map, 65535));
  }
}

TEST(BakeEnvironment, NothingArrivesInAClosedBox) {
  GlbBuilder builder;
  testing::addQuad(builder, {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}});
  testing::addQuad(builder, {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}});
  testing::addQuad(builder, {{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}});
  testing::addQuad(builder, {{1, -1, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, -1}});
  testing::addQuad(builder, {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}});
  testing::addQuad(builder, {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}});
  const Bake bake(builder, uniformSky(), 8);
  for (std::uint32_t wall = 0; wall < 6; ++wall) {
    int texels = 0;
    bake.forEachTexel(wall, [&](const glm::dvec3& place, const glm::dvec3& share) {
      ++texels;
      EXPECT_EQ(share, glm::dvec3(0)) << wall << ": " << place.x << " " << place.y << " " << place.z;
    });
    EXPECT_GT(texels, 100) << wall;
  }
}

/// Floor before a wall at x = 0 that is 1 m high and so long that its ends hide nothing.
GlbBuilder floorAndWall() {
  GlbBuilder builder;
  testing::addQuad(builder, {{0.1f, 0, 1}, {2, 0, 1}, {2, 0, -1}, {0.1f, 0, -1}});
  testing::addQuad(builder, {{0, 0, 20}, {0, 0, -20}, {0, 1, -20}, {0, 1, 20}});
  return builder;
}

TEST(BakeEnvironment, AWallHidesWhatItsElevationSays) {
  const Bake bake(floorAndWall(), uniformSky(), 16);
  double squares = 0, most = 0;
  int texels = 0;
  bake.forEachTexel(0, [&](const glm::dvec3& place, const glm::dvec3& share) {
    const double cosine = place.x / std::hypot(place.x, 1.0);
    const double off = share.y - (1 - (1 - cosine) / 2);
    squares += off * off;
    most = std::max(most, std::abs(off));
    ++texels;
  });
  ASSERT_GT(texels, 500);
  EXPECT_LT(std::sqrt(squares / texels), 0.01);
  EXPECT_LT(most, 0.03);
}

TEST(BakeEnvironment, EachColorHasItsOwnShare) {
  const SkyLight sky = skyOf([](const glm::dvec3& d) { return d.x > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1); });
  const Bake bake(floorAndWall(), sky, 16);
  bake.forEachTexel(0, [&](const glm::dvec3& place, const glm::dvec3& share) {
    EXPECT_EQ(share.x, 1) << "the wall is on the blue side";
    EXPECT_LT(share.z, 1 - (1 - place.x / std::hypot(place.x, 1.0)) + 0.06);
    EXPECT_LE(share.y, 1);
  });
}

TEST(BakeEnvironment, TheSkyTurnsWithItsRotation) {
  SkyLight sky = skyOf([](const glm::dvec3& d) { return d.x > 0 ? glm::vec3(1) : glm::vec3(0); });
  sky.mapFromWorld = glm::mat3(glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1)); // half around
  const Bake bake(floorAndWall(), sky, 16);
  bake.forEachTexel(0, [&](const glm::dvec3& place, const glm::dvec3& share) {
    EXPECT_NEAR(share.x, place.x / std::hypot(place.x, 1.0), 0.06) << "all of its light comes over the wall";
  });
}

TEST(BakeEnvironment, ASphereHidesTheSquareOfItsSine) {
  GlbBuilder builder;
  testing::addSquare(builder, 0.1f, 0);
  testing::addSphere(builder, {0, 2, 0}, 1, 128);
  const Bake bake(builder, uniformSky(), 32, 16);
  double sum = 0;
  int texels = 0;
  bake.forEachTexel(0, [&](const glm::dvec3& place, const glm::dvec3& share) {
    // Elliptic projection: of a sphere that is seen whole it is (r/d)^2 times the cosine of its middle.
    const double squared = place.x * place.x + place.z * place.z + 4;
    sum += share.x - (1 - 1 / squared * 2 / std::sqrt(squared));
    ++texels;
  });
  ASSERT_GT(texels, 10);
  EXPECT_NEAR(sum / texels, 0, 0.004);
}

TEST(BakeEnvironment, WhatShowsNoShadowsGetsAllOfIt) {
  Traced traced(floorAndWall());
  traced.nodes.resize(2);
  traced.nodes[0].receiveShadow = false;
  const auto layout = *lightMapLayout(traced.scene.scene(), traced.scene.view(), {8, {}});
  const auto maps = *bakeEnvironment(traced.input(), uniformSky(), layout, kSamples, {});
  for (const PlacedChart& chart : layout.charts) {
    const std::uint16_t share = maps[0].at(chart.rect.x + chart.rect.width / 2, chart.rect.y + chart.rect.height / 2);
    EXPECT_TRUE(chart.instance == 1 ? share < 65535 : share == 65535) << share;
  }
}

TEST(BakeEnvironment, IsTheSameOnAnyNumberOfCoresAndStopsWhenAsked) {
  GlbBuilder builder;
  testing::addSquare(builder, 2, 0);
  testing::addSphere(builder, {0, 1, 0}, 0.8, 24);
  const Traced traced(builder);
  const auto layout = *lightMapLayout(traced.scene.scene(), traced.scene.view(), {8, {}});
  const auto bakeOn = [&](std::size_t cores) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, cores);
    return *bakeEnvironment(traced.input(), sunnySky(), layout, kSamples, {});
  };
  const auto one = bakeOn(1);
  const auto four = bakeOn(4);
  EXPECT_FALSE(allAre(one[0], 65535));
  for (std::size_t color = 0; color < 3; ++color) EXPECT_EQ(one[color].shares, four[color].shares);
  EXPECT_FALSE(bakeEnvironment(traced.input(), sunnySky(), layout, kSamples, [](double) { return false; }));
}

} // namespace
} // namespace gnomon

#include <random>

#include "renderer/bake/light_map.h"
#include "tests/renderer/bake/share_at.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/shadow/shadow_kernels.h"

namespace gnomon::cpu {
namespace {

constexpr std::uint32_t kSlots = 3;

/// A map with even and uneven parts, and triangles of a few slots anywhere in it.
struct MadeMap {
  LightMap map;
  EvenBlocks even;
  std::vector<glm::vec2> corners;
  std::vector<std::uint16_t> evenTriangles;
  BakedMap baked;
};

/// `extent`: of most triangles, texels.
MadeMap madeMap(std::mt19937& random, const glm::ivec2& size, float extent = 1000) {
  MadeMap made{{size.x, size.y, {}}, {}, {}, {}, {}};
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      made.map.shares.push_back((x / 20 + y / 20) % 2 == 0 ? 65535 : static_cast<std::uint16_t>(random()));
    }
  }
  made.even = evenBlocks(made.map);
  // Some lie beyond the rim.
  std::uniform_real_distribution<float> x(-2, static_cast<float>(size.x + 2)), y(-2, static_cast<float>(size.y + 2));
  for (std::size_t i = 0; i < std::size_t{kSlots} * kClusterTriangles; ++i) {
    const glm::vec2 first(x(random), y(random));
    for (int corner = 0; corner < 3; ++corner) {
      made.corners.push_back(first + glm::clamp(glm::vec2(x(random), y(random)) - first, -extent, extent));
    }
  }
  made.evenTriangles = evenTriangles(made.map, made.even, made.corners);
  std::vector<std::int32_t> firstTriangles;
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
    firstTriangles.push_back(static_cast<std::int32_t>(kClusterTriangles * ((slot + 1) % kSlots)));
  }
  made.baked = {.shares = made.map.shares.data(),
                .width = size.x,
                .height = size.y,
                .even = made.even.shares.data(),
                .evenColumns = made.even.columns,
                .evenTriangles = made.evenTriangles.data(),
                .corners = made.corners.data(),
                .firstTriangles = std::move(firstTriangles)};
  return made;
}

/// `alike`: how many points in a row lie in one triangle.
std::vector<AskedPoint> pointsIn(std::mt19937& random, std::size_t count, std::size_t alike) {
  std::uniform_real_distribution<float> weight(0, 1);
  std::vector<AskedPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i].triangle =
        i % alike == 0 ? static_cast<std::uint32_t>(random() % (kSlots * kClusterTriangles)) : points[i - 1].triangle;
    points[i].weights = {weight(random), weight(random)};
    if (points[i].weights.x + points[i].weights.y > 1) points[i].weights = 1.0f - points[i].weights;
  }
  return points;
}

float expected(const MadeMap& made, const AskedPoint& point, float strength) {
  const glm::vec2* corner = &made.corners[3 * made.baked.numberOf(point.triangle)];
  const glm::vec2 place =
      corner[0] + point.weights.x * (corner[1] - corner[0]) + point.weights.y * (corner[2] - corner[0]);
  return 1 - strength * (1 - testing::shareAt(made.map, place));
}

ShadowMaps mapsOf(const shared::LightData& light, const Layer& layer) {
  ShadowMaps maps{{&light, 1}, {}, {}};
  maps.layers = {&layer, 1};
  return maps;
}

shared::LightData bakedLight() {
  shared::LightData light{};
  light.visibilityLayer = 1;
  light.layerOmitsTurnedFaces = 1;
  light.shadowedGroups = 1;
  light.strength = 0.75f;
  return light;
}

TEST(BakedLookup, N5_LanesReadWhatPlainCodeReads) {
  const shared::LightData light = bakedLight();
  for (const glm::ivec2 size : {glm::ivec2(2, 2), glm::ivec2(61, 40), glm::ivec2(200, 333)}) {
    for (const std::size_t alike : {1, 5, 64}) {
      std::mt19937 random(3);
      const MadeMap made = madeMap(random, size, size.x == 61 ? 3.0f : 1000.0f);
      const std::vector<AskedPoint> points = pointsIn(random, 1001, alike);
      const Layer layer{nullptr, 0, 1, &made.baked};
      onEachInstructionSet([&] {
        std::vector<float> shares(points.size());
        visibilitiesByLanes(mapsOf(light, layer), points, shares.data());
        for (std::size_t i = 0; i < points.size(); ++i) {
          ASSERT_NEAR(shares[i], expected(made, points[i], light.strength), 2e-4) << size.x << ' ' << alike << ' ' << i;
        }
      });
    }
  }
}

TEST(BakedLookup, N5_SurfacesThatReceiveNoShadowAreLitAndTurnedOnesDark) {
  const shared::LightData light = bakedLight();
  std::mt19937 random(4);
  const MadeMap made = madeMap(random, {64, 64});
  std::vector<AskedPoint> points = pointsIn(random, 32, 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 2 == 0) points[i].groupBit = 2;
    if (i % 2 == 1) points[i].toLight.z = -1;
  }
  const Layer layer{nullptr, 0, 1, &made.baked};
  onEachInstructionSet([&] {
    std::vector<float> shares(points.size());
    visibilitiesByLanes(mapsOf(light, layer), points, shares.data());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_FLOAT_EQ(shares[i], i % 2 == 0 ? 1.0f : 0.25f);
  });
}

/// A line of sight may miss the triangle that it shows.
TEST(BakedLookup, N5_PlacesBesideATriangleAreReadWithinIt) {
  const shared::LightData light = bakedLight();
  std::mt19937 random(5);
  const MadeMap made = madeMap(random, {128, 128});
  std::vector<AskedPoint> points = pointsIn(random, 16, 1);
  const glm::vec2 far[] = {{-9, -9}, {1e4f, -5}, {-3, 7e3f}, {1e4f, 1e4f}};
  const glm::vec2 near[] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}};
  std::vector<AskedPoint> within = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].weights = far[i % 4];
    within[i].weights = near[i % 4];
  }
  const Layer layer{nullptr, 0, 1, &made.baked};
  onEachInstructionSet([&] {
    std::vector<float> shares(points.size());
    visibilitiesByLanes(mapsOf(light, layer), points, shares.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(shares[i], expected(made, within[i], light.strength), 2e-4);
    }
  });
}

} // namespace
} // namespace gnomon::cpu

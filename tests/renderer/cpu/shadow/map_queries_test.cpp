#include "renderer/cpu/shadow/map_queries.h"

#include <bit>

#include "renderer/prepare/draw_list.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/shadow/debug_kernels.h"
#include "tests/renderer/cpu/shadow/random_maps.h"
#include "tests/renderer/cpu/surface/made_scene.h"

namespace gnomon::cpu {
namespace {

/// A picture whose pixels show triangles of a scene, by chance, and a light.
struct Queried {
  MadeScene made{true};
  DepthBuffer surfaces;
  RandomMaps random;
  ShadowMaps maps;

  Queried() {
    made.place(std::vector<Material>(4));
    surfaces.width = made.frameScene().width;
    surfaces.height = made.frameScene().height;
    surfaces.triangles.resize(surfaces.blocks() * kBlockPlaces, kNoNumber);
    for (const MadeScene::Seen& seen : made.seen(40'000)) {
      const glm::ivec2 pixel(seen.place);
      surfaces.triangles[surfaces.at(pixel.x, pixel.y)] = seen.triangle;
    }
    std::mt19937 generator(4);
    random = randomMaps(generator, {.lightType = GNOMON_POINT});
    random.lights[0].litGroups = ~0u;
    random.lights[0].shadowedGroups = ~0u;
    maps = random.view();
  }

  /// What its pixels show in their middle, row by row from the bottom.
  std::vector<AskedPoint> points() const {
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> places;
    for (int y = 0; y < surfaces.height; ++y) {
      for (int x = 0; x < surfaces.width; ++x) {
        triangles.push_back(surfaces.triangles[surfaces.at(x, y)]);
        places.push_back(glm::vec2(x, y) + 0.5f);
      }
    }
    std::vector<AskedPoint> points(triangles.size());
    receiversByLanes(made.frameScene(), {triangles, places}, points.data());
    return points;
  }
  bool shows(int x, int y) const { return surfaces.triangles[surfaces.at(x, y)] != kNoNumber; }
};

TEST(Receivers, AreThePointsThatTrianglesShow) {
  for (const bool perspective : {true, false}) {
    MadeScene made(perspective);
    made.place(std::vector<Material>(6));
    const std::vector<MadeScene::Seen> seen = made.seen(20'000);
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> places;
    for (const MadeScene::Seen& each : seen) {
      triangles.push_back(triangles.size() % 9 == 0 ? kNoNumber : each.triangle);
      places.push_back(glm::vec2(each.place));
    }
    onEachInstructionSet([&] {
      std::vector<AskedPoint> points(seen.size());
      receiversByLanes(made.frameScene(), {triangles, places}, points.data());
      for (std::size_t i = 0; i < seen.size(); ++i) {
        if (triangles[i] == kNoNumber) continue;
        const glm::dvec3 point = seen[i].point();
        const glm::dvec3 toEye = perspective ? -point : -made.view().forward;
        const glm::dvec3 normal = seen[i].normal() * (glm::dot(seen[i].normal(), toEye) < 0 ? -1.0 : 1.0);
        ASSERT_LE(glm::length(glm::dvec3(points[i].relative) - point), 2e-3 * glm::length(point));
        ASSERT_LE(glm::length(glm::dvec3(points[i].normal) - normal), 1e-3);
        ASSERT_NEAR(points[i].viewDepth, glm::dot(point, made.view().forward), 2e-3 * glm::length(point));
        ASSERT_EQ(std::popcount(points[i].groupBit), 1);
      }
    });
  }
}

bool isNear(const glm::vec2& a, const glm::vec2& b) {
  return glm::length(a - b) <= 1e-3f * std::max(1.0f, glm::length(b));
}

TEST(MapQueries, FootprintsAreThoseOfEachPixel) {
  const Queried queried;
  const FrameScene& scene = queried.made.frameScene();
  const DepthBuffer& surfaces = queried.surfaces;
  const std::vector<AskedPoint> points = queried.points();
  onEachInstructionSet([&] {
    std::vector<MapFootprint> expected(points.size());
    footprintsByLanes({queried.maps, scene.frame}, points, expected.data());
    const std::vector<MapFootprint> seen = mapFootprints({scene, surfaces, queried.maps, 0});
    ASSERT_EQ(seen.size(), expected.size());
    int found = 0;
    int off = 0;
    for (int y = 0; y < surfaces.height; ++y) {
      for (int x = 0; x < surfaces.width; ++x) {
        const MapFootprint& own = seen[static_cast<std::size_t>((surfaces.height - 1 - y) * surfaces.width + x)];
        if (!queried.shows(x, y)) {
          ASSERT_EQ(own.viewDepth, 0.0f);
          continue;
        }
        const MapFootprint& other = expected[static_cast<std::size_t>(y * surfaces.width + x)];
        found += own.texelU != glm::vec2(0);
        const bool same = std::abs(own.viewDepth - other.viewDepth) <= 1e-4f * other.viewDepth &&
                          isNear(own.texelU, other.texelU) && isNear(own.texelV, other.texelV) &&
                          isNear(own.shift, other.shift) && own.tile == other.tile;
        off += !same;
      }
    }
    EXPECT_GE(found, 1000);
    EXPECT_LE(off, found / 100);
  });
}

} // namespace
} // namespace gnomon::cpu

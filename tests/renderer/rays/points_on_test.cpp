#include <random>
#include <rapidcheck.h>

#include "renderer/rays/tree.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::addSquare;
using testing::GlbBuilder;
using testing::parallelView;
using testing::perspectiveView;
using testing::Point;
using testing::Traced;

TEST(PointsOn, AreTheFirstHitsWhereThoseAreKnown) {
  GlbBuilder builder;
  for (const float y : {0.0f, 1.0f, 2.0f}) addSquare(builder, 3.0f - y, y);
  Traced traced(builder);
  for (const bool perspective : {false, true}) {
    traced.camera = perspective ? perspectiveView({4, 9, 7}, {0.3, 0, 0.2}, 50) //
                                : parallelView({4, 9, 7}, {-4, -9, -7}, 9);
    std::vector<glm::vec2> places;
    std::vector<PlacedTriangle> triangles;
    const std::vector<SurfacePoint> hits = traced.surface();
    for (std::size_t i = 0; i < hits.size(); ++i) {
      places.emplace_back(float(i % 64) + 0.5f, float(i / 64) + 0.5f);
      triangles.push_back({hits[i].instance, hits[i].triangle});
    }
    const std::vector<SurfacePoint> points = pointsOn(traced.input(), places, triangles);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(points[i].instance, hits[i].instance);
      EXPECT_EQ(points[i].normal, hits[i].normal);
      EXPECT_LT(glm::length(points[i].position - hits[i].position), 1e-12);
    }
  }
}

TEST(PointsOn, StayInTheTriangleThatTheRayPasses) {
  GlbBuilder builder;
  addSquare(builder, 1, 0);
  Traced traced(builder);
  traced.camera = parallelView({0, 5, 0}, {0, -1, 0}, 4);
  const std::vector<glm::vec2> places{{0.5f, 0.5f}};
  const std::vector<PlacedTriangle> triangles{{0, 0}};
  const SurfacePoint point = pointsOn(traced.input(), places, triangles)[0];
  EXPECT_LE(std::max(std::abs(point.position.x), std::abs(point.position.z)), 1);
}

/// The point where a camera ray crosses a triangle, said plainly in doubles.
SurfacePoint crossed(const Traced& traced, glm::vec2 place, const PlacedTriangle& on) {
  const TracedScene::Tree& tree = traced.scene.tree();
  const CameraView& view = traced.camera;
  const glm::dvec2 ndc(2.0 * place.x / traced.width - 1, 1 - 2.0 * place.y / traced.height);
  const glm::dvec3 origin = view.eye - tree.anchor + pointAt(view, ndc, 0);
  const glm::dvec3 direction = view.perspective ? pointAt(view, ndc, 1) : view.forward;
  const Triangle triangle = tree.triangle(on.instance, on.triangle);
  const Barycentric at = crossing(triangle, origin, direction, {1.0 / 3.0, 1.0 / 3.0});
  const glm::dvec3 area = triangle.area();
  return {at.mix(triangle.a, triangle.b, triangle.c),
          glm::vec3(unitAlong(glm::dot(area, direction) > 0 ? -area : area)), on.instance, on.triangle};
}

TEST(PointsOn, AreTheBitsOfTheFormulaInDoublesWhateverTheTriangle) {
  EXPECT_TRUE(rc::check([] {
    constexpr int kTriangles = 19; // a packet of lanes and some more
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    std::uniform_real_distribution<double> unit(-1, 1);
    const double size = *rc::gen::element(1e-20, 1e-6, 1.0, 1e8);
    const double thin = *rc::gen::element(1.0, 1e-6, 0.0); // slivers, and triangles without area
    std::vector<Point> corners;
    for (int i = 0; i < kTriangles; ++i) {
      const glm::dvec3 a(unit(random), unit(random), unit(random)), b(unit(random), unit(random), unit(random));
      const glm::dvec3 c = a + unit(random) * (b - a) + thin * glm::dvec3(unit(random), unit(random), unit(random));
      for (const glm::dvec3& p : {a, b, c}) {
        corners.push_back({float(p.x * size), float(p.y * size), float(p.z * size)});
      }
    }
    GlbBuilder builder;
    builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(corners)}}}}));
    nlohmann::json& node = builder.json["nodes"][0];
    const int placed = *rc::gen::inRange(0, 3);
    if (placed == 1) node["scale"] = {-2, 0.5, 3};
    if (placed == 2) { // sheared, and as far away as a scene may reach
      const double far = std::min(1e6 * size, 1e9);
      node["matrix"] = {1, 0, 0, 0, 0.7, 1, 0, 0, 0, -0.3, 1, 0, far, -far, std::min(10 * size, far), 1};
    }
    Traced traced(builder);
    const glm::dvec3 aside(unit(random), 1.5 + unit(random), 3);
    const glm::dvec3 eye = traced.anchor() + size * *rc::gen::element(1.0, 1e5) * aside;
    traced.camera = *rc::gen::arbitrary<bool>() ? perspectiveView(eye, traced.anchor(), 60)
                                                : parallelView(eye, traced.anchor() - eye, 3 * size);
    const std::vector<glm::vec2> places = *rc::gen::container<std::vector<glm::vec2>>(
        *rc::gen::inRange(0, 50), rc::gen::map(rc::gen::inRange(0, 64 * 64 * 16), [](int at) {
          return glm::vec2(float(at % 1024) / 16, float(at / 1024)); // their rays pass most triangles, or graze them
        }));
    std::vector<PlacedTriangle> triangles;
    for (std::size_t i = 0; i < places.size(); ++i) {
      triangles.push_back(i % 7 == 3 ? PlacedTriangle{} : PlacedTriangle{0, std::uint32_t(i * i % kTriangles)});
    }
    const std::vector<SurfacePoint> points = pointsOn(traced.input(), places, triangles);
    RC_ASSERT(points.size() == places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      RC_ASSERT(points[i].instance == triangles[i].instance);
      if (triangles[i].instance == kNoSurface) continue;
      const SurfacePoint expected = crossed(traced, places[i], triangles[i]);
      RC_ASSERT(points[i].triangle == expected.triangle);
      RC_ASSERT(points[i].position == expected.position);
      RC_ASSERT(points[i].normal == expected.normal);
    }
  }));
}

} // namespace
} // namespace gnomon

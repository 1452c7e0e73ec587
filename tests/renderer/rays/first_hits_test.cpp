#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::addSquare;
using testing::GlbBuilder;
using testing::parallelView;
using testing::perspectiveView;
using testing::Traced;

TEST(FirstHits, LieInTheSurfaceWherePointAtPutsThePixel) {
  GlbBuilder builder;
  addSquare(builder, 10, 0);
  Traced traced(builder);
  traced.camera = perspectiveView({1, 4, 3}, {0.5, 0, 0}, 40);
  const std::vector<glm::vec2> places{{0.5f, 0.5f}, {31.25f, 40.75f}, {63.5f, 12.5f}};
  const std::vector<SurfacePoint> points = firstHits(traced.input(), places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(points[i].instance, 0u);
    EXPECT_EQ(points[i].normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(points[i].position.y, 0);
    const glm::dvec3 relative = points[i].position + traced.anchor() - traced.camera.eye;
    const double depth = glm::dot(relative, traced.camera.forward);
    const glm::dvec2 ndc(places[i].x / 32.0 - 1, 1 - places[i].y / 32.0);
    EXPECT_LT(glm::length(gnomon::pointAt(traced.camera, ndc, depth) - relative), 1e-12);
  }
}

TEST(FirstHits, AnEmptySceneHasNone) {
  Traced traced{GlbBuilder{}};
  traced.camera = perspectiveView({1, 4, 3}, {0, 0, 0}, 40);
  for (const SurfacePoint& point : traced.surface()) EXPECT_EQ(point.instance, kNoSurface);
}

/// Squares at heights 0, 1, 2 and 3, seen straight from above.
Traced floors() {
  GlbBuilder builder;
  for (const float y : {0.0f, 1.0f, 2.0f, 3.0f}) addSquare(builder, 5, y);
  Traced traced(builder);
  traced.width = traced.height = 2;
  return traced;
}

TEST(FirstHits, LieBetweenTheNearAndTheFarPlane) {
  Traced traced = floors();
  for (const bool perspective : {false, true}) {
    traced.camera = perspective ? perspectiveView({0.1, 10, 0.1}, {0.1, 0, 0.1}, 1) //
                                : parallelView({0.1, 10, 0.1}, {0, -1, 0}, 0.1);
    const auto height = [&](double near, double far) {
      traced.camera.near = near;
      traced.camera.far = far;
      const SurfacePoint point = traced.surface()[0];
      return point.instance == kNoSurface ? -1.0 : point.position.y + traced.anchor().y;
    };
    EXPECT_EQ(height(0.1, 1e6), 3);
    EXPECT_EQ(height(7.001, 1e6), 2);
    EXPECT_EQ(height(6.999, 1e6), 3);
    EXPECT_EQ(height(8.5, 8.9), -1);
    EXPECT_EQ(height(8.5, 8.999), -1);
    EXPECT_EQ(height(8.5, 9.001), 1);
    EXPECT_EQ(height(11, 1e6), -1) << "everything lies before the near plane";
  }
}

TEST(FirstHits, NothingBehindTheEyeIsSeenUnlessTheNearPlaneIs) {
  Traced traced = floors();
  traced.camera = perspectiveView({0.1, 1.5, 0.1}, {0.1, 0, 0.1}, 20);
  EXPECT_EQ(traced.surface()[0].position.y + traced.anchor().y, 1);
  traced.camera = parallelView({0.1, 1.5, 0.1}, {0, -1, 0}, 0.1);
  EXPECT_EQ(traced.surface()[0].position.y + traced.anchor().y, 1);
  traced.camera.near = -10; // orthographic views may begin behind the eye
  EXPECT_EQ(traced.surface()[0].position.y + traced.anchor().y, 3);
  traced.camera = perspectiveView({0.1, 4, 0.1}, {0.1, 8, 0.1}, 20);
  EXPECT_EQ(traced.surface()[0].instance, kNoSurface);
}

TEST(FirstHits, TheEyesDistanceTakesNothingFromTheirPrecision) {
  Traced traced = floors();
  traced.width = traced.height = 40;
  for (const double distance : {1e2, 1e5, 1e7}) {
    traced.camera = perspectiveView({0, distance + 3, 0}, {0, 0, 0}, 90);
    traced.camera.halfSize = glm::dvec2(5.1 / distance); // 10.2 m of the upper square's plane
    const std::vector<SurfacePoint> points = traced.surface();
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const SurfacePoint& point = points[std::size_t(40 * y + x)];
        const glm::dvec2 place = 5.1 * glm::dvec2((2.0 * x + 1) / 40 - 1, (2.0 * y + 1) / 40 - 1);
        const bool inside = std::max(std::abs(place.x), std::abs(place.y)) < 5;
        ASSERT_EQ(point.instance, inside ? 3u : kNoSurface) << distance << ": " << x << " " << y;
        if (!inside) continue;
        EXPECT_NEAR(point.position.x, place.x, 1e-6);
        EXPECT_NEAR(point.position.z, place.y, 1e-6);
      }
    }
  }
}

TEST(FirstHits, ASceneFarFromTheOriginIsSeenAsAtTheOrigin) {
  for (const double distance : {1e6, 1e7}) {
    GlbBuilder builder;
    testing::addSphere(builder, {0.25, 0.5, -0.125}, 1, 30);
    Traced here(builder);
    builder.json["nodes"][0]["translation"] = {distance, -distance, distance};
    Traced there(builder);
    here.camera = there.camera = perspectiveView({1, 2, 3}, {0, 0, 0}, 50);
    there.camera.eye += there.anchor() - here.anchor();
    here.lights = there.lights = {testing::sunAlong({1, -2, 0.5})};
    const std::vector<SurfacePoint> expected = here.surface();
    const std::vector<SurfacePoint> found = there.surface();
    int seen = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(found[i].instance, expected[i].instance);
      if (expected[i].instance == kNoSurface) continue;
      ++seen;
      EXPECT_LT(glm::length(found[i].position - expected[i].position), 1e-5);
    }
    EXPECT_GT(seen, 500);
    EXPECT_EQ(lightVisibility(there.input(), 0, found, 1), lightVisibility(here.input(), 0, expected, 1));
  }
}

} // namespace
} // namespace gnomon

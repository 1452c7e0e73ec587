#include "tests/renderer/reference/shapes.h"

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

} // namespace
} // namespace gnomon

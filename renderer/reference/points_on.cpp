#include "renderer/core/parallel.h"
#include "renderer/reference/camera_rays.h"
#include "renderer/reference/surface_point.h"
#include "renderer/reference/tree.h"

namespace gnomon {
namespace {

constexpr std::size_t kPointsAtOnce = 4096; ///< found by one core at a time

} // namespace

std::vector<SurfacePoint> pointsOn(const TraceInput& input, std::span<const glm::vec2> places,
                                   std::span<const PlacedTriangle> triangles) {
  const TracedScene::Tree& tree = input.traced.tree();
  const glm::dvec2 size(input.width, input.height);
  std::vector<SurfacePoint> points(places.size());
  forEachPiece(places.size(), kPointsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (triangles[i].instance == kNoSurface) continue;
      const SightLine line = sightLine(input.camera, tree.anchor, size, glm::dvec2(places[i]));
      const Triangle triangle = tree.triangle(triangles[i].instance, triangles[i].triangle);
      const Barycentric at = crossing(triangle, line.origin, line.direction, {1.0 / 3.0, 1.0 / 3.0});
      points[i] = surfacePoint(line.direction, triangles[i], triangle, at);
    }
  });
  return points;
}

} // namespace gnomon

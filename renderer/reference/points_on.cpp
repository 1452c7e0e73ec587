#include <algorithm>

#include "renderer/core/parallel.h"
#include "renderer/reference/crossings.h"
#include "renderer/reference/trace.h"

namespace gnomon {
namespace {

constexpr std::size_t kPointsAtOnce = 4096; ///< found by one core at a time

} // namespace

void pointsOn(const TraceInput& input, std::span<const glm::vec2> places, std::span<const PlacedTriangle> triangles,
              std::span<SurfacePoint> points) {
  const TracedScene::Tree& tree = input.traced.tree();
  const Sight sight = sightOf(input);
  Places at{};
  for (std::size_t first = 0; first < places.size(); first += kLanes) {
    const auto count = static_cast<unsigned>(std::min<std::size_t>(kLanes, places.size() - first));
    for (unsigned i = 0; i < count; ++i) {
      at.x[i] = places[first + i].x;
      at.y[i] = places[first + i].y;
    }
    const Crossings found = crossingsOf(sight, tree, at, triangles.subspan(first, count));
    for (unsigned i = 0; i < count; ++i) {
      const PlacedTriangle& on = triangles[first + i];
      points[first + i] = on.instance == kNoSurface ? SurfacePoint{} : found.point(i, on);
    }
  }
}

std::vector<SurfacePoint> pointsOn(const TraceInput& input, std::span<const glm::vec2> places,
                                   std::span<const PlacedTriangle> triangles) {
  std::vector<SurfacePoint> points(places.size());
  forEachPiece(places.size(), kPointsAtOnce, [&](std::size_t first, std::size_t last) {
    const std::size_t count = last - first;
    pointsOn(input, places.subspan(first, count), triangles.subspan(first, count),
             std::span(points).subspan(first, count));
  });
  return points;
}

} // namespace gnomon

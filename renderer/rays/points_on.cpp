#include <algorithm>

#include "renderer/core/parallel.h"
#include "renderer/rays/crossings.h"
#include "renderer/rays/drawn_points.h"

namespace gnomon {
namespace {

constexpr std::size_t kPointsAtOnce = 4096; ///< found by one core at a time

/// The float's word where it is sure; else lines and triangles in doubles decide, all sixteen.
void findExactly(const TraceInput& input, const DrawnPlaces& places, DrawnWeights& weights) {
  Places at;
  std::copy_n(places.x, kLanes, at.x);
  std::copy_n(places.y, kLanes, at.y);
  const Crossings found = crossingsOf(sightOf(input), input.traced.tree(), at, places.shown);
  for (unsigned i = 0; i < kLanes; ++i) {
    weights.u[i] = static_cast<float>(found.u[i]);
    weights.v[i] = static_cast<float>(found.v[i]);
  }
}

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

DrawnWeights TracedCamera::weights(const DrawnPlaces& places) const {
  DrawnPoints points;
  setTriangles(input_.traced.tree(), places, points);
  findPoints(*view_, places, points);
  DrawnWeights weights;
  int sure = -1;
  for (unsigned i = 0; i < kLanes; ++i) {
    weights.u[i] = points.u[i];
    weights.v[i] = points.v[i];
    sure &= places.shown[i].instance == kNoSurface ? -1 : points.sure[i];
  }
  if (sure == 0) findExactly(input_, places, weights);
  return weights;
}

DrawnSurfaces TracedCamera::surfaces(const DrawnPlaces& places) const {
  DrawnPoints points;
  setTriangles(input_.traced.tree(), places, points);
  findPoints(*view_, places, points);
  DrawnSurfaces surfaces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::copy_n(points.relative[axis], kLanes, surfaces.relative[axis]);
    std::copy_n(points.normal[axis], kLanes, surfaces.normal[axis]);
  }
  return surfaces;
}

} // namespace gnomon

#include <algorithm>

#include "renderer/reference/crossings.h"
#include "renderer/reference/drawn_points.h"
#include "renderer/reference/trace.h"

namespace gnomon {
namespace {

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

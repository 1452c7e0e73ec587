#include "renderer/reference/crossings.h"
#include "renderer/reference/drawn_points.h"
#include "renderer/reference/trace.h"

namespace gnomon {
namespace {

/// The float's word where it is sure; else lines and triangles in doubles decide, all sixteen.
void findExactly(const TraceInput& input, const DrawnPlaces& places, DrawnWeights& weights) {
  Places at{};
  Lines lines;
  Crossings found{};
  for (unsigned i = 0; i < kLanes; ++i) {
    at.x[i] = places.x[i];
    at.y[i] = places.y[i];
    if (places.shown[i].instance == kNoSurface) {
      found.setNothing(i);
    } else {
      found.setTriangle(input.traced.tree(), i, places.shown[i]);
    }
    found.u[i] = found.v[i] = 1.0 / 3.0;
  }
  setLines(sightOf(input), at, lines);
  cross(lines, input.traced.tree().scale, found);
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

} // namespace gnomon

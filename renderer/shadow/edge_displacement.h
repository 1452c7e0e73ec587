#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "renderer/shadow/shadow_plan.h"

/// How far an edge of a shadow is off because a map has texels and a bias: what EdgeDisplacement::mean is expected to
/// be, estimated without rays.
namespace gnomon {

/// How a map's texels are read where an edge is looked for.
struct MapReading {
  double taps = 1; ///< texels along a side that have equal weight, besides the bilinear lookup; a disc's are broken
  bool bilinear = true; ///< false = the texel under a point is taken as it is
  double scatter = 0;   ///< texels: mean distance between the edge and where a disc's few comparisons put it
};

/// What a tile's filter does, but for penumbras; `atlasSamples`: of a texel.
MapReading readingOf(const ShadowTile& tile, int atlasSamples);

/// The same where it is made over a disc of so many texels' radius: see common_shadow_disc.glsl.
MapReading overDisc(MapReading reading, double radius);

/// Texels: the mean distance between a straight edge and the line along which a map of it, sampled at texel centres,
/// says 0.5. Level at a quarter for an edge along the texels: it lies anywhere between two rows of centres, which is up
/// to half a texel from where they put it. Across the texels, the rows that a lookup weighs are cut at other places
/// each and make up for one another. `slope`: 0..1, the lesser of the edge normal's components over the greater.
double staircase(const MapReading& reading, double slope);

/// A straight edge on a plane, and the map there. Pixels of the picture.
struct EdgeOnTexels {
  glm::dvec2 across{1, 0}; ///< unit length: normal of the edge
  glm::dvec2 texelU{0};    ///< the two edges of a texel as they lie on the plane
  glm::dvec2 texelV{0};
  glm::dvec2 shift{0}; ///< from a point to where its bias has it looked up: what the map shows there is the shadow here
  double room = std::numeric_limits<double>::infinity(); ///< to the next edge of the shadow: this one is off no farther
};

/// Pixels: the mean area between where the map puts the edge and where it is, of each pixel of its length, as far as
/// metrics count it as misplaced and not as wrong: within 2 pixels of the edge's own pixels (error_metrics.h). 0 where
/// anything is not finite.
double expectedDisplacement(const EdgeOnTexels& edge, const MapReading& reading);

} // namespace gnomon

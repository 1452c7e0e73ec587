#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The errors that a plan promises; see PredictedError. Absent where no tile is drawn or none of its blocks is seen.
struct PredictedErrors {
  std::vector<std::optional<PredictedError>> tiles;  ///< one a tile of the plan
  std::vector<std::optional<PredictedError>> lights; ///< one a light of the plan
  std::optional<PredictedError> all;
};

/// A block of the survey that shows a surface, by the middle of its pixels: -1..1, y up; the nearest and the farthest
/// surface in it as view depths, and as points there, relative to the eye.
struct SeenBlock {
  glm::dvec2 ndc{0};
  std::array<double, 2> depths{};
  std::array<glm::dvec3, 2> points{};
};

struct SeenBlocks {
  glm::dvec2 pixels{0}; ///< of the frame
  std::vector<SeenBlock> blocks;
};

SeenBlocks seenBlocks(const CameraView& view, const ReceiverDepths& receivers);

/// m, pixels, for each block that a tile serves: the longer diagonal of the picture, to first order, of the texel under
/// the middle of the block, at its nearest surface that lies in the tile. None for a tile that is not drawn.
std::vector<float> texelExtents(const CameraView& view, const SeenBlocks& seen, const ShadowTile& tile);

/// The percentiles by nearest rank; absent for none.
std::optional<PredictedError> errorOf(std::vector<float> extents);

/// `plan`: of the input. Each light's errors are estimated only where it casts shadows.
PredictedErrors predictErrors(const PlanInput& input, const ShadowPlan& plan);

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
/// says 0.5: a quarter for an edge along the texels; less across them, where the rows that a lookup weighs make up for
/// one another. `slope`: 0..1, the lesser of the edge normal's components over the greater.
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
/// metrics count it as misplaced and not as wrong: within 2 pixels of the edge's own pixels (frame_report.h). 0 where
/// anything is not finite.
double expectedDisplacement(const EdgeOnTexels& edge, const MapReading& reading);

} // namespace gnomon

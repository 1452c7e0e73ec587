#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace gnomon::testing {

struct FrameDifference {
  std::string what;        ///< they must have in common but have not, as a sentence; empty = nothing
  bool otherPlans = false; ///< their tiles are planned otherwise, so that no view that shows maps was compared
};

/// Between two devices' frames of one spec. What is a fair difference, and left out:
/// - Corners snap to 1/256 of a pixel, each device in its own way, so a pixel whose centre lies at an edge may show
///   what is on the edge's other side. So may a texel of a map, at its own size. A pixel differs where the other
///   picture has nothing near its value (16 levels of 255; antialiased 32) within the 3 x 3 pixels around it, whichever
///   picture is asked for which; and one pixel in 100 and 4 besides may differ: what covers single pixels has no
///   neighbour that shows it, and what they show may make the depth range of cascades another one.
/// - Where depth ranges or matrices of tiles are further apart than rounding, so may be all that a map says: the result
///   tells of it, and how often it may be is for the caller to bound.
/// - A row of a level floor has one depth, and may lie where one cascade ends: one row of a view of tiles.
/// - Times, memory, and counts of what was drawn: each device culls in its own way.
FrameDifference differenceOf(const Frame& cpu, const Frame& gl);

} // namespace gnomon::testing

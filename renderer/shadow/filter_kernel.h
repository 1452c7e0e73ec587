#pragma once

#include "protocol/spec/shadow_options.h"

namespace gnomon {

/// How a shadow map is read.
enum class MapReadingKind {
  texels, ///< comparisons over a square of texels
  disc,   ///< comparisons over a disc of the world
  vsm,    ///< moments of blurred depths, as all that follow
  evsm,
  msm
};

/// What a filter reads around the point that it is asked for: all that any stage knows of a filter.
struct FilterKernel {
  MapReadingKind kind = MapReadingKind::texels;
  int size = 1;         ///< texels along a side that are compared or blurred; 1 with a radius
  double radius = 0;    ///< metres around the point that are read besides; 0 = none
  bool moments = false; ///< the map's depths are blurred, not compared one by one
  /// Texels along an axis to the farthest texel centre that gets a weight. A comparison is bilinear: it weighs centres
  /// up to 1 away. hard is one of them; pcf is `size` of them a texel apart, the outermost (size - 1) / 2 away. So it
  /// is the row's r + 0.5 with the bilinear kernel's r = size / 2: 1 (hard), 2, 3, 4 (pcf 3, 5, 7).
  /// Moments are blurred over as many texels and looked up bilinearly: the same. With a radius a tap's own: 1.
  double reach = 1;
  /// Texels that a tile keeps on each side, so that a lookup at the edge of what it serves stays inside: the reach, the
  /// half texel between a centre and its edge, and the rest of a texel for the rounding of coordinates.
  int border = 2;
};

FilterKernel kernelOf(const Filter& filter);

} // namespace gnomon

#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/environment/environment_map.h"

/// Light from all directions as surfaces reflect it, summed ahead.
namespace gnomon {

/// Octahedral maps (renderer/shaders/shared/octahedral.h) of an environment, all in one atlas, each with a border of
/// one texel that repeats what lies across its edges: a linear filter needs no other texel. Linear RGB, in the map's
/// directions and its unit.
struct PrefilteredEnvironment {
  /// RGB, row by row: GNOMON_ENVIRONMENT_WIDTH x GNOMON_ENVIRONMENT_HEIGHT of environment_squares.h. The squares of the
  /// levels hold mean radiance over the lobe of GGX about each direction, weighted by the cosine, seen along it (the
  /// first sum of Karis, "Real Shading in Unreal Engine 4", 2013); the last one irradiance over pi.
  std::vector<glm::vec4> texels;
  glm::dvec3 mean{0}; ///< radiance, over all directions
};

/// On all cores; the same for any number of them.
PrefilteredEnvironment prefiltered(const EnvironmentMap& map);

} // namespace gnomon

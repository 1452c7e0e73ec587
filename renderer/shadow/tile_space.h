#pragma once

#include <glm/glm.hpp>

#include "renderer/core/aabb.h"
#include "renderer/shadow/fit.h"

namespace gnomon {

/// How a tile's texels and depths lie in the world: light space, and the fit in it.
struct TileSpace {
  LightBasis basis;
  glm::dvec3 origin{0}; ///< of light space, relative to the eye: the plan's anchor (parallel light) or the light
  Fit fit;
  int size = 0; ///< texels along a side, border included
};

/// Light clip space from light space: x y in -1..1 over the whole tile, border included; z 0 nearest the light, 1
/// farthest. Affine for parallel light; else w is the distance from the light along its direction.
glm::dmat4 clipFromLight(const TileSpace& space);

/// The box around an eye-relative one, in light space.
Aabb lightSpaceBox(const TileSpace& space, const Aabb& relative);

/// The box around a box of light space, in clip space after the division by w; empty where all of it lies behind the
/// light.
Aabb clipBox(const TileSpace& space, const Aabb& boxLs);

} // namespace gnomon

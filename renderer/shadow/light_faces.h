#pragma once

#include <vector>

#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A pyramid of directions around a light that one tile can hold.
struct LightFace {
  LightBasis basis;
  double tanHalf = 1; ///< of the half angle to each side
};

/// The half angle, radians, up to which a spot's cone gets one tile. A wider one takes faces of a cube: at 60 degrees a
/// texel at the rim is already four times as large, seen from the light, as one in the middle.
double widestSingleTile();

/// The faces of a spot or point light: one for a spot that one tile can hold; for a wider spot those faces of a cube
/// turned along it that its cone touches; all six of a cube along the world's axes for a point light.
std::vector<LightFace> facesOf(const ShadowCaster& light);

} // namespace gnomon

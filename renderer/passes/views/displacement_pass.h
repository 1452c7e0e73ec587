#pragma once

#include <vector>

#include "renderer/passes/views/view_pass.h"

namespace gnomon {

/// What a light's map does to an edge of its shadow at a pixel's centre: see EdgeOnTexels. Pixels, y DOWN the picture.
struct MapFootprint {
  glm::vec2 texelU{0}; ///< 0 where no tile serves the pixel
  glm::vec2 texelV{0};
  glm::vec2 shift{0};
  glm::vec3 normal{0}; ///< of the triangle; unit length
  float viewDepth = 0; ///< metres; 0 = nothing that receives the light's shadow
  int tile = 0;        ///< among the light's
};

/// One a pixel, first row on top, of `shading.debugLight`. `surfaces`: one sample a pixel. Waits for the device.
/// REQUIRES: that light has tiles.
Result<std::vector<MapFootprint>> mapFootprints(const PassInputs& inputs, const ViewInputs& shading,
                                                const Surfaces& surfaces);

} // namespace gnomon

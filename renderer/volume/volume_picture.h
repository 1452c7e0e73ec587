#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// What a camera sees of surfaces.
struct SeenSurfaces {
  CameraView view;
  int width = 0;
  int height = 0;
  /// View depth of the surface in the middle of each pixel, metres, first row on top; infinite where none is. Those
  /// before the near plane count as at it.
  std::span<const float> depths{};
};

/// What volumes add to a picture, a value a pixel: red, green and blue are the radiance that they send, alpha is the
/// share of what is behind them that they let through: color = rgb + a * color of the surface. A white medium that
/// nothing dims sends as much as a white surface that faces the light, and `ambient`, the radiance from all around.
std::vector<glm::vec4> marchPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                    const glm::dvec3& ambient);

/// The share of the chosen light that volumes let through to the surface in each pixel; 1 where none is.
std::vector<float> volumeShadowPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                       const glm::dvec3& towards);

} // namespace gnomon

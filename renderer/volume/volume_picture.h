#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// What the samples of a picture show of surfaces. Pixels go row by row from the BOTTOM, each one's samples side by
/// side.
struct SeenSurfaces {
  CameraView view;
  int width = 0;
  int height = 0;
  std::span<const glm::vec2> places{}; ///< within a pixel, 0..1 from its lower left corner; 1 to 4 samples
  /// View depth of each sample, metres; infinite where no surface is. Those before the near plane count as at it.
  std::span<const float> depths{};
};

/// As SeenSurfaces has it, of what a depth buffer holds: 0 where no surface is.
inline float seenDepth(const CameraView& view, float depth) {
  return depth > 0 ? static_cast<float>(viewDepthOf(view, double{depth})) : std::numeric_limits<float>::infinity();
}

/// What volumes add to a picture, a value a pixel: red, green and blue are the radiance that they send, alpha is the
/// share of what is behind them that they let through: color = rgb + a * color of the surface. The mean over the depths
/// of the pixel's samples; the ray is that through its middle. A white medium that nothing dims sends as much as a
/// white surface that faces the light, and `ambient`, the radiance from all around.
std::vector<glm::vec4> marchPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                    const glm::dvec3& ambient);

/// The share of the chosen light that volumes let through to the surface in each sample, as shares of 65535; all where
/// none is.
std::vector<std::uint16_t> volumeShadowPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                               const glm::dvec3& towards);

} // namespace gnomon

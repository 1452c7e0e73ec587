#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/volume/medium.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

inline constexpr double kStepVoxels = 0.5;

/// What media send along a ray to its origin, and what they let through of the light behind them.
struct Marched {
  glm::dvec3 color{0};
  double transmittance = 1;
};

/// The light at a place (of the unit cube) of one of the media, as its color would scatter it.
using LightAt = std::function<glm::dvec3(std::size_t medium, const glm::dvec3& unit)>;

/// Front to back through all media at once, within a piece of the ray (metres; `to` may be infinite), in steps of
/// `stepVoxels` of the finest, longer in ways through more than 512 voxels. A homogeneous medium is exact at any step
/// (Beer-Lambert); where hardly any light is left, transmittance is 0.
Marched march(std::span<const Medium* const> media, const Ray& ray, const Interval& piece, const LightAt& lightAt,
              double stepVoxels = kStepVoxels);

/// The integral of the extinction of all media over a piece of the ray: what is let through is exp(-it).
double opticalDepth(std::span<const Medium* const> media, const Ray& ray, const Interval& piece,
                    double stepVoxels = kStepVoxels);

/// The surfaces in the samples of a picture, pixels row by row from the BOTTOM, samples side by side.
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

/// What volumes add to a picture, a value a pixel: color = rgb + a * color of the surface, the mean over the depths of
/// its samples. `ambient`: radiance from all around.
std::vector<glm::vec4> marchPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                    const glm::dvec3& ambient);

/// The share of the chosen light that volumes let through to the surface in each sample, 0..65535; 65535 without a
/// surface.
std::vector<std::uint16_t> volumeShadowPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                               const glm::dvec3& towards);

} // namespace gnomon

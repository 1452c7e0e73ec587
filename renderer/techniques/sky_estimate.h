#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/core/vectors.h"
#include "renderer/environment/frame_sampler.h"
#include "renderer/rays/pixel_places.h"
#include "renderer/rays/sky_rays.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// What rays say of a surface's share of such light: the sums of what would arrive without casters, and of what does
/// (a ratio estimator: where nothing is hidden it is 1, without noise).
struct SkySums {
  glm::vec3 open{0}, arriving{0};           ///< diffuse: radiance times cosine, linear RGB
  float openMirror = 0, arrivingMirror = 0; ///< in the lobe around the mirrored direction: luminance
};

/// The rays `first` up to `last` of a pixel.
struct SkyRays {
  std::uint32_t first, last;
};

/// How many rays look around the mirrored direction besides so many diffuse ones, where the lobe is narrow.
inline std::uint32_t mirrorRays(std::uint32_t rays) {
  return (rays + 3) / 4;
}

/// Where they go, of pixels that send so many at first, and four times as many in all.
struct SkyRayPlaces {
  explicit SkyRayPlaces(std::uint32_t first)
      : diffuse(first, 4 * first), mirrored(mirrorRays(first), mirrorRays(4 * first)) {}

  PixelPlaces diffuse, mirrored;
};

/// Adds what rays see to `sums`, one each of what is shown; nothing where no shadow is shown. Diffuse rays go by the
/// cosine of the normal that a picture shades by, or by where light comes from, as EnvironmentSampler::share says, and
/// count as both would have it (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
/// 1995: the balance heuristic), and so do these and those around the mirrored direction for what is mirrored. Rays
/// below the triangle's plane do not count. Gives how many rays were sent. REQUIRES: packet.start of what is shown.
std::uint64_t addSky(const SkyLight& sky, SkyPacket& packet, const ShownSamples& shown, const SkyRayPlaces& places,
                     const SkyRays& rays, SkySums* sums);

} // namespace gnomon

#pragma once

#include <cstdint>

#include "renderer/core/vectors.h"
#include "renderer/techniques/picture_points.h"
#include "renderer/techniques/sky_estimate.h"

namespace gnomon {

/// What the scene hides of an environment, over a picture.
struct SkyShadow {
  /// Share of its light that arrives at every sample, of 65535, in the grid's order: rgb of what is reflected
  /// diffusely, a of what is mirrored.
  UnfilledVector<glm::u16vec4> values;
  std::uint64_t tracedPixels = 0;
  std::uint64_t rays = 0;
};

/// `samples`: diffuse rays a pixel, at first; four times as many where neighbours disagree. The samples of a pixel
/// that show other surfaces than its first one have shares of their own. All arrives where no surface is, or one that
/// shows no shadows.
SkyShadow skyShadow(const PicturePoints& points, const SkyLight& sky, int samples);

} // namespace gnomon

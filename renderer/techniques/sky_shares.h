#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/core/vectors.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// What is known so far, pixel by pixel, of the share of an environment's light that arrives: at what each pixel's
/// first sample shows.
struct SkyShares {
  explicit SkyShares(const SampleGrid& picture)
      : grid(picture),
        shares(picture.pixels()),
        weights(picture.pixels()),
        mirrors(picture.pixels()),
        rays(picture.pixels()) {}

  const SampleGrid& grid;
  UnfilledVector<glm::u16vec4> shares; ///< of 65535: rgb of the diffuse light, a of the mirrored
  UnfilledVector<float> weights;       ///< luminance that rays asked about, diffuse; 0 = nothing is known
  UnfilledVector<float> mirrors;       ///< the same of the mirrored
  std::vector<std::uint16_t> rays;     ///< diffuse ones that were sent; 0 = no surface that shows shadows

  void clear(std::uint32_t pixel) {
    shares[pixel] = glm::u16vec4(65535);
    weights[pixel] = 0;
    mirrors[pixel] = 0;
  }
};

/// Few rays leave noise, while most of a sky's shadow is smooth: fits planes to the shares of one surface around each
/// pixel, over 9 x 9 pixels where they vary no more than noise would have them, else over 5 x 5, else a pixel keeps its
/// own. Contacts stay sharp by that.
UnfilledVector<glm::u16vec4> evenedOut(const PicturePoints& points, const SkyShares& shares);

/// The pixels that vary more from a plane through 5 x 5 pixels than noise would have them: 1 there, one a pixel.
std::vector<std::uint8_t> uneven(const PicturePoints& points, const SkyShares& shares);

} // namespace gnomon

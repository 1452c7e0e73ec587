#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/texture.h"

namespace gnomon {

/// What exact techniques say of every sample of the picture: the share of each of their lights that arrives, before the
/// shadow's strength. A layer a light.
struct VisibilityLayers {
  gl::Texture
      texture; ///< array of R16 (one sample a pixel) or RGBA16 (four: a channel a sample); empty = no such light
};

/// Layers of undefined texels. More bytes than a frame may take are a problem at /lights.
Result<VisibilityLayers> makeVisibilityLayers(int width, int height, int samples, int layers);

/// Writes one layer: a value for each sample, 0..65535, pixel by pixel, the picture's LOWEST row first.
void writeVisibility(VisibilityLayers& layers, int layer, std::span<const std::uint16_t> values);

} // namespace gnomon

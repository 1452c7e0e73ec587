#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/spec/traits.h"
#include "renderer/image/image.h"

/// How a device hands out what it drew.
namespace gnomon {

/// The channels of a view's picture, in their order. `encoded`, `opaque`: as in ViewRequest.
std::vector<std::string> channelsOf(View view, bool encoded, bool opaque);

/// A share 0..1 as a byte; what lies beyond is clipped.
inline std::uint8_t unormByte(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

/// The picture, first row on top, of depths 0..1 whose LOWEST row comes first: grey where `encoded`, else as they are.
Image depthImage(int width, int height, const std::vector<float>& depths, bool encoded);

} // namespace gnomon

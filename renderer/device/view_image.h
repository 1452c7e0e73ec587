#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "protocol/spec/output_options.h"
#include "protocol/spec/traits.h"
#include "renderer/core/srgb.h"
#include "renderer/image/image.h"

/// How a device hands out what it drew.
namespace gnomon {

/// The channels of a view's picture, in their order. `encoded`, `opaque`: as in ViewRequest.
std::vector<std::string> channelsOf(View view, bool encoded, bool opaque);

/// A share 0..1 as a number of 8 or 16 bits, the highest for 1; what lies beyond is clipped.
template <class Number>
Number unorm(float share) {
  constexpr float kHighest = std::numeric_limits<Number>::max();
  return static_cast<Number>(std::lround(std::clamp(share, 0.0f, 1.0f) * kHighest));
}

inline std::uint8_t unormByte(float share) {
  return unorm<std::uint8_t>(share);
}

/// Channel `channel` of a view that is encoded with 16 bits; `linear`: what was drawn.
inline std::uint16_t fineWord(const ViewTraits& view, std::size_t channel, float linear) {
  const bool light = view.srgb && channel < 3;
  return unorm<std::uint16_t>(light ? srgbOf(std::clamp(linear, 0.0f, 1.0f)) : linear);
}

/// The picture, first row on top, of depths 0..1 whose LOWEST row comes first: grey where `encoded`, of 16 bits where
/// it is also `fine`; else as they are.
Image depthImage(int width, int height, const std::vector<float>& depths, bool encoded, bool fine);

/// A view whose `wordsAreNumbers`, in 16 bits, from its numbers: depths in whole millimetres, indices as they are.
/// 65535 = nothing, or more than fits. REQUIRES: one channel of floats.
Image wordsOf(const Image& numbers, View view);

} // namespace gnomon

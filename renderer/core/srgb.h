#pragma once

#include <cmath>

namespace gnomon {

/// A linear share 0..1 as sRGB has it (IEC 61966-2-1), 0..1.
inline float srgbOf(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

} // namespace gnomon

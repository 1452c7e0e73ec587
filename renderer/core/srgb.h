#pragma once

#include <cmath>

namespace gnomon {

/// A linear share 0..1 as sRGB has it (IEC 61966-2-1), 0..1.
inline float srgbOf(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Back: of a share 0..1 as sRGB has it the linear one.
inline double linearOf(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace gnomon

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

/// A problem where what is kept of each pixel takes more than a frame may have for it (Limits::maxVisibilityBytes).
inline Status checkVisibilityBytes(std::int64_t bytes, const std::string& pointer, const std::string& detail) {
  if (bytes <= kLimits.maxVisibilityBytes) return Done{};
  return Problem{ProblemCode::tooLarge, pointer, detail, std::to_string(kLimits.maxVisibilityBytes) + " bytes",
                 std::to_string(bytes) + " bytes"};
}

/// Of what rays and shadow volumes say of lights, two bytes at each sample of a picture.
inline std::int64_t visibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return std::int64_t{2} * width * height * static_cast<std::int64_t>(samples * lights);
}

inline Status checkVisibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return checkVisibilityBytes(
      visibilityBytes(width, height, samples, lights), "/lights",
      "What rays and shadow volumes decide for every sample and light would take more memory than a frame may have.");
}

} // namespace gnomon

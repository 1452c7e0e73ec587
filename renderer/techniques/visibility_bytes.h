#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/core/visibility_limit.h"

namespace gnomon {

/// A problem where what rays and shadow volumes say of lights, two bytes at each sample of a picture, is more than a
/// frame may have. To be asked before memory is taken for it.
inline Status checkVisibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return checkVisibilityBytes(
      std::int64_t{2} * width * height * static_cast<std::int64_t>(samples * lights), "/lights",
      "What rays and shadow volumes decide for every sample and light would take more memory than a frame may have.");
}

} // namespace gnomon

#pragma once

#include <cstdint>

#include "protocol/base/result.h"

namespace gnomon {

/// What rays and shadow volumes say of lights at each sample of a picture: two bytes each.
inline std::int64_t visibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return std::int64_t{2} * width * height * static_cast<std::int64_t>(samples * lights);
}

/// A problem where that is more than a frame may have (Limits::maxVisibilityBytes), before memory is taken for it.
Status checkVisibilityBytes(std::int64_t bytes);

} // namespace gnomon

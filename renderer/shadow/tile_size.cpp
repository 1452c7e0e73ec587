#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gnomon {

int askedTileSize(ShadowSize size, int baseSize, int frameWidth, int frameHeight) {
  const int longest = std::max(frameWidth, frameHeight);
  if (longest <= 0 || baseSize <= 0) return 0;
  // In eighths of a texel every factor is a whole power of two, and nextPowerOfTwo scales with it.
  const int doublings = static_cast<int>(size) - static_cast<int>(ShadowSize::XSmall);
  const std::uint64_t byFrame = std::bit_ceil(static_cast<std::uint64_t>(longest)) << doublings;
  const std::uint64_t byBase = static_cast<std::uint64_t>(baseSize) << doublings;
  return static_cast<int>(std::max<std::uint64_t>(1, std::min(byFrame, byBase) / 8));
}

} // namespace gnomon

#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gnomon {

int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize) {
  if (lightSize <= 0 || baseSize <= 0) return 0;
  // In 32nds of a texel every factor is a whole power of two, and nextPowerOfTwo scales with it.
  const int doublings = static_cast<int>(size) - static_cast<int>(ShadowSize::XSmall) + static_cast<int>(importance) -
                        static_cast<int>(ShadowImportance::low);
  const std::uint64_t byLight = std::bit_ceil(static_cast<std::uint64_t>(lightSize)) << doublings;
  const std::uint64_t byBase = static_cast<std::uint64_t>(baseSize) << doublings;
  return static_cast<int>(std::max<std::uint64_t>(1, std::min(byLight, byBase) / 32));
}

} // namespace gnomon

#pragma once

#include <cstdint>
#include <limits>

namespace gnomon {

inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// One triangle of one instance.
struct PlacedTriangle {
  std::uint32_t instance = kNoSurface; ///< index into SceneView::instances; kNoSurface = none
  std::uint32_t triangle = 0;          ///< of its primitive
};

} // namespace gnomon

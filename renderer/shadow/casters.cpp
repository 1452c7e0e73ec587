#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

// Along each clip axis the box reaches as far as its half extents do through the absolute matrix (Arvo, Graphics Gems
// 1990). Towards the light nothing limits a caster: whatever stands before z 0 is drawn with its depth clamped.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds) {
  if (tile.rect.width <= 0 || casterBounds.empty()) return false;
  // Far above the rounding of doubles, far below the half texel between a tile's edge and its outermost texel centre.
  constexpr double kRounding = 1e-9;
  const Aabb clip = transformed(tile.clipFromRelative, casterBounds);
  const bool outside = clip.min.x > 1.0 + kRounding || clip.max.x < -1.0 - kRounding || clip.min.y > 1.0 + kRounding ||
                       clip.max.y < -1.0 - kRounding || clip.min.z > 1.0 + kRounding;
  return !outside;
}

} // namespace gnomon

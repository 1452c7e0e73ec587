#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

// Along each clip axis the box reaches as far as its half extents do through the absolute matrix (Arvo, Graphics Gems
// 1990). Towards the light nothing limits a caster: whatever stands before z 0 is drawn with its depth clamped.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds) {
  if (tile.rect.width <= 0 || casterBounds.empty()) return false;
  const Aabb clip = clipBox(tile.space, lightSpaceBox(tile.space, casterBounds));
  return !clip.empty() && tile.receivers.mayShadow(clip);
}

} // namespace gnomon

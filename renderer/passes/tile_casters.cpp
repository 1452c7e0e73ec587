#include "renderer/passes/tile_casters.h"

#include <algorithm>

namespace gnomon {

DrawList castersInto(const ShadowTile& tile, const Scene& scene, const SceneView& view, const FrameGeometry& geometry) {
  std::vector<std::uint8_t> keep(geometry.slotCount());
  std::transform(geometry.slotBounds.begin(), geometry.slotBounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayCastInto(tile, box)); });
  const DrawUse use = tile.space.fit.perspective ? DrawUse::castFromPoint : DrawUse::cast;
  return buildDrawList(scene, view, geometry, use, keep);
}

} // namespace gnomon

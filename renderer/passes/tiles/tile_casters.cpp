#include "renderer/passes/tiles/tile_casters.h"

#include <algorithm>

namespace gnomon {

TileCasters castersInto(const ShadowTile& tile, const Light& light, const SceneView& view,
                        const FrameGeometry& geometry, std::span<const NodeSwitches> nodes) {
  TileCasters casters;
  casters.use = tile.space.fit.perspective ? DrawUse::castFromPoint : DrawUse::cast;
  casters.slots.resize(geometry.slotCount());
  std::transform(geometry.slotBounds.begin(), geometry.slotBounds.end(), casters.slots.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayCastInto(tile, box)); });
  keepNodes(
      nodes, view, geometry, [&](const NodeSwitches& node) { return castsFrom(light, node); }, casters.slots);
  return casters;
}

std::vector<const Light*> lightsOfTiles(const ShadowPlan& plan, std::span<const Light> lights) {
  std::vector<const Light*> of(plan.tiles.size());
  for (const PlannedLight& planned : plan.lights) {
    std::fill_n(of.begin() + planned.firstTile, planned.tileCount, &lights[static_cast<std::size_t>(planned.light)]);
  }
  return of;
}

} // namespace gnomon

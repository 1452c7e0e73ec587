#include "renderer/prepare/tile_casters.h"

#include <algorithm>

#include "protocol/base/bytes.h"
#include "renderer/core/stop.h"

namespace gnomon {
namespace {

template <class T>
void append(TileKey& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

TileCasters castersInto(const ShadowTile& tile, const Light& light, const SceneView& view,
                        const FrameGeometry& geometry, std::span<const NodeSwitches> nodes) {
  stopIfAsked();
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

// The tile's place counts: rasterizing elsewhere may round otherwise.
TileKey tileKey(std::uint64_t scene, int view, const ShadowTile& tile, const Light& light, const TileCasters& casters,
                int samples) {
  TileKey key;
  append(key, scene);
  append(key, view);
  append(key, glm::mat4(tile.clipFromAnchored));
  append(key, tile.rect);
  append(key, samples);
  append(key, casters.use);
  append(key, light.shadow->blendedCasters);
  append(key, light.shadow->technique);
  append(key, tile.filter.kind);
  append(key, tile.filter.size);
  append(key, tile.space.fit.radius);
  // Moments are of depths between these; those of parallel light, linear as they are, know no distances.
  if (tile.space.fit.perspective) append(key, glm::vec2(tile.near, tile.far));
  Sha256 slots; // which may be a byte for every few triangles of the scene
  slots.add(casters.slots);
  const Bytes digest = slots.bytes();
  key.append(digest.begin(), digest.end());
  return key;
}

} // namespace gnomon

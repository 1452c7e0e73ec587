#include "renderer/prepare/cluster_choice.h"

#include <algorithm>
#include <tuple>

#include "protocol/base/bytes.h"
#include "renderer/core/stop.h"

namespace gnomon {

std::vector<std::uint8_t> slotsInView(const SurveyInput& input) {
  const Frustum frustum = frustumOf(input.camera);
  std::vector<std::uint8_t> keep(input.geometry.slotCount());
  std::transform(input.geometry.slotBounds.begin(), input.geometry.slotBounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayIntersect(frustum, box)); });
  keepNodes(
      input.nodes, input.view, input.geometry, [](const NodeSwitches& node) { return node.visible; }, keep);
  return keep;
}

namespace {

/// Below this, finding what is hidden takes longer than drawing it.
constexpr std::uint64_t kTrianglesWorthHiding = 1u << 16;
/// The share of the triangles in view, the nearest ones, that is drawn first to hide others.
constexpr double kFirstShare = 0.12;

std::uint64_t trianglesIn(const SurveyInput& input, std::uint32_t slot, std::size_t instance) {
  const Primitive& primitive =
      input.scene.primitives[static_cast<std::size_t>(input.view.instances[instance].primitive)];
  const std::uint32_t first = (slot - input.geometry.firstSlot[instance]) * kClusterTriangles;
  return std::min(kClusterTriangles, primitive.indexCount / 3 - first);
}

template <class T>
void append(TileKey& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

std::vector<std::uint8_t> firstToDraw(const SurveyInput& input, const std::vector<std::uint8_t>& inView) {
  struct Seen {
    double nearest;
    std::uint32_t slot;
    std::uint64_t triangles;
  };
  std::vector<Seen> seen;
  std::uint64_t total = 0;
  for (std::size_t instance = 0; instance < input.view.instances.size(); ++instance) {
    for (std::uint32_t slot = input.geometry.firstSlot[instance]; slot < input.geometry.firstSlot[instance + 1];
         ++slot) {
      if (inView[slot] == 0) continue;
      const Aabb& box = input.geometry.slotBounds[slot];
      const double nearest =
          glm::dot(box.center(), input.camera.forward) - glm::dot(box.halfExtent(), glm::abs(input.camera.forward));
      seen.push_back({nearest, slot, trianglesIn(input, slot, instance)});
      total += seen.back().triangles;
    }
  }
  if (total < kTrianglesWorthHiding) return inView;
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return std::tie(a.nearest, a.slot) < std::tie(b.nearest, b.slot); });
  std::vector<std::uint8_t> first(inView.size());
  auto left = static_cast<std::int64_t>(kFirstShare * static_cast<double>(total));
  for (const Seen& each : seen) {
    if (left <= 0) break;
    first[each.slot] = 1;
    left -= static_cast<std::int64_t>(each.triangles);
  }
  return first;
}

std::vector<std::uint8_t> slotsOfGroups(const FrameGeometry& geometry, std::uint32_t groups,
                                        std::vector<std::uint8_t> marked) {
  for (std::size_t i = 0; i < geometry.instances.size(); ++i) {
    if ((groups >> geometry.instances[i].group & 1u) != 0) continue;
    std::fill(marked.begin() + geometry.firstSlot[i], marked.begin() + geometry.firstSlot[i + 1], std::uint8_t{0});
  }
  return marked;
}

std::vector<std::uint8_t> without(std::span<const std::uint8_t> marked, std::span<const std::uint8_t> done) {
  std::vector<std::uint8_t> rest(marked.size());
  std::transform(marked.begin(), marked.end(), done.begin(), rest.begin(),
                 [](std::uint8_t mark, std::uint8_t no) { return static_cast<std::uint8_t>(mark != 0 && no == 0); });
  return rest;
}

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

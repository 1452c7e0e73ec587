#include "renderer/prepare/draw_list.h"

#include <algorithm>

namespace gnomon {

namespace {

struct Run {
  DrawState state;
  std::uint32_t instance = 0;
  std::uint32_t firstCluster = 0; ///< of the primitive
  std::uint32_t clusterCount = 0;
};

bool isCast(DrawUse use) {
  return use == DrawUse::cast || use == DrawUse::castFromPoint;
}

/// True where only front faces are drawn.
bool isCulled(const Primitive& primitive, const Material& material, DrawUse use) {
  switch (use) {
    case DrawUse::survey:
    case DrawUse::surface:
      return !material.doubleSided;
    case DrawUse::cast:
      return primitive.solid && stopsAllLight(material);
    case DrawUse::castFromPoint:
      return false;
  }
  return false;
}

DrawState stateOf(const Scene& scene, const Instance& instance, DrawUse use) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const int materialIndex = materialOf(scene, instance);
  const Material& material = scene.materials[static_cast<std::size_t>(materialIndex)];
  DrawState state;
  if (use == DrawUse::surface || readsMaterial(material, use)) state.material = materialIndex;
  if (isCulled(primitive, material, use)) {
    const bool mirrored = glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0;
    state.facing = mirrored ? Facing::clockwise : Facing::counterClockwise;
  }
  state.tangents = use == DrawUse::surface && primitive.hasTangents && material.normal;
  return state;
}

void addRuns(const Scene& scene, const Instance& instance, std::uint32_t index, DrawUse use,
             std::span<const std::uint8_t> keep, std::vector<Run>& runs) {
  const auto count = static_cast<std::uint32_t>(keep.size());
  std::uint32_t cluster = 0;
  while (cluster < count) {
    if (keep[cluster] == 0) {
      ++cluster;
      continue;
    }
    const std::uint32_t first = cluster;
    while (cluster < count && keep[cluster] != 0) ++cluster;
    runs.push_back({stateOf(scene, instance, use), index, first, cluster - first});
  }
}

} // namespace

bool readsMaterial(const Material& material, DrawUse use) {
  return isCast(use) ? !stopsAllLight(material) : hasHoles(material);
}

DrawList buildDrawList(const Scene& scene, const SceneView& view, const FrameGeometry& geometry, DrawUse use,
                       std::span<const std::uint8_t> keep) {
  std::vector<Run> runs;
  for (std::uint32_t i = 0; i < view.instances.size(); ++i) {
    const std::uint32_t first = geometry.firstSlot[i];
    addRuns(scene, view.instances[i], i, use, keep.subspan(first, geometry.firstSlot[i + 1] - first), runs);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.state < b.state; });

  DrawList list;
  for (const Run& run : runs) {
    const Instance& instance = view.instances[run.instance];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    const std::uint32_t firstIndex = run.firstCluster * kClusterTriangles * 3;
    const std::uint32_t indexCount =
        std::min(run.clusterCount * kClusterTriangles * 3, primitive.indexCount - firstIndex);
    if (list.groups.empty() || run.state != list.groups.back()) list.groups.push_back({run.state, list.ranges.size()});
    ++list.groups.back().rangeCount;
    list.ranges.push_back({indexCount, 1, primitive.firstIndex + firstIndex,
                           static_cast<std::int32_t>(primitive.baseVertex), run.instance});
    list.triangles += indexCount / 3;
  }
  return list;
}

TriangleNumbers::TriangleNumbers(const Scene& scene, const SceneView& view, const DrawList& list) {
  draws_.reserve(list.ranges.size());
  std::uint32_t number = 0;
  for (const DrawRange& range : list.ranges) {
    const Instance& instance = view.instances[range.instance];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    draws_.push_back({number, {range.instance, (range.firstIndex - primitive.firstIndex) / 3}});
    number += range.indexCount / 3;
  }
}

TriangleNumbers::TriangleNumbers(const FrameGeometry& geometry) {
  draws_.reserve(geometry.instances.size());
  for (std::uint32_t i = 0; i < geometry.instances.size(); ++i) {
    if (geometry.firstSlot[i] == geometry.firstSlot[i + 1]) continue;
    draws_.push_back({geometry.firstSlot[i] * kClusterTriangles, {i, 0}});
  }
}

std::vector<PlacedTriangle> TriangleNumbers::of(std::span<const std::uint32_t> numbers) const {
  std::vector<PlacedTriangle> triangles(numbers.size());
  of(numbers, triangles);
  return triangles;
}

void TriangleNumbers::of(std::span<const std::uint32_t> numbers, std::span<PlacedTriangle> triangles) const {
  std::size_t draw = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == kNoNumber) {
      triangles[i] = {};
      continue;
    }
    const std::uint32_t number = numbers[i];
    const bool sameDraw =
        number >= draws_[draw].firstNumber && (draw + 1 == draws_.size() || number < draws_[draw + 1].firstNumber);
    if (!sameDraw) {
      const auto after = std::upper_bound(draws_.begin(), draws_.end(), number,
                                          [](std::uint32_t n, const Draw& d) { return n < d.firstNumber; });
      draw = static_cast<std::size_t>(after - draws_.begin()) - 1;
    }
    const Draw& found = draws_[draw];
    triangles[i] = {found.first.instance, found.first.triangle + (number - found.firstNumber)};
  }
}

} // namespace gnomon

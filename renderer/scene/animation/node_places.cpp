#include "renderer/scene/animation/node_places.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <utility>

#include "renderer/core/linear_algebra.h"
#include "renderer/scene/found_nodes.h"

namespace gnomon {

namespace {

void addParts(const NodeOptions& entry, NodePlace& place) {
  if (entry.matrix) {
    place = {.node = place.node, .matrix = glm::make_mat4(entry.matrix->data())};
    return;
  }
  place.matrix.reset();
  if (entry.translation) place.translation = toVector(*entry.translation);
  if (entry.rotation) {
    const auto& [x, y, z, w] = *entry.rotation;
    const glm::dquat rotation(w, x, y, z);
    place.rotation = rotation / glm::length(rotation);
  }
  if (entry.scale) place.scale = toVector(*entry.scale);
}

} // namespace

bool hasPlace(const NodeOptions& entry) {
  return entry.matrix || entry.translation || entry.rotation || entry.scale;
}

Result<std::vector<NodePlace>> nodePlaces(std::span<const NodeOptions> entries, const Scene& scene) {
  std::vector<NodePlace> places;
  if (std::ranges::none_of(entries, hasPlace)) return places;
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> placeOf(scene.nodes.size(), kNone);
  NodeFinder finder(scene);
  ProblemList problems;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!hasPlace(entries[i])) continue;
    const auto found = finder.find(*entries[i].node, "/nodes/" + std::to_string(i) + "/node");
    if (!found) {
      for (const Problem& problem : found.problems()) problems.add(problem);
      continue;
    }
    for (const std::size_t node : *found) {
      if (placeOf[node] == kNone) {
        placeOf[node] = places.size();
        places.push_back({.node = node});
      }
      NodePlace& place = places[placeOf[node]];
      addParts(entries[i], place);
      place.entry = i;
    }
  }
  if (!problems.empty()) return std::move(problems).take();
  std::ranges::sort(places, {}, &NodePlace::node);
  return places;
}

LocalTransform moved(LocalTransform local, const NodePlace& place) {
  local.matrix = place.matrix;
  local.translation = place.translation.value_or(local.translation);
  local.rotation = place.rotation.value_or(local.rotation);
  local.scale = place.scale.value_or(local.scale);
  return local;
}

} // namespace gnomon

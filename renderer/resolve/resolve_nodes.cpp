#include "renderer/resolve/resolve_nodes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/found_nodes.h"

namespace gnomon {
namespace {

/// Brings the switches that `entry` sets.
void addSwitches(const NodeOptions& entry, NodeOptions& switches) {
  if (entry.visible) switches.visible = entry.visible;
  if (entry.castShadow) switches.castShadow = entry.castShadow;
  if (entry.receiveShadow) switches.receiveShadow = entry.receiveShadow;
  if (entry.layers) switches.layers = entry.layers;
}

/// What the entries say of each node itself.
Result<std::vector<NodeOptions>> ownSwitches(std::span<const NodeOptions> entries, const Scene& scene) {
  std::vector<NodeOptions> own(scene.nodes.size());
  NodeFinder finder(scene);
  ProblemList problems;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto found = finder.find(*entries[i].node, "/nodes/" + std::to_string(i) + "/node");
    if (found) {
      for (const std::size_t node : *found) addSwitches(entries[i], own[node]);
    } else {
      for (const Problem& problem : found.problems()) problems.add(problem);
    }
  }
  if (!problems.empty()) return std::move(problems).take();
  return own;
}

/// Each node's own switches, and for the rest those of the nodes above it.
void inherit(const Scene& scene, std::vector<NodeOptions>& own) {
  std::vector<bool> done(own.size());
  std::vector<std::size_t> path;
  for (std::size_t node = 0; node < own.size(); ++node) {
    path.clear();
    for (int up = static_cast<int>(node); up >= 0 && !done[static_cast<std::size_t>(up)];) {
      path.push_back(static_cast<std::size_t>(up));
      up = scene.nodes[path.back()].parent;
    }
    for (auto below = path.rbegin(); below != path.rend(); ++below) {
      done[*below] = true;
      const int parent = scene.nodes[*below].parent;
      if (parent < 0) continue;
      NodeOptions switches = own[static_cast<std::size_t>(parent)];
      addSwitches(own[*below], switches);
      own[*below] = std::move(switches);
    }
  }
}

NodeSwitches settled(const NodeOptions& options) {
  NodeSwitches switches;
  switches.visible = options.visible.value_or(switches.visible);
  switches.castShadow = options.castShadow.value_or(switches.visible);
  switches.receiveShadow = options.receiveShadow.value_or(switches.receiveShadow);
  switches.layers = options.layers.value_or(switches.layers);
  return switches;
}

} // namespace

Result<std::vector<NodeSwitches>> resolveNodes(std::span<const NodeOptions> entries, const Scene& scene) {
  std::vector<NodeSwitches> nodes;
  if (entries.empty()) return nodes;
  auto own = ownSwitches(entries, scene);
  if (!own) return own.problems();
  inherit(scene, *own);
  std::transform(own->begin(), own->end(), std::back_inserter(nodes), settled);
  return nodes;
}

LayersInUse layersInUse(const SceneView& view, std::span<const NodeSwitches> nodes) {
  if (nodes.empty()) return {};
  LayersInUse used{0, 0};
  for (const Instance& instance : view.instances) {
    const NodeSwitches& node = nodes[static_cast<std::size_t>(instance.node)];
    if (node.castShadow) used.casting |= node.layers;
    if (node.visible && node.receiveShadow) used.receiving |= node.layers;
  }
  return used;
}

Result<ReceiverGroups> resolveReceiverGroups(const SceneView& view, std::span<const NodeSwitches> nodes,
                                             std::span<const Light> lights) {
  ReceiverGroups groups;
  std::map<std::pair<int, bool>, std::size_t> members;
  if (nodes.empty()) members.try_emplace({NodeSwitches{}.layers, NodeSwitches{}.receiveShadow}, 0);
  if (!nodes.empty()) groups.ofInstance.resize(view.instances.size());
  for (std::size_t i = 0; i < groups.ofInstance.size(); ++i) {
    const NodeSwitches& node = nodes[static_cast<std::size_t>(view.instances[i].node)];
    if (!node.visible) continue;
    const auto group = members.try_emplace({node.layers, node.receiveShadow}, members.size()).first->second;
    groups.ofInstance[i] = static_cast<std::uint8_t>(group);
  }
  if (members.size() > static_cast<std::size_t>(kLimits.maxReceiverGroups)) {
    return Problem{ProblemCode::invalidValue, "/nodes",
                   "Visible nodes differ in more pairs of layers and receiveShadow than one frame can distinguish.",
                   std::to_string(kLimits.maxReceiverGroups), std::to_string(members.size())};
  }
  for (const Light& light : lights) {
    LitGroups of;
    for (const auto& [pair, group] : members) {
      const auto& [layers, receiveShadow] = pair;
      const std::uint32_t bit = 1u << group;
      const bool lit = (light.cullingMask & layers) != 0;
      if (!lit) of.lit &= ~bit;
      if (!lit || !receiveShadow) of.shadowed &= ~bit;
    }
    groups.ofLight.push_back(of);
  }
  return groups;
}

} // namespace gnomon

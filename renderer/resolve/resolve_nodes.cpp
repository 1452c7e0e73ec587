#include "renderer/resolve/resolve_nodes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "protocol/base/result.h"
#include "protocol/base/text.h"
#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

using NodesByName = std::unordered_multimap<std::string_view, std::size_t>;

NodesByName nodesByName(const Scene& scene) {
  NodesByName nodes;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) nodes.emplace(scene.nodes[i].name, i);
  return nodes;
}

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
  std::optional<NodesByName> byName;
  ProblemList problems;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string pointer = "/nodes/" + std::to_string(i) + "/node";
    if (const int* index = std::get_if<int>(&*entries[i].node)) {
      const auto node = static_cast<std::size_t>(*index);
      if (node < own.size()) {
        addSwitches(entries[i], own[node]);
      } else {
        problems.add(noNodeOfIndex(*index, scene, pointer));
      }
      continue;
    }
    if (!byName) byName = nodesByName(scene);
    const std::string& name = std::get<std::string>(*entries[i].node);
    const auto [first, last] = byName->equal_range(name);
    if (first == last) {
      problems.add({ProblemCode::invalidValue, pointer, "The file has no node of that name.", nodeNames(scene), name});
    }
    std::for_each(first, last, [&](const auto& found) { addSwitches(entries[i], own[found.second]); });
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

std::string nodeNames(const Scene& scene) {
  std::vector<std::string_view> names;
  for (const SceneNode& node : scene.nodes) {
    if (!node.name.empty()) names.push_back(node.name);
  }
  return names.empty() ? "no node has a name" : oneOf(names);
}

Problem noNodeOfIndex(int index, const Scene& scene, std::string pointer) {
  return {ProblemCode::invalidValue, std::move(pointer), "The file has no node of that index.",
          scene.nodes.empty() ? "the file has no nodes" : "0.." + std::to_string(scene.nodes.size() - 1),
          std::to_string(index)};
}

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

#include "renderer/resolve/resolve_nodes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/core/collect.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/found_nodes.h"
#include "renderer/scene/graph/node_tree.h"

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
    const auto found = collect(finder.find(*entries[i].node, "/nodes/" + std::to_string(i) + "/node"), problems);
    if (!found) continue;
    for (const std::size_t node : *found) addSwitches(entries[i], own[node]);
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

bool receivesShadows(const Scene& scene, const Instance& instance, const NodeSwitches& node) {
  return receivesShadows(node, scene.materials[static_cast<std::size_t>(materialOf(scene, instance))]);
}

/// No node of it differs from another, and no material from the usual ones.
bool isOneGroup(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes) {
  return nodes.empty() && std::all_of(view.instances.begin(), view.instances.end(), [&](const Instance& instance) {
           return receivesShadows(scene, instance, NodeSwitches{});
         });
}

bool isInView(const Scene& scene, const SceneView& view, std::size_t node) {
  while (scene.nodes[node].parent >= 0) node = static_cast<std::size_t>(scene.nodes[node].parent);
  return std::find(view.roots.begin(), view.roots.end(), static_cast<int>(node)) != view.roots.end();
}

Result<std::size_t> nodeOfIndex(int index, const Scene& scene, const SceneView& view, const std::string& pointer) {
  const auto node = static_cast<std::size_t>(index);
  if (node >= scene.nodes.size()) return noNodeOfIndex(index, scene, pointer);
  if (isInView(scene, view, node)) return node;
  return Problem{ProblemCode::invalidValue, pointer, "That node is not in the scene of this frame.", "",
                 std::to_string(index)};
}

Result<std::size_t> nodeOfName(const std::string& name, const Scene& scene, const SceneView& view,
                               const std::string& pointer) {
  std::vector<std::size_t> found;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    if (scene.nodes[node].name == name && isInView(scene, view, node)) found.push_back(node);
  }
  if (found.empty()) {
    return Problem{ProblemCode::invalidValue, pointer, "The scene of this frame has no node of that name.",
                   nodeNames(scene), name};
  }
  if (found.size() == 1) return found.front();
  return Problem{ProblemCode::invalidValue, pointer, "Several nodes have that name; give an index.",
                 std::to_string(found[0]) + " | " + std::to_string(found[1]) + (found.size() > 2 ? " | ..." : ""),
                 name};
}

VolumePlace placeAt(std::size_t node, const Scene& scene, std::span<const NodeSwitches> nodes) {
  const PlacedNode placed = scene.placedNodes.empty() ? PlacedNode{} : scene.placedNodes[node];
  const NodeSwitches switches = switchesOf(nodes, static_cast<int>(node));
  const bool there = !placed.hidden && !isFlat(placed.worldFromNode);
  return {placed.worldFromNode, there && switches.visible, there && switches.castShadow, switches.receiveShadow};
}

} // namespace

Result<std::vector<NodeSwitches>> resolveNodes(std::span<const NodeOptions> entries, const Scene& scene) {
  std::vector<NodeSwitches> nodes;
  if (entries.empty() && !scene.ground) return nodes;
  auto own = ownSwitches(entries, scene);
  if (!own) return own.problems();
  inherit(scene, *own);
  std::transform(own->begin(), own->end(), std::back_inserter(nodes), settled);
  if (scene.ground) nodes.back().castShadow = false;
  return nodes;
}

LayersInUse layersInUse(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes) {
  if (view.instances.empty()) return {};
  LayersInUse used{0, 0};
  for (const Instance& instance : view.instances) {
    const NodeSwitches node = switchesOf(nodes, instance.node);
    if (node.castShadow) used.casting |= node.layers;
    if (node.visible && receivesShadows(scene, instance, node)) used.receiving |= node.layers;
  }
  return used;
}

std::vector<std::uint8_t> receivingInstances(const Scene& scene, const SceneView& view,
                                             std::span<const NodeSwitches> nodes) {
  std::vector<std::uint8_t> receiving;
  receiving.reserve(view.instances.size());
  for (const Instance& instance : view.instances) {
    const NodeSwitches node = switchesOf(nodes, instance.node);
    receiving.push_back(node.visible && receivesShadows(scene, instance, node) ? 1 : 0);
  }
  return receiving;
}

Result<ReceiverGroups> resolveReceiverGroups(const Scene& scene, const SceneView& view,
                                             std::span<const NodeSwitches> nodes, std::span<const Light> lights) {
  ReceiverGroups groups;
  std::map<std::pair<int, bool>, std::size_t> members;
  if (isOneGroup(scene, view, nodes)) {
    members.try_emplace({NodeSwitches{}.layers, NodeSwitches{}.receiveShadow}, 0);
  } else {
    groups.ofInstance.resize(view.instances.size());
  }
  for (std::size_t i = 0; i < groups.ofInstance.size(); ++i) {
    const NodeSwitches node = switchesOf(nodes, view.instances[i].node);
    if (!node.visible) continue;
    const bool receives = receivesShadows(scene, view.instances[i], node);
    const auto group = members.try_emplace({node.layers, receives}, members.size()).first->second;
    groups.ofInstance[i] = static_cast<std::uint8_t>(group);
  }
  if (members.size() > static_cast<std::size_t>(kLimits.maxReceiverGroups)) {
    return Problem{ProblemCode::invalidValue, "/nodes",
                   "Visible surfaces differ in more pairs of layers and of whether they receive shadows than one frame "
                   "can distinguish.",
                   std::to_string(kLimits.maxReceiverGroups), std::to_string(members.size())};
  }
  for (const Light& light : lights) {
    LitGroups of;
    for (const auto& [pair, group] : members) {
      const auto& [layers, receives] = pair;
      const std::uint32_t bit = 1u << group;
      const bool lit = (light.cullingMask & layers) != 0;
      if (!lit) of.lit &= ~bit;
      if (!lit || !receives) of.shadowed &= ~bit;
    }
    groups.ofLight.push_back(of);
  }
  return groups;
}

Result<std::vector<VolumePlace>> resolveVolumes(std::span<const VolumeOptions> volumes, const Scene& scene,
                                                const SceneView& view, std::span<const NodeSwitches> nodes) {
  std::vector<VolumePlace> places;
  ProblemList problems;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    places.emplace_back();
    if (!volumes[i].node) continue;
    const std::string pointer = "/volumes/" + std::to_string(i) + "/node";
    const int* index = std::get_if<int>(&*volumes[i].node);
    const auto node =
        collect(index != nullptr ? nodeOfIndex(*index, scene, view, pointer)
                                 : nodeOfName(std::get<std::string>(*volumes[i].node), scene, view, pointer),
                problems);
    if (node) places.back() = placeAt(*node, scene, nodes);
  }
  if (!problems.empty()) return std::move(problems).take();
  return places;
}

} // namespace gnomon

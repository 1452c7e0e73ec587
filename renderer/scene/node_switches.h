#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A node's switches (NodeOptions, protocol/spec/scene_options.h), nothing left open.
struct NodeSwitches {
  bool visible = true;
  bool castShadow = true;
  bool receiveShadow = true;
  int layers = 1; ///< one bit a layer

  bool operator==(const NodeSwitches&) const = default;
};

/// Of a node of the file. `nodes`: one a node of the file; empty = every node has the defaults.
inline NodeSwitches switchesOf(std::span<const NodeSwitches> nodes, int node) {
  return nodes.empty() ? NodeSwitches{} : nodes[static_cast<std::size_t>(node)];
}

/// A light lights the nodes that share a layer with it, and only they cast from it.
inline bool isLitBy(const Light& light, const NodeSwitches& node) {
  return (light.cullingMask & node.layers) != 0;
}
inline bool castsFrom(const Light& light, const NodeSwitches& node) {
  return node.castShadow && isLitBy(light, node);
}

/// Whether a surface shows shadows at all: one that is unlit shows its base color, whatever the light.
inline bool receivesShadows(const NodeSwitches& node, const Material& material) {
  return node.receiveShadow && !material.unlit;
}
/// Whether it shows those of a light. What does not decides nothing about the light's shadow, and is not measured.
inline bool receivesFrom(const Light& light, const NodeSwitches& node, const Material& material) {
  return receivesShadows(node, material) && isLitBy(light, node);
}

/// The layers of what casts, and of what is seen and receives.
struct LayersInUse {
  int casting = 1;
  int receiving = 1;
};

/// What one light does to the receiver groups, a bit a group; bits of no group are set.
struct LitGroups {
  std::uint32_t lit = ~0u;
  std::uint32_t shadowed = ~0u; ///< of those that it lights: where it throws shadows

  bool operator==(const LitGroups&) const = default;
};

/// Groups of visible surfaces that agree in layers and in whether they receive shadows.
struct ReceiverGroups {
  std::vector<std::uint8_t> ofInstance; ///< index of the group, one an instance of the view; empty = one group for all
  std::vector<LitGroups> ofLight;       ///< one a light; empty = every light lights and shadows all

  /// Some light makes a difference between them.
  bool matter() const {
    return std::any_of(ofLight.begin(), ofLight.end(), [](const LitGroups& groups) { return groups != LitGroups{}; });
  }
};

} // namespace gnomon

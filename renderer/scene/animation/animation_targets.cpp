#include "renderer/scene/animation/animation_targets.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace gnomon {

namespace {

std::optional<ChannelPath> pathOf(std::string_view name) {
  for (const auto& [path, spelling] :
       {std::pair(ChannelPath::translation, "translation"), std::pair(ChannelPath::rotation, "rotation"),
        std::pair(ChannelPath::scale, "scale"), std::pair(ChannelPath::weights, "weights")}) {
    if (name == spelling) return path;
  }
  return std::nullopt;
}

/// "/nodes/3/scale".
std::optional<NodeTarget> nodeAt(std::string_view pointer, std::size_t nodes) {
  constexpr std::string_view kNodes = "/nodes/";
  if (!pointer.starts_with(kNodes)) return std::nullopt;
  pointer.remove_prefix(kNodes.size());
  const std::size_t slash = std::min(pointer.find('/'), pointer.size());
  const auto node = indexIn(pointer.substr(0, slash), nodes);
  if (!node || slash == pointer.size()) return std::nullopt;
  pointer.remove_prefix(slash + 1);
  if (pointer == "extensions/KHR_node_visibility/visible") return NodeTarget{*node, ChannelPath::visibility};
  const auto path = pathOf(pointer);
  return path ? std::optional(NodeTarget{*node, *path}) : std::nullopt;
}

} // namespace

std::optional<AnimationTarget> targetOf(const gltf::Model& model, const gltf::AnimationChannel& channel) {
  if (channel.path == "pointer") {
    if (!channel.pointer) return std::nullopt;
    if (const auto node = nodeAt(*channel.pointer, model.nodes.size())) return node;
    return propertyAt(model, *channel.pointer);
  }
  const auto path = pathOf(channel.path);
  if (!path || channel.node < 0) return std::nullopt;
  return NodeTarget{static_cast<std::size_t>(channel.node), *path};
}

const std::string& targetName(const gltf::AnimationChannel& channel) {
  return channel.pointer ? *channel.pointer : channel.path;
}

std::set<std::size_t> nodesWithMovingWeights(const gltf::Model& model) {
  std::set<std::size_t> nodes;
  for (const gltf::Animation& animation : model.animations) {
    for (const gltf::AnimationChannel& channel : animation.channels) {
      const auto target = targetOf(model, channel);
      const auto* node = target ? std::get_if<NodeTarget>(&*target) : nullptr;
      if (node && node->path == ChannelPath::weights) nodes.insert(node->node);
    }
  }
  return nodes;
}

} // namespace gnomon

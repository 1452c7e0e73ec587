#include "renderer/scene/animation/animation_targets.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

using nlohmann::json;

std::optional<ChannelPath> pathOf(std::string_view name) {
  for (const auto& [path, spelling] :
       {std::pair(ChannelPath::translation, "translation"), std::pair(ChannelPath::rotation, "rotation"),
        std::pair(ChannelPath::scale, "scale"), std::pair(ChannelPath::weights, "weights")}) {
    if (name == spelling) return path;
  }
  return std::nullopt;
}

const std::string* pointerOf(const json& target) {
  const json* extension = extensionOf(target, "KHR_animation_pointer");
  return extension == nullptr ? nullptr : (*extension)["pointer"].get_ptr<const std::string*>();
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

std::optional<AnimationTarget> targetOf(const json& document, const json& channel) {
  const json& target = channel["target"];
  const auto nodes = document.find("nodes");
  if (target["path"] == "pointer") {
    const std::string* pointer = pointerOf(target);
    if (!pointer) return std::nullopt;
    if (const auto node = nodeAt(*pointer, nodes == document.end() ? 0 : nodes->size())) return node;
    return propertyAt(document, *pointer);
  }
  const auto path = pathOf(target["path"].get_ref<const std::string&>());
  if (!path || !target.contains("node")) return std::nullopt;
  return NodeTarget{target["node"].get<std::size_t>(), *path};
}

std::string targetName(const json& channel) {
  const json& target = channel["target"];
  const std::string* pointer = pointerOf(target);
  return pointer ? *pointer : target["path"].get<std::string>();
}

std::set<std::size_t> nodesWithMovingWeights(const json& document) {
  std::set<std::size_t> nodes;
  const auto animations = document.find("animations");
  if (animations == document.end()) return nodes;
  for (const json& animation : *animations) {
    for (const json& channel : animation["channels"]) {
      const auto target = targetOf(document, channel);
      const auto* node = target ? std::get_if<NodeTarget>(&*target) : nullptr;
      if (node && node->path == ChannelPath::weights) nodes.insert(node->node);
    }
  }
  return nodes;
}

} // namespace gnomon

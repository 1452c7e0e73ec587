#include "renderer/scene/animation/animation_targets.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

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
  const auto extensions = target.find("extensions");
  if (extensions == target.end()) return nullptr;
  const auto extension = extensions->find("KHR_animation_pointer");
  return extension == extensions->end() ? nullptr : (*extension)["pointer"].get_ptr<const std::string*>();
}

/// "/nodes/3/scale"; the index has no sign and no leading zero (RFC 6901).
std::optional<AnimationTarget> targetAt(std::string_view pointer, std::size_t nodes) {
  constexpr std::string_view kNodes = "/nodes/";
  if (!pointer.starts_with(kNodes)) return std::nullopt;
  pointer.remove_prefix(kNodes.size());
  const std::size_t slash = std::min(pointer.find('/'), pointer.size());
  std::size_t node = 0;
  const auto [end, error] = std::from_chars(pointer.data(), pointer.data() + slash, node);
  const bool isIndex = error == std::errc() && end == pointer.data() + slash && (pointer[0] != '0' || slash == 1);
  if (!isIndex || node >= nodes || slash == pointer.size()) return std::nullopt;
  const auto path = pathOf(pointer.substr(slash + 1));
  if (!path) return std::nullopt;
  return AnimationTarget{node, *path};
}

} // namespace

std::optional<AnimationTarget> targetOf(const json& document, const json& channel) {
  const json& target = channel["target"];
  const auto nodes = document.find("nodes");
  if (target["path"] == "pointer") {
    const std::string* pointer = pointerOf(target);
    if (!pointer) return std::nullopt;
    return targetAt(*pointer, nodes == document.end() ? 0 : nodes->size());
  }
  const auto path = pathOf(target["path"].get_ref<const std::string&>());
  if (!path || !target.contains("node")) return std::nullopt;
  return AnimationTarget{target["node"].get<std::size_t>(), *path};
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
      if (target && target->path == ChannelPath::weights) nodes.insert(target->node);
    }
  }
  return nodes;
}

} // namespace gnomon

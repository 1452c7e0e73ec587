#include "renderer/scene/animation/animations.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "renderer/scene/animation/samplers.h"

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

/// Morph targets of a node's mesh; 0 where it has no mesh.
std::size_t morphTargetsOf(const gltf::Model& model, const gltf::Node& node) {
  if (node.mesh < 0) return 0;
  const auto& primitives = model.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return primitives.empty() ? 0 : primitives[0].targets.size();
}

class Reading {
 public:
  explicit Reading(const LoadContext& load)
      : model_(load.document.model), accessors_(load.accessors), limits_(load.limits), findings_(load.findings) {}

  Animation read(const gltf::Animation& source, const std::string& pointer) {
    Animation animation;
    animation.name = keptName(source.name, findings_);
    std::set<std::string> moved;
    std::map<std::pair<std::size_t, SamplerUse>, std::size_t> built;
    const std::vector<gltf::AnimationChannel>& channels = source.channels;
    for (std::size_t i = 0; i < channels.size() && !findings_.refused(); ++i) {
      const std::string at = pointerTo(pointer + "/channels", i);
      const auto target = targetOf(model_, channels[i]);
      if (!target) {
        findings_.warn("The animation channel that targets " + inQuotes(targetName(channels[i])) + " is ignored.");
        continue;
      }
      if (!moved.insert(keyOf(*target)).second) {
        findings_.invalid(at + "/target", "Another channel of the animation has the same target.");
        return animation;
      }
      const auto use = useOf(*target, at + "/target");
      if (!use) return animation;
      const std::size_t index = channels[i].sampler;
      const auto [place, isNew] = built.try_emplace({index, *use}, animation.samplers.size());
      const std::string samplerAt = pointerTo(pointer + "/samplers", index);
      if (isNew) {
        animation.samplers.push_back(buildSampler(source.samplers[index], samplerAt, accessors_, *use,
                                                  limits_.maxKeyframes - keyframes_, findings_));
        const Sampler& sampler = animation.samplers.back();
        keyframes_ += sampler.times.size() + sampler.values.size();
        if (sampler.times.empty()) return animation;
        animation.durationSeconds = std::max(animation.durationSeconds, double{sampler.times.back()});
      }
      if (const auto* node = std::get_if<NodeTarget>(&*target)) {
        animation.channels.push_back({node->path, static_cast<int>(node->node), place->second});
      } else {
        const auto& property = std::get<PropertyTarget>(*target);
        checkRange(property, animation.samplers[place->second], samplerAt + "/output");
        animation.properties.push_back({property, place->second});
      }
    }
    return animation;
  }

 private:
  static std::string keyOf(const AnimationTarget& target) {
    if (const auto* property = std::get_if<PropertyTarget>(&target)) return property->pointer;
    const auto& node = std::get<NodeTarget>(target);
    return std::to_string(node.node) + ' ' + std::to_string(static_cast<int>(node.path));
  }

  void checkRange(const PropertyTarget& property, const Sampler& sampler, const std::string& pointer) {
    for (std::size_t keyframe = 0; keyframe < sampler.times.size(); ++keyframe) {
      for (const float value : std::span(valueOf(sampler, keyframe), sampler.components)) {
        if (!(double{value} < property.min) && !(double{value} > property.max) &&
            !(property.minExcluded && double{value} == property.min)) {
          continue;
        }
        return findings_.invalid(pointer, "A keyframe's value is out of range for " + inQuotes(property.pointer) + ".",
                                 {}, std::to_string(value) + " at keyframe " + std::to_string(keyframe));
      }
    }
  }

  /// Nothing, and a problem, where the node does not have what the channel moves.
  std::optional<SamplerUse> useOf(const AnimationTarget& target, const std::string& pointer) {
    if (const auto* property = std::get_if<PropertyTarget>(&target)) {
      return SamplerUse{ValueKind::numbers, property->components, 1};
    }
    const auto [index, path] = std::get<NodeTarget>(target);
    const gltf::Node& node = model_.nodes[index];
    if (path == ChannelPath::visibility) return SamplerUse{ValueKind::boolean, 1, 1};
    if (path != ChannelPath::weights) {
      const bool rotates = path == ChannelPath::rotation;
      const SamplerUse use{rotates ? ValueKind::rotation : ValueKind::vector, rotates ? 4u : 3u, 1};
      if (!node.matrix) return use;
      findings_.invalid(pointer, "A node with a matrix can't be animated.");
      return std::nullopt;
    }
    const std::size_t targets = morphTargetsOf(model_, node);
    if (targets > 0) return SamplerUse{ValueKind::numbers, 1, targets};
    findings_.invalid(pointer, "The node has no morph targets whose weights could be animated.");
    return std::nullopt;
  }

  const gltf::Model& model_;
  const std::vector<AccessorView>& accessors_;
  const Limits& limits_;
  Findings& findings_;
  std::size_t keyframes_ = 0; ///< numbers read so far; <= maxKeyframes
};

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

std::vector<Animation> readAnimations(const LoadContext& load) {
  std::vector<Animation> animations;
  const std::vector<gltf::Animation>& sources = load.document.model.animations;
  Reading reading(load);
  for (std::size_t i = 0; i < sources.size() && !load.findings.refused(); ++i) {
    animations.push_back(reading.read(sources[i], pointerTo("/animations", i)));
  }
  return animations;
}

} // namespace gnomon

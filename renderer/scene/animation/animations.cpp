#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

namespace {

struct NodeTarget {
  std::size_t node = 0;
  ChannelPath path = ChannelPath::translation;
};

/// What a channel moves.
using AnimationTarget = std::variant<NodeTarget, PropertyTarget>;

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

/// By node and path, or by the pointer of KHR_animation_pointer; nothing for what is not animated here.
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

/// Morph targets of a node's mesh; 0 where it has no mesh.
std::size_t morphTargetsOf(const gltf::Model& model, const gltf::Node& node) {
  if (node.mesh < 0) return 0;
  const auto& primitives = model.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return primitives.empty() ? 0 : primitives[0].targets.size();
}

class Reading {
 public:
  explicit Reading(const LoadContext& load) : load_(load), findings_(&load.findings) {}

  Animation read(const gltf::Animation& source, const std::string& pointer) {
    Animation animation;
    animation.name = keptName(source.name, *findings_);
    moved_.clear();
    built_.clear();
    for (std::size_t i = 0; i < source.channels.size() && !findings_->refused(); ++i) {
      Findings ofChannel;
      Findings* const whole = std::exchange(findings_, &ofChannel);
      readChannel(source, pointer, i, animation);
      findings_ = whole;
      findings_->leaveOut(std::move(ofChannel), "the animation's channel is left out");
    }
    return animation;
  }

 private:
  /// Adds the channel, unless there is a problem with it.
  void readChannel(const gltf::Animation& source, const std::string& pointer, std::size_t index, Animation& animation) {
    const gltf::AnimationChannel& channel = source.channels[index];
    const std::string at = pointerTo(pointer + "/channels", index) + "/target";
    if (source.samplers[channel.sampler].faulty) return; // the schema check reports it
    const auto target = targetOf(load_.document.model, channel);
    if (!target) {
      findings_->warn("The animation channel that targets " +
                      inQuotes(channel.pointer ? *channel.pointer : channel.path) + " is ignored.");
      return;
    }
    if (moved_.contains(keyOf(*target))) {
      return findings_->invalid(at, "Another channel of the animation has the same target.");
    }
    const auto use = useOf(*target, at);
    if (!use) return;
    const std::string samplerAt = pointerTo(pointer + "/samplers", channel.sampler);
    const auto place = samplerOf(source.samplers[channel.sampler], {channel.sampler, *use}, samplerAt, animation);
    if (!place) return;
    const Sampler& sampler = animation.samplers[*place];
    if (const auto* node = std::get_if<NodeTarget>(&*target)) {
      animation.channels.push_back({node->path, static_cast<int>(node->node), *place});
    } else {
      const auto& property = std::get<PropertyTarget>(*target);
      if (!isInRange(property, sampler, samplerAt + "/output")) return;
      animation.properties.push_back({property, *place});
    }
    moved_.insert(keyOf(*target));
    animation.durationSeconds = std::max(animation.durationSeconds, double{sampler.times.back()});
  }

  /// Index into Animation::samplers; nothing where it is faulty, with a problem the first time.
  std::optional<std::size_t> samplerOf(const gltf::AnimationSampler& source,
                                       const std::pair<std::size_t, SamplerUse>& key, const std::string& pointer,
                                       Animation& animation) {
    const auto [place, isNew] = built_.try_emplace(key);
    if (!isNew) return place->second;
    Sampler sampler =
        buildSampler(source, pointer, load_.accessors, key.second, load_.limits.maxKeyframes - keyframes_, *findings_);
    keyframes_ += sampler.times.size() + sampler.values.size();
    if (findings_->refused() || sampler.times.empty()) return std::nullopt;
    place->second = animation.samplers.size();
    animation.samplers.push_back(std::move(sampler));
    return place->second;
  }

  static std::string keyOf(const AnimationTarget& target) {
    if (const auto* property = std::get_if<PropertyTarget>(&target)) return property->pointer;
    const auto& node = std::get<NodeTarget>(target);
    return std::to_string(node.node) + ' ' + std::to_string(static_cast<int>(node.path));
  }

  /// False, and a problem, where a keyframe is not.
  bool isInRange(const PropertyTarget& property, const Sampler& sampler, const std::string& pointer) {
    for (std::size_t keyframe = 0; keyframe < sampler.times.size(); ++keyframe) {
      for (const float value : std::span(valueOf(sampler, keyframe), sampler.components)) {
        if (!(double{value} < property.min) && !(double{value} > property.max) &&
            !(property.minExcluded && double{value} == property.min)) {
          continue;
        }
        findings_->invalid(pointer, "A keyframe's value is out of range for " + inQuotes(property.pointer) + ".", {},
                           std::to_string(value) + " at keyframe " + std::to_string(keyframe));
        return false;
      }
    }
    return true;
  }

  /// Nothing, and a problem, where the node does not have what the channel moves.
  std::optional<SamplerUse> useOf(const AnimationTarget& target, const std::string& pointer) {
    if (const auto* property = std::get_if<PropertyTarget>(&target)) {
      return SamplerUse{ValueKind::numbers, property->components, 1};
    }
    const auto [index, path] = std::get<NodeTarget>(target);
    const gltf::Node& node = load_.document.model.nodes[index];
    if (path == ChannelPath::visibility) return SamplerUse{ValueKind::boolean, 1, 1};
    if (path != ChannelPath::weights) {
      const bool rotates = path == ChannelPath::rotation;
      const SamplerUse use{rotates ? ValueKind::rotation : ValueKind::vector, rotates ? 4u : 3u, 1};
      if (!node.matrix) return use;
      findings_->invalid(pointer, "A node with a matrix can't be animated.");
      return std::nullopt;
    }
    const std::size_t targets = morphTargetsOf(load_.document.model, node);
    if (targets > 0) return SamplerUse{ValueKind::numbers, 1, targets};
    findings_->invalid(pointer, "The node has no morph targets whose weights could be animated.");
    return std::nullopt;
  }

  const LoadContext& load_;
  Findings* findings_;        ///< of the channel that is read
  std::size_t keyframes_ = 0; ///< numbers read so far; <= maxKeyframes
  // Of the animation that is read:
  std::set<std::string> moved_;                                                    ///< targets
  std::map<std::pair<std::size_t, SamplerUse>, std::optional<std::size_t>> built_; ///< nothing = it is faulty
};

} // namespace

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

#include "renderer/scene/animation/animations.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/scene/animation/animation_targets.h"
#include "renderer/scene/animation/sampler_build.h"

namespace gnomon {

namespace {

using nlohmann::json;

/// Morph targets of a node's mesh; 0 where it has no mesh.
std::size_t morphTargetsOf(const json& document, const json& node) {
  const auto mesh = node.find("mesh");
  if (mesh == node.end()) return 0;
  const json& primitives = document["meshes"][mesh->get<std::size_t>()]["primitives"];
  if (primitives.empty() || !primitives[0].contains("targets")) return 0;
  return primitives[0]["targets"].size();
}

class Reading {
 public:
  Reading(const GltfDocument& document, const std::vector<AccessorView>& accessors, const Limits& limits,
          Findings& findings)
      : document_(document.json), accessors_(accessors), limits_(limits), findings_(findings) {}

  Animation read(const json& source, const std::string& pointer) {
    Animation animation;
    const auto name = source.find("name");
    if (name != source.end()) animation.name = keptName(name->get_ref<const std::string&>(), findings_);
    std::set<std::pair<std::size_t, ChannelPath>> moved;
    std::map<std::pair<std::size_t, SamplerUse>, std::size_t> built;
    const json& channels = source["channels"];
    for (std::size_t i = 0; i < channels.size() && !findings_.refused(); ++i) {
      const std::string at = pointerTo(pointer + "/channels", i);
      const auto target = targetOf(document_, channels[i]);
      if (!target) {
        findings_.warn("What moves " + inQuotes(targetName(channels[i])) + " is not animated.");
        continue;
      }
      if (!moved.insert({target->node, target->path}).second) {
        findings_.invalid(at + "/target", "Another channel of the animation moves the same.");
        return animation;
      }
      const auto use = useOf(*target, at + "/target");
      if (!use) return animation;
      const auto index = channels[i]["sampler"].get<std::size_t>();
      const auto [place, isNew] = built.try_emplace({index, *use}, animation.samplers.size());
      if (isNew) {
        animation.samplers.push_back(buildSampler(source["samplers"][index], pointerTo(pointer + "/samplers", index),
                                                  accessors_, *use, limits_.maxKeyframes - keyframes_, findings_));
        const Sampler& sampler = animation.samplers.back();
        keyframes_ += sampler.times.size() + sampler.values.size();
        if (sampler.times.empty()) return animation;
        animation.durationSeconds = std::max(animation.durationSeconds, double{sampler.times.back()});
      }
      animation.channels.push_back({target->path, static_cast<int>(target->node), place->second});
    }
    return animation;
  }

 private:
  /// Nothing, and a problem, where the node does not have what the channel moves.
  std::optional<SamplerUse> useOf(const AnimationTarget& target, const std::string& pointer) {
    const json& node = document_["nodes"][target.node];
    if (target.path != ChannelPath::weights) {
      if (!node.contains("matrix")) return SamplerUse{target.path, 1};
      findings_.invalid(pointer, "A node with a matrix can't be animated.");
      return std::nullopt;
    }
    const std::size_t targets = morphTargetsOf(document_, node);
    if (targets > 0) return SamplerUse{target.path, targets};
    findings_.invalid(pointer, "The node has no morph targets whose weights could be animated.");
    return std::nullopt;
  }

  const json& document_;
  const std::vector<AccessorView>& accessors_;
  const Limits& limits_;
  Findings& findings_;
  std::size_t keyframes_ = 0; ///< numbers read so far; <= maxKeyframes
};

} // namespace

std::vector<Animation> readAnimations(const GltfDocument& document, const std::vector<AccessorView>& accessors,
                                      const Limits& limits, Findings& findings) {
  std::vector<Animation> animations;
  const auto sources = document.json.find("animations");
  if (sources == document.json.end()) return animations;
  Reading reading(document, accessors, limits, findings);
  for (std::size_t i = 0; i < sources->size() && !findings.refused(); ++i) {
    animations.push_back(reading.read((*sources)[i], pointerTo("/animations", i)));
  }
  return animations;
}

} // namespace gnomon

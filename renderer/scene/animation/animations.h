#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/document/gltf_document.h"

namespace gnomon {

struct NodeTarget {
  std::size_t node = 0;
  ChannelPath path = ChannelPath::translation;
};

/// What a channel moves.
using AnimationTarget = std::variant<NodeTarget, PropertyTarget>;

/// By node and path, or by the pointer of KHR_animation_pointer. Nothing for what is not animated here.
std::optional<AnimationTarget> targetOf(const gltf::Model& model, const gltf::AnimationChannel& channel);

/// What a channel without a target here would move, for a sentence; empty where it says nothing.
const std::string& targetName(const gltf::AnimationChannel& channel);

/// Nodes whose weights an animation changes.
std::set<std::size_t> nodesWithMovingWeights(const gltf::Model& model);

/// The animations of the file, in its order. Channels that move what is not animated here are left out with a warning.
std::vector<Animation> readAnimations(const LoadContext& load);

} // namespace gnomon

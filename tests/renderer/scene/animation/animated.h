#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/glb_builder.h"

namespace gnomon {

/// Adds a sampler and a channel to the last animation, which is made if need be. `output`: the accessor of the values.
inline void addChannel(testing::GlbBuilder& builder, nlohmann::json target, const std::vector<float>& times, int output,
                       const char* interpolation = "LINEAR") {
  const int input = builder.addAccessor(times, "SCALAR", 5126, times.size());
  if (!builder.json.contains("animations")) {
    builder.add("animations",
                {{"name", "Move"}, {"channels", nlohmann::json::array()}, {"samplers", nlohmann::json::array()}});
  }
  nlohmann::json& animation = builder.json["animations"].back();
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1}, {"target", std::move(target)}});
}

/// An accessor of floats, for the values of `type`.
inline int addValues(testing::GlbBuilder& builder, const std::vector<float>& values, const std::string& type) {
  const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
  return builder.addAccessor(values, type.c_str(), 5126, values.size() / components);
}

/// A channel that moves a node. `values`: of the accessor `type`.
inline void animate(testing::GlbBuilder& builder, int node, const char* path, const std::vector<float>& times,
                    const std::vector<float>& values, const char* type, const char* interpolation = "LINEAR") {
  addChannel(builder, {{"node", node}, {"path", path}}, times, addValues(builder, values, type), interpolation);
}

/// The target of a channel with KHR_animation_pointer.
inline nlohmann::json pointerTarget(const std::string& pointer) {
  return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
}

/// A channel that moves what a pointer names.
inline void animatePointer(testing::GlbBuilder& builder, const std::string& pointer, const std::vector<float>& times,
                           const std::vector<float>& values, const char* type, const char* interpolation = "LINEAR") {
  addChannel(builder, pointerTarget(pointer), times, addValues(builder, values, type), interpolation);
}

} // namespace gnomon

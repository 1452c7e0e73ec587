#pragma once

#include <vector>

#include "tests/support/glb_builder.h"

namespace gnomon {

/// Adds a sampler and a channel to the last animation, which is made if need be. `values`: of the accessor `type`.
inline void animate(testing::GlbBuilder& builder, int node, const char* path, const std::vector<float>& times,
                    const std::vector<float>& values, const char* type, const char* interpolation = "LINEAR") {
  const std::size_t components = std::string(type) == "SCALAR" ? 1 : std::string(type) == "VEC3" ? 3 : 4;
  const int input = builder.addAccessor(times, "SCALAR", 5126, times.size());
  const int output = builder.addAccessor(values, type, 5126, values.size() / components);
  if (!builder.json.contains("animations")) {
    builder.add("animations",
                {{"name", "Move"}, {"channels", nlohmann::json::array()}, {"samplers", nlohmann::json::array()}});
  }
  nlohmann::json& animation = builder.json["animations"].back();
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

} // namespace gnomon

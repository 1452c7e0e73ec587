#include "renderer/environment/make_environment.h"

#include <utility>

namespace gnomon {

Environment makeEnvironment(EnvironmentMap map, const std::optional<FoundSun>& sun) {
  PrefilteredEnvironment made = prefiltered(map);
  return {std::move(map), sun, std::move(made)};
}

std::size_t bytesIn(const Environment& environment) {
  return environment.map.texels.size() * sizeof(glm::vec3) + environment.prefiltered.texels.size() * sizeof(glm::vec4);
}

} // namespace gnomon

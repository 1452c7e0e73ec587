#include "renderer/environment/make_environment.h"

#include <utility>

namespace gnomon {

Environment makeEnvironment(EnvironmentMap map, SunExtraction) {
  return {std::move(map), {}};
}

std::size_t bytesIn(const Environment& environment) {
  return environment.map.texels.size() * sizeof(glm::vec3);
}

} // namespace gnomon

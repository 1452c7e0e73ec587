#include "renderer/frame/environment_of_frame.h"

#include <cmath>

#include "renderer/core/collect.h"
#include "renderer/environment/sky_model.h"

namespace gnomon {

glm::dmat3 mapFromWorld(double rotationDegrees) {
  const double angle = glm::radians(rotationDegrees), along = std::cos(angle), across = std::sin(angle);
  return {glm::dvec3(along, 0, -across), glm::dvec3(0, 1, 0), glm::dvec3(across, 0, along)};
}

Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, const SettledFrame& settled) {
  const EnvironmentOptions& options = settled.frame.spec.environment;
  FrameEnvironment environment;
  if (options.sky) {
    environment.environment = cache.get(*options.sky);
  } else if (options.file) {
    auto made = cache.get(settled.loaded->environmentFiles.at(*options.file), options.extractSun);
    if (!made) return placedAt("/environment/file", made.problems());
    environment.environment = *std::move(made);
  } else {
    return environment;
  }
  environment.mapFromWorld = mapFromWorld(options.rotationDegrees);
  environment.intensity = options.intensity.value_or(options.sky ? kUsualSkyIntensity : 1);
  return environment;
}

} // namespace gnomon

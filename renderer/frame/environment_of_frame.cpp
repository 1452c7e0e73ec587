#include "renderer/frame/environment_of_frame.h"

#include <cmath>

#include "renderer/core/collect.h"

namespace gnomon {

glm::dmat3 mapFromWorld(double rotationDegrees) {
  const double angle = glm::radians(rotationDegrees), along = std::cos(angle), across = std::sin(angle);
  return {glm::dvec3(along, 0, -across), glm::dvec3(0, 1, 0), glm::dvec3(across, 0, along)};
}

Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, const SettledFrame& settled) {
  const EnvironmentOptions& options = settled.frame.spec.environment;
  FrameEnvironment environment;
  if (!options.file) return environment;
  auto made = cache.get(settled.loaded->environmentFiles.at(*options.file), options.extractSun);
  if (!made) return placedAt("/environment/file", made.problems());
  environment.environment = *std::move(made);
  environment.mapFromWorld = mapFromWorld(options.rotationDegrees);
  environment.intensity = options.intensity.value_or(1);
  return environment;
}

} // namespace gnomon

#include "renderer/frame/environment_of_frame.h"

#include <utility>

#include "renderer/core/collect.h"

namespace gnomon {

Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, SettledFrame& settled) {
  return environmentOf(cache, *settled.loaded, settled.frame.spec.environment,
                       std::exchange(settled.environment.split, std::nullopt));
}

Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, const Scene& loaded, const EnvironmentOptions& options,
                                       std::optional<SplitEnvironment> split) {
  FrameEnvironment environment;
  environment.studioLamps = options.studio == Studio::lamps;
  environment.mapFromWorld = mapFromWorld(options.rotationDegrees);
  if (options.sky) {
    environment.environment = cache.get(*options.sky);
  } else if (options.file) {
    auto made = cache.get(loaded.environmentFiles.at(*options.file), options.extractSun, std::move(split));
    if (!made) return placedAt("/environment/file", made.problems());
    environment.environment = *std::move(made);
  } else {
    return environment;
  }
  environment.intensity = intensityOf(options);
  return environment;
}

} // namespace gnomon

#include "renderer/frame/environment_of_frame.h"

#include <utility>

#include "renderer/core/collect.h"
#include "renderer/frame/environment_lights.h"

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
  } else {
    const auto file = environmentFileOf(loaded, options);
    if (!file) return file.problems();
    if (!*file) return environment;
    auto made = cache.get(*file, options.extractSun, std::move(split));
    if (!made) return placedAt(placeOfSource(options), made.problems());
    environment.environment = *std::move(made);
  }
  environment.intensity = intensityOf(options);
  return environment;
}

} // namespace gnomon

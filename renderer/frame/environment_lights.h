#pragma once

#include <optional>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/environment/environment_file.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// What a frame's environment is found to be before it is drawn.
struct SettledEnvironment {
  std::vector<Light> lights;                 ///< its sun, if it has one: in the world, by the frame's settings
  std::optional<EnvironmentReport> report{}; ///< nothing = the studio
  std::optional<SplitEnvironment> split{};   ///< of a file that was read just now
};

/// Reads a file that no earlier frame named. Problems: at /environment/file where the upload does not have it or it is
/// broken, at /environment/intensity where its sun is brighter than a light may be.
Result<SettledEnvironment> settleEnvironment(const Scene& loaded, const EnvironmentOptions& options);

/// A turn about +Y: directions of the map from directions of the world, which see it turned clockwise from above.
glm::dmat3 mapFromWorld(double rotationDegrees);

/// What radiance of the environment is multiplied by.
double intensityOf(const EnvironmentOptions& options);

} // namespace gnomon

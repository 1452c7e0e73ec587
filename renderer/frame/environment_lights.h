#pragma once

#include <memory>
#include <optional>
#include <string>
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
  std::optional<SplitEnvironment> split{};   ///< of a file or light that was read just now
  std::vector<std::string> warnings{};
};

/// A frame's environment with its source named: where the request names none, the image-based light of its scene if it
/// has one.
EnvironmentOptions sourcedEnvironment(const Scene& loaded, const FrameSpec& spec);

/// The file or image-based light that these options name; null = they name none. Problems: at /environment/file or
/// /environment/light, the scene does not have it.
Result<std::shared_ptr<const EnvironmentFile>> environmentFileOf(const Scene& loaded,
                                                                 const EnvironmentOptions& options);

/// Where problems with what environmentFileOf gives belong.
std::string placeOfSource(const EnvironmentOptions& options);

/// Reads a file or light that no earlier frame named. Problems: those of environmentFileOf, at the same place where it
/// is broken, and at /environment/intensity where its sun is brighter than a light may be.
Result<SettledEnvironment> settleEnvironment(const Scene& loaded, const EnvironmentOptions& options);

/// A turn about +Y: directions of the map from directions of the world, which see it turned clockwise from above.
glm::dmat3 mapFromWorld(double rotationDegrees);

/// What radiance of the environment is multiplied by.
double intensityOf(const EnvironmentOptions& options);

} // namespace gnomon

#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "renderer/environment/environment_map.h"
#include "renderer/environment/prefilter.h"

/// An environment as frames are lit by it.
namespace gnomon {

/// Made once from a file or a sky, shared by frames. Immutable.
struct Environment {
  EnvironmentMap map;                 ///< without its sun
  std::optional<FoundSun> sun{};      ///< a light of the frame, which settling adds
  PrefilteredEnvironment prefiltered; ///< of the map
};

/// The environment of one frame.
struct FrameEnvironment {
  std::shared_ptr<const Environment> environment{}; ///< null = the studio of `ambient`
  bool studioLamps = true;                          ///< the studio has lamps; else it is even all around
  glm::dmat3 mapFromWorld{1};                       ///< a turn about the vertical axis
  double intensity = 1;                             ///< radiance is multiplied by it
};

} // namespace gnomon

#pragma once

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"

namespace gnomon {

/// The line through a place of the picture; metres, relative to the scene's anchor.
struct SightLine {
  glm::dvec3 origin{0};    ///< at the eye; orthographic: beside it
  glm::dvec3 direction{0}; ///< a step of one metre of view depth
};

/// `place`: pixels from the upper left corner.
SightLine sightLine(const CameraView& view, const glm::dvec3& anchor, glm::dvec2 size, glm::dvec2 place);

/// A stretch of the line through a place of the picture; metres, relative to the scene's anchor.
struct CameraRay {
  glm::dvec3 origin{0};    ///< where it begins
  glm::dvec3 direction{0}; ///< a step of one metre of view depth
  double length = 0;       ///< view depth from there to the far end; infinite where nothing ends it
  bool meets = false;      ///< false: it passes the scene by
};

/// The ray through `place` (pixels from the upper left corner) between the near and the far plane, as pointAt places
/// it. Where it starts far from `bounds`, around which it looks for something, it begins close to them instead: so the
/// distance of the eye takes nothing from its precision.
CameraRay cameraRay(const CameraView& view, const glm::dvec3& anchor, const Aabb& bounds, glm::dvec2 size,
                    glm::dvec2 place);

} // namespace gnomon

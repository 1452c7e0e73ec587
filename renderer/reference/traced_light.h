#pragma once

#include <optional>
#include <vector>

#include "renderer/reference/drawn_points.h"
#include "renderer/reference/light_source.h"
#include "renderer/reference/shadow_rays.h"
#include "renderer/reference/trace.h"

namespace gnomon {

struct TracedLight::State {
  LightSource source;
  std::vector<std::uint8_t> shadowed; ///< one an instance: the light throws shadows on it
  Casters casters;
  TraceInput input;
  Interleaved places;
  Sight sight = sightOf(input);
  DrawnView view = drawnView(sight, casters.tree.scale);
  DrawnLight light = drawnLight(source, casters.eye, casters.tree.scale);

  /// What a point sees of the light where that takes no rays.
  std::optional<float> withoutRays(const SurfacePoint& point, const WayToLight& way) const {
    if (point.instance == kNoSurface || shadowed[point.instance] == 0) return 1.0f;
    if (!faces(point.normal, way)) return 0.0f;
    if (!reaches(source, way)) return 1.0f;
    return std::nullopt;
  }
};

} // namespace gnomon

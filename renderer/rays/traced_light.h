#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "renderer/rays/drawn_points.h"
#include "renderer/rays/light_source.h"
#include "renderer/rays/lit_fronts.h"
#include "renderer/rays/shadow_rays.h"
#include "renderer/rays/smooth_surface.h"
#include "renderer/rays/trace.h"

namespace gnomon {

struct TracedLight::State {
  LightAndCasters from;
  std::vector<std::uint8_t> shadowed; ///< one an instance: the light throws shadows on it
  Casters casters;
  TraceInput input;
  Interleaved places;
  std::shared_ptr<LitFronts> fronts;                 ///< null: rays decide all
  mutable std::atomic<std::int64_t> nanoseconds = 0; ///< that were spent on finding out fronts
  Sight sight = sightOf(input);
  DrawnView view = drawnView(sight, casters.tree.scale);
  DrawnLight light = drawnLight(from.light, casters.eye, casters.tree.scale);

  /// What whole triangles of a run see of the light; nothing where that is not known yet, and the frame has spent on
  /// finding out as much as it may: at most half of what it takes otherwise.
  std::optional<RunFronts> frontsOf(std::size_t run) const;

  /// Where the rays of a point start; nothing where they start at the point.
  std::optional<SurfacePoint> smoothStart(const SurfacePoint& point, const WayToLight& way) const {
    if (!from.smooth || point.instance == kNoSurface || shadowed[point.instance] == 0) return std::nullopt;
    return smoothPoint(casters.tree, from.light, point, way);
  }

  /// What a point sees of the light where that takes no rays.
  std::optional<float> withoutRays(const SurfacePoint& point, const WayToLight& way) const {
    if (point.instance == kNoSurface || shadowed[point.instance] == 0) return 1.0f;
    if (!faces(point.normal, way)) return 0.0f;
    if (!reaches(from.light, way)) return 1.0f;
    return std::nullopt;
  }
};

} // namespace gnomon

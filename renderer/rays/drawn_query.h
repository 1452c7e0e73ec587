#pragma once

#include <array>

#include "renderer/rays/drawn_points.h"
#include "renderer/rays/shadow_rays.h"

namespace gnomon {

/// Embree's context, and what its filter needs of drawn points.
struct DrawnQuery {
  RTCIntersectContext context;
  const Casters* casters = nullptr;
  const LightSource* source = nullptr;
  const TraceInput* input = nullptr;
  const DrawnPlaces* places = nullptr;
  const DrawnPoints* points = nullptr;
  std::array<float, kLanes> through{}; ///< of the light, past the casters met so far that let some of it through
};

/// The share of the light that comes through along the way of each lane that is active.
std::array<float, kLanes> sharesThrough(DrawnQuery& query, const Lanes& lanes);

} // namespace gnomon

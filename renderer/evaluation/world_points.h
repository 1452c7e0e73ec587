#pragma once

#include <vector>

#include "renderer/reference/trace.h"

namespace gnomon {

/// What the camera's rays through about `count` places, evenly spread over the picture, meet first.
std::vector<SurfacePoint> spreadPoints(const TraceInput& input, int count);

/// Drops the points that the camera does not see: outside of its view, or behind another surface.
void keepInSight(const TraceInput& input, std::vector<SurfacePoint>& points);

/// The points where light `light` arrives unless something stands in its way, and where its shadow shows.
std::vector<SurfacePoint> receiversOf(const TraceInput& input, int light, const std::vector<SurfacePoint>& points);

} // namespace gnomon

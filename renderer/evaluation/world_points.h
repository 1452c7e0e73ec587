#pragma once

#include <vector>

#include "protocol/evaluation/evaluation.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// What the camera's rays through about `count` places, evenly spread over the picture, meet first.
std::vector<SurfacePoint> spreadPoints(const TraceInput& input, int count);

/// Drops the points that the camera does not see: outside of its view, or behind another surface.
void keepInSight(const TraceInput& input, std::vector<SurfacePoint>& points);

/// The points where light `light` arrives unless something blocks it, and where its shadow shows.
std::vector<SurfacePoint> receiversOf(const TraceInput& input, int light, const std::vector<SurfacePoint>& points);

/// The cameras of a path, one a frame; `start`: the effective camera that a path of steps begins at.
std::vector<Camera> camerasAlong(const CameraPath& path, const Camera& start);

} // namespace gnomon

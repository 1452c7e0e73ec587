#pragma once

#include "protocol/base/result.h"
#include "renderer/environment/environment.h"
#include "renderer/frame/environment_cache.h"
#include "renderer/frame/settle_frame.h"

namespace gnomon {

/// The environment of a frame, made now if need be. Problems at /environment/file where the file is broken.
Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, const SettledFrame& settled);

/// A turn about +Y: directions of the map from directions of the world, which see it turned clockwise from above.
glm::dmat3 mapFromWorld(double rotationDegrees);

} // namespace gnomon

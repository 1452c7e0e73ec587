#pragma once

#include "protocol/base/result.h"
#include "renderer/environment/environment.h"
#include "renderer/frame/environment_cache.h"
#include "renderer/frame/settle_frame.h"

namespace gnomon {

/// The environment of a frame, made now if need be, from the map that settling has read if it has. Problems at
/// /environment/file.
Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, SettledFrame& settled);

} // namespace gnomon

#pragma once

#include "protocol/base/result.h"
#include "renderer/environment/environment.h"
#include "renderer/frame/environment_cache.h"
#include "renderer/frame/settle_frame.h"

namespace gnomon {

/// The environment of a frame, made now if need be, from the map that settling has read if it has. Problems at
/// placeOfSource.
Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, SettledFrame& settled);

/// The same of a scene and settled options; `split` where the file was read just now.
Result<FrameEnvironment> environmentOf(EnvironmentCache& cache, const Scene& loaded, const EnvironmentOptions& options,
                                       std::optional<SplitEnvironment> split = {});

} // namespace gnomon

#pragma once

#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/environment/environment.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/frame/volume_cache.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

struct MadeVolumes {
  FrameVolumes volumes;
  std::vector<VolumeReport> reports; ///< one a volume of the spec
};

/// The volumes of a frame with the light in them, made now if need be. Surfaces shade them by rays to the middle of
/// each light, whatever its technique, and by rays all around from the environment where the frame asks for its
/// shadows. A problem at /volumes/i/file where a file is broken.
Result<MadeVolumes> volumesOf(VolumeCache& cache, TracedSceneCache& traced, const SettledFrame& settled,
                              const FrameEnvironment& environment);

} // namespace gnomon

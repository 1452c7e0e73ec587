#pragma once

#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/frame/volume_cache.h"
#include "renderer/volume/frame_volumes.h"

namespace gnomon {

struct MadeVolumes {
  FrameVolumes volumes;
  std::vector<VolumeReport> reports; ///< one a volume of the spec
};

/// Every problem of a frame's volumes that is known without reading them: at /volumes where a file is missing, a place
/// is flat or the picture is too large, at /lights where there are more than may shine on volumes. `frame.volumes` may
/// be empty, where their nodes were refused.
Status checkVolumes(const Scene& loaded, const ResolvedFrame& frame);

/// The volumes of a frame with the light in them, made now if need be. Surfaces shade them by rays to the middle of
/// each light, whatever its technique. A problem at /volumes/i/file where a file is broken.
Result<MadeVolumes> volumesOf(VolumeCache& cache, TracedSceneCache& traced, const SettledFrame& settled);

} // namespace gnomon

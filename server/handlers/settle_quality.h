#pragma once

#include "protocol/spec/quality.h"
#include "server/frames/services.h"
#include "server/http/router.h"

namespace gnomon {

/// The settings that meet the target of `spec`: chosen for an earlier frame of this scene and class of views, or found
/// now by drawing and measuring, which takes many frames. Problems as an evaluation gives; in the spec's own places.
Result<QualityReport> settleQuality(Services& services, const RouteCall& call, const std::string& sceneId,
                                    const LoadedScene& scene, const FrameSpec& spec);

} // namespace gnomon

#pragma once

#include "protocol/base/result.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// A problem for each light whose technique can't serve all that casts from it: shadow volumes have no holes, so that
/// every caster must be opaque. `asked`: the spec before it was settled, whose fields are pointed at.
Status checkTechniques(const FrameSpec& asked, const Scene& scene, const ResolvedFrame& frame);

} // namespace gnomon

#pragma once

#include "clients/cli/progress.h"
#include "clients/cli/rendered.h"
#include "protocol/capabilities.h"
#include "protocol/frame_spec.h"
#include "protocol/result.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Renders in this process. The report gets the stages `load` and `encode` besides the renderer's own.
Result<Rendered> renderHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                            Progress& progress);

} // namespace gnomon::cli

#pragma once

#include "clients/cli/render/rendered.h"
#include "clients/cli/terminal/progress.h"
#include "protocol/base/result.h"
#include "protocol/report/capabilities.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Renders in this process. The report gets the stages `load` and `encode` besides the renderer's own.
Result<Rendered> renderHere(const SceneBundle& bundle, const FrameSpec& spec, const BackendOptions& backend,
                            Progress& progress);

} // namespace gnomon::cli

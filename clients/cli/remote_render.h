#pragma once

#include <string>

#include "clients/cli/progress.h"
#include "clients/cli/rendered.h"
#include "protocol/frame_spec.h"
#include "protocol/result.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// Renders on `server` ("http://host:port"): uploads the scene unless it is there, then asks for the frame. What the
/// server refuses comes back as its own problems.
Result<Rendered> renderThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                             Progress& progress);

/// The same for a plan: its JSON.
Result<std::string> planThere(const std::string& server, const SceneBundle& bundle, const FrameSpec& spec,
                              Progress& progress);

} // namespace gnomon::cli

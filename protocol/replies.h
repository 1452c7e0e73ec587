#pragma once

#include <string>
#include <vector>

#include "protocol/capabilities.h"
#include "protocol/frame_report.h"
#include "protocol/limits.h"
#include "protocol/scene_summary.h"

namespace gnomon {

/// A picture within a JSON reply.
struct ImageReply {
  std::string view{};        ///< of an EXR, which holds every view, the first
  std::string contentType{}; ///< "image/png" | "image/x-exr"
  std::string data{};        ///< the file in base64
};

/// A frame asked for as application/json.
struct FrameReply {
  FrameReport report{};
  std::vector<ImageReply> images{}; ///< a PNG for each view, or one EXR of them all
};

/// GET /v1/scenes.
struct SceneList {
  std::vector<SceneSummary> scenes{};
};

/// GET /v1/capabilities.
struct Capabilities {
  std::string version{}; ///< Gnomon's own
  RendererInfo renderer{};
  Limits limits = kLimits;
};

} // namespace gnomon

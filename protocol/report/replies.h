#pragma once

#include <string>
#include <vector>

#include "protocol/report/capabilities.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/scene_summary.h"
#include "protocol/spec/limits.h"

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

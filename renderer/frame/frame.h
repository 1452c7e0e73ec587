#pragma once

#include <memory>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "renderer/image/image.h"

/// Part of the door: see render.h.
namespace gnomon {

struct Scene;
using ScenePtr = std::shared_ptr<const Scene>;

/// One picture: its pixels are of the type that the frame's output asks for (pixelTypeOf).
struct ViewImage {
  View view = View::color;
  Image image;
};

/// A rendered frame, not yet encoded. Stages queue, load and encode are the caller's to add to the report.
struct Frame {
  FrameReport report;
  std::vector<ViewImage> images; ///< in the order of the spec's views
};

/// What rendering `spec` on a device of that kind would do, without one: bounds replace what the camera sees. Any
/// thread. The same problems as render gives, but for those of files that drawing reads, and of what is drawn.
Result<PlanReport> planFrame(const ScenePtr& scene, const FrameSpec& spec, const RendererInfo& device);

} // namespace gnomon

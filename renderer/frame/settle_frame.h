#pragma once

#include <optional>
#include <vector>

#include "protocol/report/replies.h"
#include "renderer/frame/environment_lights.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/motion_view.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon {

/// A frame of which all is known but what the camera sees.
struct SettledFrame {
  ScenePtr loaded;
  ScenePtr scene; ///< posed
  ResolvedFrame frame;
  std::optional<EarlierMoment> earlier; ///< what view motion compares with; there where the frame has that view
  std::vector<int> layered;             ///< layeredLights
  SettledEnvironment environment{};

  const SceneView& view() const { return scene->scenes[static_cast<std::size_t>(frame.scene)]; }
};

/// Settles a spec, as it was asked for and past protocol/validate, on its scene and on the device that draws it; null =
/// none does, as for a bake. Whatever draws, plans, bakes or measures a frame begins with this. Problems: all that are
/// known without drawing; not those of a plan (settlePlan), of files that drawing reads, and of light maps that become
/// too large. Any thread.
Result<SettledFrame> settleFrame(const ScenePtr& loaded, const FrameSpec& asked, const RendererInfo* device);

} // namespace gnomon

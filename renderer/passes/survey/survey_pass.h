#pragma once

#include "protocol/base/result.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What the camera sees.
struct Survey {
  SeenDepths seen;
  std::vector<std::uint8_t> inView;  ///< one a slot: inside the view, hidden or not
  std::vector<std::uint8_t> visible; ///< one a slot: not surely hidden behind others
  gl::Texture depth;                 ///< D32F, reversed
  int samples = 1;                   ///< a pixel
  std::uint64_t triangles = 0;       ///< drawn
  std::size_t drawCalls = 0;
  gl::Timer timer;
};

/// Draws the depth of everything in view that is not surely hidden, and reduces it. Of many triangles the nearest are
/// drawn first, so that what they hide need not be. `samples`: 1 or 4. `parts`: as FrameWork's.
Result<Survey> surveyScene(const PassInputs& inputs, int samples, std::span<const std::uint32_t> parts = {});

} // namespace gnomon

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
  ReceiverDepths receivers;
  std::vector<std::uint8_t> inView;  ///< one a slot: inside the view, hidden or not
  std::vector<std::uint8_t> visible; ///< one a slot: not surely hidden behind others
  gl::Texture depth;                 ///< D32F, reversed
  int samples = 1;                   ///< a pixel
  std::uint64_t triangles = 0;       ///< drawn
  std::size_t drawCalls = 0;
  gl::Timer timer;
};

/// Draws the depth of everything in view that is not surely hidden, and reduces it. Of many triangles the nearest are
/// drawn first, so that what they hide need not be. `samples`: 1 or 4.
Result<Survey> surveyScene(const PassInputs& inputs, int samples);

/// Reduces a reversed depth buffer of the frame (`samples` a pixel: 1 or 4) to what each block of pixels shows.
Result<ReceiverDepths> depthBlocks(const PassInputs& inputs, const gl::Texture& depth, int samples);

} // namespace gnomon

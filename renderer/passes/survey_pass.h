#pragma once

#include "protocol/result.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What the camera sees.
struct Survey {
  ReceiverDepths receivers;
  std::vector<std::uint8_t> drawn;   ///< one a slot: inside the view
  std::vector<std::uint8_t> visible; ///< one a slot: not surely hidden behind others
  gl::Texture depth;                 ///< D32F, reversed
  int samples = 1;                   ///< a pixel
  std::uint64_t triangles = 0;       ///< drawn
  std::size_t drawCalls = 0;
};

/// Draws the depth of everything in view, and reduces it. `samples`: 1 or 4.
Result<Survey> surveyScene(const PassInputs& inputs, int samples);

/// The view depth in metres of a reversed depth value.
double viewDepthOf(const CameraView& camera, double depth);

} // namespace gnomon

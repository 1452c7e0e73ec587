#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/survey/survey_pass.h"
#include "renderer/passes/views/surface_pass.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// What volumes are to a picture of one number of samples a pixel: found by the processor, read by shaders.
struct VolumeLayers {
  gl::Texture picture;               ///< RGBA32F: marchPicture; empty where no view shows them
  std::vector<std::uint16_t> shadow; ///< volumeShadowPicture; empty where they shade no light
  gl::Timer timer;
};

/// `seen`: some view shows the volumes themselves.
Result<VolumeLayers> volumeLayers(const PassInputs& inputs, const Survey& survey, const Surfaces& surfaces,
                                  const FrameVolumes& volumes, bool seen);

} // namespace gnomon

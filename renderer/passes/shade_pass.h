#pragma once

#include <span>

#include "protocol/frame_spec.h"
#include "protocol/result.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/shadow_pass.h"
#include "renderer/passes/survey_pass.h"

namespace gnomon {

/// One view, drawn: a single-sample color target.
struct ShadedView {
  gl::Texture color; ///< RGBA8 or SRGB8_ALPHA8 when encoded, else RGBA32F
  gl::Framebuffer framebuffer;
  std::uint64_t triangles = 0;
  std::size_t drawCalls = 0;
};

struct ShadeInputs {
  const Survey& survey;
  const ShadowAtlas& atlas;
  std::span<const shared::LightData> lights; ///< GNOMON_MAX_LIGHTS; those past the spec's are not read
  std::span<const shared::TileData> tiles;   ///< GNOMON_LIGHT_TILES for each
  const FrameSpec& spec;                     ///< effective
  int samples = 1;                           ///< of the survey
};

/// Shades any view but the atlas. Pictures (color, cascades) are antialiased as the spec asks; data (depth, normal,
/// shadow) is never averaged: it belongs to the surface at the pixel's centre.
Result<ShadedView> shadeView(const PassInputs& inputs, const ShadeInputs& shade, View view);

} // namespace gnomon

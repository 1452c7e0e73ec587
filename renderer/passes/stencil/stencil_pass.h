#pragma once

#include <cstdint>

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"

namespace gnomon {

/// A depth buffer of the frame with a stencil beside it, where shadow volumes are counted.
struct StencilCounts {
  gl::Texture depthStencil; ///< D32F S8; as many samples as the depth buffer that it was copied from
  gl::Framebuffer framebuffer;
};

/// `depth`: reversed, of the frame's size, 1 or 4 samples a pixel.
Result<StencilCounts> stencilCounts(const PassInputs& inputs, const gl::Texture& depth);

/// What drawing one light's volumes took.
struct DrawnStencil {
  std::size_t casters = 0;
  std::uint64_t triangles = 0; ///< of volumes
  std::size_t drawCalls = 0;
  gl::Timer timer;
};

/// Exact hard shadows of a light, spot or point light's sizes and all filters aside: 1 where the surface that the depth
/// buffer shows sees the light, else 0; one channel a sample. Written into a layer of `visibility` (R16 or RGBA16).
/// The stencil counts the volumes' faces behind each surface (depth-fail: Everitt and Kilgard, 2002), modulo 256: what
/// lies in 256 volumes at once, or a multiple, is taken for lit. REQUIRES: what casts from the light is opaque.
Result<DrawnStencil> drawStencil(const PassInputs& inputs, StencilCounts& counts, const Light& light,
                                 const gl::Texture& visibility, int layer);

} // namespace gnomon

#pragma once

#include <span>

#include "renderer/device/shader_data.h"
#include "renderer/gl/buffer.h"

namespace gnomon {

/// A frame's lights, their tiles and the light lists of the picture's squares, where shaders read them.
struct LightBuffers {
  gl::Buffer lights;
  gl::Buffer tiles;
  gl::Buffer lists;
};

LightBuffers uploadLights(std::span<const LitLight> lights, const ShadowPlan& plan,
                          std::span<const std::uint32_t> lists = {});

} // namespace gnomon

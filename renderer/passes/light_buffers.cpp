#include "renderer/passes/light_buffers.h"

namespace gnomon {

LightBuffers uploadLights(std::span<const LitLight> lights, const ShadowPlan& plan,
                          std::span<const std::uint32_t> lists) {
  return {gl::Buffer(gl::bytesOf(lightData(lights)), "lights"), gl::Buffer(gl::bytesOf(tileData(plan)), "tiles"),
          gl::Buffer(std::as_bytes(lists), "light lists")};
}

} // namespace gnomon

#include "renderer/passes/views/visibility_layers.h"

#include <string>

#include "protocol/spec/limits.h"

namespace gnomon {

Result<VisibilityLayers> makeVisibilityLayers(int width, int height, int samples, int layers) {
  const std::int64_t bytes = std::int64_t{2} * width * height * samples * layers;
  if (bytes > kLimits.maxVisibilityBytes) {
    return Problem{
        ProblemCode::tooLarge, "/lights",
        "What rays and shadow volumes decide for every sample and light would take more memory than a frame may have.",
        std::to_string(kLimits.maxVisibilityBytes) + " bytes", std::to_string(bytes) + " bytes"};
  }
  gl::TextureShape shape{samples > 1 ? GLenum{GL_RGBA16} : GLenum{GL_R16}, width, height};
  shape.layers = layers;
  return VisibilityLayers{gl::Texture(shape, "visibility")};
}

void writeVisibility(VisibilityLayers& layers, int layer, std::span<const std::uint16_t> values) {
  const GLenum format = layers.texture.shape().format == GL_R16 ? GL_RED : GL_RGBA;
  layers.texture.writeLayer(layer, {format, GL_UNSIGNED_SHORT}, std::as_bytes(values));
}

} // namespace gnomon

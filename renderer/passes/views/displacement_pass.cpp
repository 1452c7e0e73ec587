#include "renderer/passes/views/displacement_pass.h"

#include <bit>
#include <glm/gtc/packing.hpp>

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {
namespace {

glm::vec2 downwards(std::uint32_t halves) {
  return glm::unpackHalf2x16(halves) * glm::vec2(1, -1);
}

/// As fromOctahedral of shaders/common_surface.glsl.
glm::vec3 fromOctahedral(const glm::vec2& p) {
  glm::vec3 n(p, 1.0f - std::abs(p.x) - std::abs(p.y));
  const float fold = std::max(-n.z, 0.0f);
  n.x += n.x >= 0 ? -fold : fold;
  n.y += n.y >= 0 ? -fold : fold;
  return glm::normalize(n);
}

MapFootprint footprintOf(const glm::uvec4& lengths, const glm::uvec4& place) {
  MapFootprint footprint;
  footprint.shift = downwards(lengths.x);
  footprint.texelU = downwards(lengths.y);
  footprint.texelV = downwards(lengths.z);
  footprint.tile = static_cast<int>(lengths.w);
  footprint.viewDepth = std::bit_cast<float>(place.x);
  footprint.normal = fromOctahedral(glm::unpackSnorm2x16(place.y));
  return footprint;
}

} // namespace

Result<std::vector<MapFootprint>> mapFootprints(const PassInputs& inputs, const Shading& shading,
                                                const Surfaces& surfaces) {
  const auto program = inputs.programs.get(displacementProgram(lightVariant(inputs, shading, false)));
  if (!program) return program.problems();
  const gl::Texture lengths({GL_RGBA32UI, inputs.width, inputs.height}, "footprint lengths");
  const gl::Texture places({GL_RGBA32UI, inputs.width, inputs.height}, "footprint places");
  const auto target = gl::Framebuffer::create({{{&lengths}, {&places}}, {}}, "footprints");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  gl::apply(state);
  bindInputs(inputs);
  const ShadowBindings bindings(shading);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "surface texels");
  bindTexture(depthOf(surfaces, shading.survey), texels, GNOMON_DEPTH_UNIT);
  bindTexture(surfaces.bits, texels, GNOMON_SURFACE_UNIT);
  const gl::Texture& atlas = shading.atlas.textures->depth;
  (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
  (*program)->set(GNOMON_ATLAS_SIZE, glm::vec2(atlas.width(), atlas.height()));
  (*program)->set(GNOMON_SAMPLE_POSITIONS, surfaces.samplePositions.front());
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);

  const Rect whole{0, 0, inputs.width, inputs.height};
  const auto width = static_cast<std::size_t>(inputs.width);
  const auto height = static_cast<std::size_t>(inputs.height);
  std::vector<glm::uvec4> read(2 * width * height);
  const std::span<glm::uvec4> both(read);
  for (int i = 0; i < 2; ++i) {
    target->readColor(
        i, whole, {GL_RGBA_INTEGER, GL_UNSIGNED_INT},
        std::as_writable_bytes(both.subspan(static_cast<std::size_t>(i) * width * height, width * height)));
  }
  std::vector<MapFootprint> footprints;
  footprints.reserve(width * height);
  for (std::size_t row = height; row-- > 0;) {
    for (std::size_t at = row * width; at < (row + 1) * width; ++at) {
      footprints.push_back(footprintOf(both[at], both[width * height + at]));
    }
  }
  return footprints;
}

} // namespace gnomon

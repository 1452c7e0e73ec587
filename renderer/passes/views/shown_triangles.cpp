#include "renderer/passes/views/shown_triangles.h"

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"

namespace gnomon {
namespace {

/// A pixel's samples as the channels of one texel.
Result<gl::Texture> sideBySide(const PassInputs& inputs, const Surfaces& surfaces) {
  const auto program = inputs.programs.get({"fullscreen.vert", "triangle_samples.frag", {"SAMPLES 4"}});
  if (!program) return program.problems();
  gl::Texture numbers({GL_RGBA32UI, inputs.width, inputs.height}, "triangle numbers, side by side");
  const auto target = gl::Framebuffer::create({{{&numbers}}, {}}, "triangle numbers, side by side");
  if (!target) return target.problems();
  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  gl::apply(state);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "triangle numbers");
  surfaces.triangleNumbers.bind(GNOMON_SURFACE_UNIT);
  texels.bind(GNOMON_SURFACE_UNIT);
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);
  return numbers;
}

} // namespace

Result<std::vector<std::uint32_t>> shownTriangles(const PassInputs& inputs, const Surfaces& surfaces) {
  const std::size_t samples = surfaces.samplePositions.size();
  std::vector<std::uint32_t> shown(static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height) *
                                   samples);
  const Rect whole{0, 0, inputs.width, inputs.height};
  const auto texels = std::as_writable_bytes(std::span(shown));
  if (samples == 1) {
    surfaces.triangleNumbers.read(0, whole, {GL_RED_INTEGER, GL_UNSIGNED_INT}, texels);
    return shown;
  }
  const auto numbers = sideBySide(inputs, surfaces);
  if (!numbers) return numbers.problems();
  numbers->read(0, whole, {GL_RGBA_INTEGER, GL_UNSIGNED_INT}, texels);
  return shown;
}

} // namespace gnomon

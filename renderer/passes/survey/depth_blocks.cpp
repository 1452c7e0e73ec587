#include "renderer/passes/survey/depth_blocks.h"

#include <algorithm>

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/prepare/box_depths.h"

namespace gnomon {
namespace {

/// Three values a block, from the top row down: the nearest and the farthest depth, 0 and 1 = nothing; and the samples
/// that show no surface.
Result<std::vector<glm::vec4>> reduceBlocks(const PassInputs& inputs, const gl::Texture& depth, int samples,
                                            const ReceiverDepths& grid) {
  const auto program =
      inputs.programs.get({"fullscreen.vert", "survey_reduce.frag", {"SAMPLES " + std::to_string(samples)}});
  if (!program) return program.problems();
  const gl::Texture blocks({GL_RGBA32F, grid.columns, grid.rows}, "survey blocks");
  auto target = gl::Framebuffer::create({{{&blocks}}, {}}, "survey blocks");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, grid.columns, grid.rows};
  gl::apply(state);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "survey texels");
  texels.bind(0);
  depth.bind(0);
  (*program)->set(GNOMON_FRAME_SIZE, glm::ivec2(inputs.width, inputs.height));
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);

  std::vector<glm::vec4> depths(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  target->readColor(0, {0, 0, grid.columns, grid.rows}, {GL_RGBA, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  return depths;
}

void fillBlocks(ReceiverDepths& grid, const CameraView& camera, const std::vector<glm::vec4>& depths) {
  grid.blocks.reserve(depths.size());
  for (const glm::vec4& depth : depths) {
    DepthSpan span;
    if (depth.x > 0.0f) {
      span.nearest = static_cast<float>(viewDepthOf(camera, depth.x));
      span.farthest = static_cast<float>(viewDepthOf(camera, depth.y));
      span.open = depth.z > 0.0f;
      if (grid.range.empty()) grid.range = span;
      grid.range.nearest = std::min(grid.range.nearest, span.nearest);
      grid.range.farthest = std::max(grid.range.farthest, span.farthest);
    }
    grid.blocks.push_back(span);
  }
}

} // namespace

double viewDepthOf(const CameraView& camera, double depth) {
  const glm::dmat4 clip = clipFromView(camera);
  const double a = clip[2][2];
  const double b = clip[3][2];
  return camera.perspective ? b / (depth + a) : (b - depth) / a;
}

Result<ReceiverDepths> depthBlocks(const PassInputs& inputs, const gl::Texture& depth, int samples) {
  ReceiverDepths grid = emptyDepths(inputs.width, inputs.height);
  const auto depths = reduceBlocks(inputs, depth, samples, grid);
  if (!depths) return depths.problems();
  fillBlocks(grid, inputs.camera, *depths);
  return grid;
}

} // namespace gnomon

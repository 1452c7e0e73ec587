#include "renderer/passes/survey_pass.h"

#include <algorithm>

#include "renderer/core/frustum.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/sampler.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/occlusion.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

std::vector<std::uint8_t> slotsInView(const PassInputs& inputs) {
  const Frustum frustum = frustumOf(inputs.camera);
  std::vector<std::uint8_t> keep(inputs.geometry.slotCount());
  std::transform(inputs.geometry.slotBounds.begin(), inputs.geometry.slotBounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayIntersect(frustum, box)); });
  return keep;
}

Status drawSurvey(const PassInputs& inputs, const DrawBatch& batch, gl::Framebuffer& target, int samples) {
  gl::PipelineState state;
  state.framebuffer = target.id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = {true, true, GL_GREATER};
  state.multisample = samples > 1;
  gl::apply(state);
  target.clearDepth(0.0f);

  bindInputs(inputs);
  for (const DrawGroup& group : batch.groups) {
    const Material* masked =
        group.material < 0 ? nullptr : &inputs.scene.materials[static_cast<std::size_t>(group.material)];
    const auto program =
        inputs.programs.get({"survey.vert", masked != nullptr ? "masked_depth.frag" : "", "", maskDefines(masked)});
    if (!program) return program.problems();
    if (masked != nullptr) bindMaterial(inputs.gpu, group.material, **program);
    state.cull = group.cull;
    state.frontFace = group.frontFace;
    gl::apply(state);
    drawGroup(batch, group, inputs.vertices, **program);
  }
  return Done{};
}

/// Two depth values a block, from the top row down: the nearest and the farthest; 0 and 1 = nothing.
Result<std::vector<glm::vec2>> reduceBlocks(const PassInputs& inputs, const gl::Texture& depth, int samples,
                                            const ReceiverDepths& grid) {
  const auto program =
      inputs.programs.get({"fullscreen.vert", "survey_reduce.frag", "", {"SAMPLES " + std::to_string(samples)}});
  if (!program) return program.problems();
  const gl::Texture blocks({GL_RG32F, grid.columns, grid.rows}, "survey blocks");
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

  std::vector<glm::vec2> depths(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  target->readColor(0, {0, 0, grid.columns, grid.rows}, {GL_RG, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  return depths;
}

ReceiverDepths emptyGrid(int width, int height) {
  ReceiverDepths grid;
  grid.blockSize = GNOMON_BLOCK_SIZE;
  grid.width = width;
  grid.height = height;
  grid.columns = (width + grid.blockSize - 1) / grid.blockSize;
  grid.rows = (height + grid.blockSize - 1) / grid.blockSize;
  return grid;
}

void fillBlocks(ReceiverDepths& grid, const CameraView& camera, const std::vector<glm::vec2>& depths) {
  grid.blocks.reserve(depths.size());
  for (const glm::vec2& depth : depths) {
    DepthSpan span;
    if (depth.x > 0.0f) {
      span.nearest = static_cast<float>(viewDepthOf(camera, depth.x));
      span.farthest = static_cast<float>(viewDepthOf(camera, depth.y));
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

Result<Survey> surveyScene(const PassInputs& inputs, int samples) {
  Survey survey;
  survey.drawn = slotsInView(inputs);
  const DrawBatch batch =
      uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::survey, survey.drawn));
  survey.samples = samples;
  survey.triangles = batch.triangles;
  survey.drawCalls = batch.drawCalls;

  survey.depth =
      gl::Texture({GL_DEPTH_COMPONENT32F, inputs.width, inputs.height, 1, samples > 1 ? samples : 0}, "survey depth");
  auto target = gl::Framebuffer::create({{}, {&survey.depth}}, "survey");
  if (!target) return target.problems();
  if (const Status drawn = drawSurvey(inputs, batch, *target, samples); !drawn) return drawn.problems();

  survey.receivers = emptyGrid(inputs.width, inputs.height);
  const auto depths = reduceBlocks(inputs, survey.depth, samples, survey.receivers);
  if (!depths) return depths.problems();
  fillBlocks(survey.receivers, inputs.camera, *depths);
  survey.visible = visibleBoxes(inputs.camera, survey.receivers, inputs.geometry.slotBounds, survey.drawn);
  return survey;
}

} // namespace gnomon

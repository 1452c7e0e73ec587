#include "renderer/passes/survey_pass.h"

#include <algorithm>

#include "renderer/core/frustum.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/sampler.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

struct Targets {
  gl::Texture depth;
  gl::Texture cluster;
};

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
  target.clearColor(0, glm::uvec4(0));

  bindInputs(inputs);
  for (const DrawGroup& group : batch.groups) {
    const Material* masked =
        group.material < 0 ? nullptr : &inputs.scene.materials[static_cast<std::size_t>(group.material)];
    const auto program = inputs.programs.get({"survey.vert", "survey.frag", "", maskDefines(masked)});
    if (!program) return program.problems();
    if (masked != nullptr) bindMaterial(inputs.gpu, group.material);
    state.cull = group.cull;
    state.frontFace = group.frontFace;
    gl::apply(state);
    drawGroup(batch, group, **program);
  }
  return Done{};
}

/// Two floats a block, from the top row down: greatest and least depth value; -1 = nothing.
Result<std::vector<glm::vec2>> reduceBlocks(const PassInputs& inputs, const Targets& targets, int samples,
                                            const ReceiverDepths& grid, const gl::Buffer& visible) {
  const auto program =
      inputs.programs.get({"fullscreen.vert", "survey_reduce.frag", "", {"SAMPLES " + std::to_string(samples)}});
  if (!program) return program.problems();
  gl::Texture blocks({GL_RG32F, grid.columns, grid.rows}, "survey blocks");
  auto target = gl::Framebuffer::create({{{&blocks}}, {}}, "survey blocks");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, grid.columns, grid.rows};
  gl::apply(state);
  // Unfiltered: an integer texture behind a filtering sampler reads as zero.
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "survey texels");
  for (const GLuint unit : {0u, 1u}) texels.bind(unit);
  targets.depth.bind(0);
  targets.cluster.bind(1);
  visible.bindStorage(GNOMON_VISIBLE_BUFFER);
  (*program)->set(0, glm::ivec2(inputs.width, inputs.height));
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

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
    if (depth.x >= 0.0f) {
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
      uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::survey, survey.drawn), inputs.gpu);
  survey.triangles = batch.triangles;
  survey.drawCalls = batch.drawCalls;

  const int stored = samples > 1 ? samples : 0;
  Targets targets{{{GL_DEPTH_COMPONENT32F, inputs.width, inputs.height, 1, stored}, "survey depth"},
                  {{GL_R32UI, inputs.width, inputs.height, 1, stored}, "survey clusters"}};
  auto target = gl::Framebuffer::create({{{&targets.cluster}}, {&targets.depth}}, "survey");
  if (!target) return target.problems();
  if (const Status drawn = drawSurvey(inputs, batch, *target, samples); !drawn) return drawn.problems();

  survey.receivers = emptyGrid(inputs.width, inputs.height);
  gl::Buffer visible(inputs.geometry.slotCount() * sizeof(std::uint32_t), "visible clusters");
  const auto depths = reduceBlocks(inputs, targets, samples, survey.receivers, visible);
  if (!depths) return depths.problems();
  fillBlocks(survey.receivers, inputs.camera, *depths);

  std::vector<std::uint32_t> marks(inputs.geometry.slotCount());
  visible.read(0, std::as_writable_bytes(std::span(marks)));
  survey.visible.resize(marks.size());
  std::transform(marks.begin(), marks.end(), survey.visible.begin(),
                 [](std::uint32_t mark) { return static_cast<std::uint8_t>(mark != 0); });
  survey.depth = std::move(targets.depth);
  return survey;
}

} // namespace gnomon

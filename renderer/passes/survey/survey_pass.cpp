#include "renderer/passes/survey/survey_pass.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "renderer/core/camera_view.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/prepare/box_depths.h"
#include "renderer/prepare/cluster_choice.h"

namespace gnomon {

namespace {

/// Adds the depth of the slots that `keep` marks.
Status drawDepth(const PassInputs& inputs, const std::vector<std::uint8_t>& keep, GLuint framebuffer, Survey& survey) {
  const DrawBatch batch = uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::survey, keep));
  survey.triangles += batch.triangles;
  survey.drawCalls += batch.drawCalls;

  gl::PipelineState state;
  state.framebuffer = framebuffer;
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = {true, true, GL_GREATER};
  state.multisample = survey.samples > 1;
  bindInputs(inputs);
  return drawGroups(inputs, inputs.vertices, batch, state, [&](const DrawGroup&, const Material* masked) {
    return inputs.programs.get(depthProgram("survey.vert", masked));
  });
}

/// Three values a block, from the top row down: the nearest and the farthest depth, 0 and 1 = nothing; and the samples
/// that show no surface. `part`: the depths of some surfaces alone, which count where they are those that are seen;
/// null = all count.
Result<std::vector<glm::vec4>> reduceBlocks(const PassInputs& inputs, const gl::Texture& depth, const gl::Texture* part,
                                            int samples, const ReceiverDepths& grid) {
  std::vector<std::string> defines{"SAMPLES " + std::to_string(samples)};
  if (part != nullptr) defines.emplace_back("PART");
  const auto program = inputs.programs.get({"fullscreen.vert", "survey_reduce.frag", defines});
  if (!program) return program.problems();
  const gl::Texture blocks({GL_RGBA32F, grid.columns, grid.rows}, "survey blocks");
  auto target = gl::Framebuffer::create({{{&blocks}}, {}}, "survey blocks");
  if (!target) return target.problems();

  const Rect whole{0, 0, grid.columns, grid.rows};
  (*program)->set(GNOMON_FRAME_SIZE, glm::ivec2(inputs.width, inputs.height));
  gl::drawFullscreen(**program, {.framebuffer = target->id(), .viewport = whole}, {{0, &depth}, {1, part}});

  std::vector<glm::vec4> depths(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  target->readColor(0, whole, {GL_RGBA, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
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

Result<ReceiverDepths> depthBlocks(const PassInputs& inputs, const gl::Texture& depth, const gl::Texture* part,
                                   int samples) {
  ReceiverDepths grid = emptyDepths(inputs.width, inputs.height);
  const auto depths = reduceBlocks(inputs, depth, part, samples, grid);
  if (!depths) return depths.problems();
  fillBlocks(grid, inputs.camera, *depths);
  return grid;
}

struct DepthTarget {
  gl::Texture depth;
  gl::Framebuffer framebuffer;
};

/// Shows nothing yet.
Result<DepthTarget> clearedTarget(const PassInputs& inputs, int samples) {
  DepthTarget target;
  target.depth =
      gl::Texture({GL_DEPTH_COMPONENT32F, inputs.width, inputs.height, 1, samples > 1 ? samples : 0}, "survey depth");
  auto framebuffer = gl::Framebuffer::create({{}, {&target.depth}}, "survey");
  if (!framebuffer) return framebuffer.problems();
  gl::PipelineState clear;
  clear.framebuffer = framebuffer->id();
  clear.viewport = {0, 0, inputs.width, inputs.height};
  clear.depth.write = true;
  gl::apply(clear);
  framebuffer->clearDepth(0.0f);
  target.framebuffer = std::move(*framebuffer);
  return target;
}

/// What is seen of the surfaces of some receiver groups: they are drawn by themselves, and count where they lie as deep
/// as what all of them show.
Result<ReceiverDepths> depthsOfPart(const PassInputs& inputs, std::uint32_t groups, Survey& survey) {
  const std::vector<std::uint8_t> slots = slotsOfGroups(inputs.geometry, groups, survey.visible);
  if (slots == survey.visible) return survey.seen.all;
  auto target = clearedTarget(inputs, survey.samples);
  if (!target) return target.problems();
  if (const Status drawn = drawDepth(inputs, slots, target->framebuffer.id(), survey); !drawn) return drawn.problems();
  return depthBlocks(inputs, survey.depth, &target->depth, survey.samples);
}

} // namespace

Result<Survey> surveyScene(const PassInputs& inputs, int samples, std::span<const std::uint32_t> parts) {
  Survey survey;
  survey.timer = gl::Timer::start();
  survey.samples = samples;
  survey.inView = slotsInView({inputs.scene, inputs.view, inputs.geometry, inputs.camera, inputs.nodes});
  auto target = clearedTarget(inputs, samples);
  if (!target) return target.problems();
  const GLuint framebuffer = target->framebuffer.id();

  std::vector<std::uint8_t> drawn =
      firstToDraw({inputs.scene, inputs.view, inputs.geometry, inputs.camera, inputs.nodes}, survey.inView);
  if (const Status first = drawDepth(inputs, drawn, framebuffer, survey); !first) return first.problems();
  auto blocks = depthBlocks(inputs, target->depth, nullptr, samples);
  if (!blocks) return blocks.problems();
  if (drawn != survey.inView) {
    const std::vector<std::uint8_t> rest =
        unhiddenBoxes(inputs.camera, *blocks, inputs.geometry.slotBounds, without(survey.inView, drawn));
    if (const Status second = drawDepth(inputs, rest, framebuffer, survey); !second) return second.problems();
    std::transform(drawn.begin(), drawn.end(), rest.begin(), drawn.begin(), std::bit_or<>());
    blocks = depthBlocks(inputs, target->depth, nullptr, samples);
    if (!blocks) return blocks.problems();
  }
  survey.depth = std::move(target->depth);
  survey.seen.all = std::move(*blocks);
  survey.visible = visibleBoxes(inputs.camera, survey.seen.all, inputs.geometry.slotBounds, drawn);
  for (const std::uint32_t groups : parts) {
    auto part = depthsOfPart(inputs, groups, survey);
    if (!part) return part.problems();
    survey.seen.parts.push_back(std::move(*part));
  }
  survey.timer.stop();
  return survey;
}

} // namespace gnomon

#include "renderer/passes/survey/survey_pass.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "renderer/core/camera_view.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/survey/depth_blocks.h"
#include "renderer/prepare/occlusion.h"

namespace gnomon {
namespace {

std::vector<std::uint8_t> slotsInView(const PassInputs& inputs) {
  const Frustum frustum = frustumOf(inputs.camera);
  std::vector<std::uint8_t> keep(inputs.geometry.slotCount());
  std::transform(inputs.geometry.slotBounds.begin(), inputs.geometry.slotBounds.end(), keep.begin(),
                 [&](const Aabb& box) { return static_cast<std::uint8_t>(mayIntersect(frustum, box)); });
  keepNodes(
      inputs.nodes, inputs.view, inputs.geometry, [](const NodeSwitches& node) { return node.visible; }, keep);
  return keep;
}

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

/// Below this, finding what is hidden takes longer than drawing it.
constexpr std::uint64_t kTrianglesWorthHiding = 1u << 16;
/// The share of the triangles in view, the nearest ones, that is drawn first to hide others.
constexpr double kFirstShare = 0.12;

std::uint64_t trianglesIn(const PassInputs& inputs, std::uint32_t slot, std::size_t instance) {
  const Primitive& primitive =
      inputs.scene.primitives[static_cast<std::size_t>(inputs.view.instances[instance].primitive)];
  const std::uint32_t first = (slot - inputs.geometry.firstSlot[instance]) * kClusterTriangles;
  return std::min(kClusterTriangles, primitive.indexCount / 3 - first);
}

/// The nearest slots, with a share of all triangles in view; every one where there are few.
std::vector<std::uint8_t> firstToDraw(const PassInputs& inputs, const std::vector<std::uint8_t>& inView) {
  struct Seen {
    double nearest;
    std::uint32_t slot;
    std::uint64_t triangles;
  };
  std::vector<Seen> seen;
  std::uint64_t total = 0;
  for (std::size_t instance = 0; instance < inputs.view.instances.size(); ++instance) {
    for (std::uint32_t slot = inputs.geometry.firstSlot[instance]; slot < inputs.geometry.firstSlot[instance + 1];
         ++slot) {
      if (inView[slot] == 0) continue;
      const Aabb& box = inputs.geometry.slotBounds[slot];
      const double nearest =
          glm::dot(box.center(), inputs.camera.forward) - glm::dot(box.halfExtent(), glm::abs(inputs.camera.forward));
      seen.push_back({nearest, slot, trianglesIn(inputs, slot, instance)});
      total += seen.back().triangles;
    }
  }
  if (total < kTrianglesWorthHiding) return inView;
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return std::tie(a.nearest, a.slot) < std::tie(b.nearest, b.slot); });
  std::vector<std::uint8_t> first(inView.size());
  auto left = static_cast<std::int64_t>(kFirstShare * static_cast<double>(total));
  for (const Seen& each : seen) {
    if (left <= 0) break;
    first[each.slot] = 1;
    left -= static_cast<std::int64_t>(each.triangles);
  }
  return first;
}

} // namespace

Result<Survey> surveyScene(const PassInputs& inputs, int samples) {
  Survey survey;
  survey.timer = gl::Timer::start();
  survey.samples = samples;
  survey.inView = slotsInView(inputs);
  survey.depth =
      gl::Texture({GL_DEPTH_COMPONENT32F, inputs.width, inputs.height, 1, samples > 1 ? samples : 0}, "survey depth");
  auto target = gl::Framebuffer::create({{}, {&survey.depth}}, "survey");
  if (!target) return target.problems();
  gl::PipelineState clear;
  clear.framebuffer = target->id();
  clear.viewport = {0, 0, inputs.width, inputs.height};
  clear.depth.write = true;
  gl::apply(clear);
  target->clearDepth(0.0f);

  std::vector<std::uint8_t> drawn = firstToDraw(inputs, survey.inView);
  if (const Status first = drawDepth(inputs, drawn, target->id(), survey); !first) return first.problems();
  auto blocks = depthBlocks(inputs, survey.depth, samples);
  if (!blocks) return blocks.problems();
  if (drawn != survey.inView) {
    std::vector<std::uint8_t> rest(drawn.size());
    std::transform(
        survey.inView.begin(), survey.inView.end(), drawn.begin(), rest.begin(),
        [](std::uint8_t seen, std::uint8_t done) { return static_cast<std::uint8_t>(seen != 0 && done == 0); });
    rest = unhiddenBoxes(inputs.camera, *blocks, inputs.geometry.slotBounds, rest);
    if (const Status second = drawDepth(inputs, rest, target->id(), survey); !second) return second.problems();
    std::transform(drawn.begin(), drawn.end(), rest.begin(), drawn.begin(), std::bit_or<>());
    blocks = depthBlocks(inputs, survey.depth, samples);
    if (!blocks) return blocks.problems();
  }
  survey.receivers = std::move(*blocks);
  survey.visible = visibleBoxes(inputs.camera, survey.receivers, inputs.geometry.slotBounds, drawn);
  survey.timer.stop();
  return survey;
}

} // namespace gnomon

#include "renderer/passes/views/surface_pass.h"

#include <algorithm>
#include <optional>

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

bool anythingGlows(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return material.emissiveFactor != glm::vec3(0.0f) || material.unlit || material.transmission > 0;
  });
}

} // namespace

Result<Surfaces> drawSurfaces(const PassInputs& inputs, const Survey& survey, int samples, bool numbered) {
  gl::Timer timer = gl::Timer::start();
  const bool reuse = samples == survey.samples;
  const bool emission = anythingGlows(inputs.scene);
  DrawList list = buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::surface,
                                reuse ? survey.visible : survey.inView);
  Surfaces surfaces;
  gl::Buffer instances;
  if (numbered) {
    surfaces.numbers = TriangleNumbers(inputs.scene, inputs.view, list);
    instances = numberedInstances(inputs.geometry, list);
  }
  const SceneVertices numberedVertices = numbered ? sceneVertices(inputs.gpu, instances) : SceneVertices{};
  const DrawBatch batch = uploadDraws(list);

  surfaces.triangles = batch.triangles;
  surfaces.drawCalls = batch.drawCalls;
  const int stored = samples > 1 ? samples : 0;
  const auto texture = [&](GLenum format, std::string_view label) {
    return gl::Texture({format, inputs.width, inputs.height, 1, stored}, label);
  };
  surfaces.bits = texture(GL_RGBA32UI, "surfaces");
  if (emission) surfaces.emission = texture(GL_RGBA16F, "surface emission");
  if (numbered) surfaces.triangleNumbers = texture(GL_R32UI, "triangle numbers");
  if (!reuse) surfaces.ownDepth = texture(GL_DEPTH_COMPONENT32F, "surface depth");

  gl::Attachments attachments{{{&surfaces.bits}}, {reuse ? &survey.depth : &surfaces.ownDepth}};
  if (emission) attachments.color.push_back({&surfaces.emission});
  if (numbered) attachments.color.push_back({&surfaces.triangleNumbers});
  auto target = gl::Framebuffer::create(attachments, "surfaces");
  if (!target) return target.problems();
  for (int i = 0; i < samples; ++i) {
    surfaces.samplePositions.push_back(samples > 1 ? target->samplePosition(i) : glm::vec2(0.5f));
  }

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = reuse ? gl::DepthState{true, false, GL_EQUAL} : gl::DepthState{true, true, GL_GREATER};
  state.multisample = samples > 1;
  gl::apply(state);
  if (!reuse) target->clearDepth(0.0f);
  if (numbered) target->clearColor(static_cast<int>(attachments.color.size()) - 1, glm::uvec4(kNoNumber));
  bindInputs(inputs);
  const Status drawn = drawGroups(inputs, numbered ? numberedVertices : inputs.vertices, batch, state,
                                  [&](const DrawGroup& group, const Material* material) {
                                    return inputs.programs.get(surfaceProgram(
                                        *material, {group.tangents, emission, inputs.receiverGroups, numbered}));
                                  });
  if (!drawn) return drawn.problems();
  timer.stop();
  surfaces.timer = std::move(timer);
  return surfaces;
}

} // namespace gnomon

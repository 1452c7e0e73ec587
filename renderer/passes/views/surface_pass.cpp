#include "renderer/passes/views/surface_pass.h"

#include <algorithm>
#include <optional>

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/gpu_environments.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

bool anythingGlows(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return material.emissiveFactor != glm::vec3(0.0f) || material.unlit || material.transmission > 0;
  });
}

GLenum sharesFormat(std::size_t lights) {
  return lights == 1 ? GL_R16 : lights == 2 ? GL_RG16 : GL_RGBA16;
}

/// Light maps, bound for the surface pass. Lives as long as that is drawn.
class LightMapBindings {
 public:
  explicit LightMapBindings(std::span<const GpuLightMap* const> maps) : between_({GL_LINEAR, GL_LINEAR}, "light maps") {
    for (GLuint i = 0; i < maps.size(); ++i) {
      maps[i]->shares.bind(GNOMON_LIGHT_MAP_UNIT + i);
      between_.bind(GNOMON_LIGHT_MAP_UNIT + i);
    }
  }

 private:
  gl::Sampler between_;
};

} // namespace

std::size_t Surfaces::bytes() const {
  return bits.bytes() + emission.bytes() + smoothPlaces.bytes() + ownDepth.bytes() + bakedShares.bytes() +
         triangleNumbers.bytes();
}

Result<Surfaces> drawSurfaces(const PassInputs& inputs, const Survey& survey, int samples, const SurfaceAsks& asks) {
  const bool numbered = asks.numbered;
  const GpuMappedScene* const mapped = asks.maps.empty() ? nullptr : asks.maps[0]->scene.get();
  gl::Timer timer = gl::Timer::start();
  const bool reuse = samples == survey.samples;
  const bool emission = anythingGlows(inputs.scene);
  DrawList list = buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::surface,
                                reuse ? survey.visible : survey.inView);
  Surfaces surfaces;
  if (numbered) surfaces.numbers = TriangleNumbers(inputs.scene, inputs.view, list);
  if (mapped != nullptr) drawMapped(inputs.scene, inputs.view, *mapped->layout, list);
  const gl::Buffer copies = numbered ? numberedInstances(inputs.geometry, list) : gl::Buffer();
  const gl::Buffer& instances = numbered ? copies : inputs.instances;
  const bool own = numbered || mapped != nullptr;
  const SceneVertices ownVertices = mapped != nullptr ? mappedVertices(*mapped, instances)
                                    : numbered        ? sceneVertices(inputs.gpu, instances)
                                                      : SceneVertices{};
  const DrawBatch batch = uploadDraws(list);

  surfaces.triangles = batch.triangles;
  surfaces.drawCalls = batch.drawCalls;
  const int stored = samples > 1 ? samples : 0;
  const auto texture = [&](GLenum format, std::string_view label) {
    return gl::Texture({format, inputs.width, inputs.height, 1, stored}, label);
  };
  surfaces.bits = texture(GL_RGBA32UI, "surfaces");
  if (emission) surfaces.emission = texture(GL_RGBA16F, "surface emission");
  if (asks.smoothPlaces) surfaces.smoothPlaces = texture(GL_RG32UI, "smooth places");
  if (mapped != nullptr) surfaces.bakedShares = texture(sharesFormat(asks.maps.size()), "baked shares");
  if (numbered) surfaces.triangleNumbers = texture(GL_R32UI, "triangle numbers");
  if (!reuse) surfaces.ownDepth = texture(GL_DEPTH_COMPONENT32F, "surface depth");

  gl::Attachments attachments{{{&surfaces.bits}}, {reuse ? &survey.depth : &surfaces.ownDepth}};
  if (emission) attachments.color.push_back({&surfaces.emission});
  if (asks.smoothPlaces) attachments.color.push_back({&surfaces.smoothPlaces});
  if (mapped != nullptr) attachments.color.push_back({&surfaces.bakedShares});
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
  const LightMapBindings bound(asks.maps);
  std::optional<EnvironmentBinding> environment;
  if (inputs.environment != nullptr) environment.emplace(*inputs.environment, GNOMON_SURFACE_ENVIRONMENT_UNIT);
  SurfaceVariant variant{.emission = emission, .receiverGroups = inputs.receiverGroups, .numbered = numbered};
  variant.smoothPlaces = asks.smoothPlaces;
  variant.environment = inputs.environment != nullptr;
  variant.bakedLights = static_cast<int>(asks.maps.size());
  if (mapped != nullptr && reuse && samples > 1) variant.shownSamples = samples;
  const auto programOf = [&](const DrawGroup& group, const Material* material) {
    variant.tangents = group.tangents;
    const auto program = inputs.programs.get(surfaceProgram(*material, variant));
    for (int i = 0; program && i < variant.shownSamples; ++i) {
      (*program)->set(GNOMON_SAMPLE_POSITIONS + i, surfaces.samplePositions[static_cast<std::size_t>(i)]);
    }
    return program;
  };
  const Status drawn = drawGroups(inputs, own ? ownVertices : inputs.vertices, batch, state, programOf);
  if (!drawn) return drawn.problems();
  timer.stop();
  surfaces.timer = std::move(timer);
  return surfaces;
}

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
  const auto numbers =
      drawTexture(inputs.programs, "triangle_samples.frag", surfaces.triangleNumbers, GNOMON_SURFACE_UNIT, GL_RGBA32UI);
  if (!numbers) return numbers.problems();
  numbers->read(0, whole, {GL_RGBA_INTEGER, GL_UNSIGNED_INT}, texels);
  return shown;
}

} // namespace gnomon

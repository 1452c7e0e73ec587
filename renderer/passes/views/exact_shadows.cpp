#include "renderer/passes/views/exact_shadows.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/base/elapsed.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/stencil/stencil_pass.h"
#include "renderer/passes/views/surface_pass.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon {

namespace {

/// Draws the next light's layer by shadow volumes; `counts` is made for the first of them.
Status stencilShadow(const PassInputs& inputs, const Shading& shading, const Surfaces& surfaces, const Light& light,
                     std::optional<StencilCounts>& counts, ExactShadows& shadows) {
  if (!counts) {
    auto made = stencilCounts(inputs, depthOf(surfaces, shading.survey));
    if (!made) return made.problems();
    counts = std::move(*made);
    shadows.countBytes = counts->depthStencil.bytes();
  }
  const auto volumes =
      drawStencil(inputs, *counts, light, shadows.layers.texture, static_cast<int>(shadows.lights.size()));
  if (!volumes) return volumes.problems();
  shadows.triangles += volumes->triangles;
  shadows.drawCalls += volumes->drawCalls;
  return Done{};
}

/// The slots with holes that nothing surely hides.
std::vector<std::uint8_t> maskedSlots(const PassInputs& inputs, const Survey& survey) {
  std::vector<std::uint8_t> slots = survey.visible;
  for (std::size_t i = 0; i < inputs.view.instances.size(); ++i) {
    const int material = materialOf(inputs.scene, inputs.view.instances[i]);
    if (hasHoles(inputs.scene.materials[static_cast<std::size_t>(material)])) continue;
    std::fill(slots.begin() + inputs.geometry.firstSlot[i], slots.begin() + inputs.geometry.firstSlot[i + 1], 0);
  }
  return slots;
}

/// Where masked or blended triangles lie before what the survey found, or are it, holes and all: 255 there, one a
/// pixel, from the LOWEST row. Where alpha is as good as the cutoff, their holes may differ from those that rays meet.
/// Empty where the view holds none. With several samples a pixel, also those behind. Waits for the device.
Result<std::vector<std::uint8_t>> maskCoverage(const PassInputs& inputs, const Survey& survey) {
  DrawList list =
      buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::survey, maskedSlots(inputs, survey));
  if (list.ranges.empty()) return std::vector<std::uint8_t>{};
  for (DrawGroup& group : list.groups) group.material = -1; // nothing but positions matters
  const auto program = inputs.programs.get({"survey.vert", "covered.frag", {}});
  if (!program) return program.problems();

  const gl::Texture covered({GL_R8, inputs.width, inputs.height}, "masks");
  const bool depth = survey.samples == 1;
  auto target = gl::Framebuffer::create({{{&covered}}, {depth ? &survey.depth : nullptr}}, "masks");
  if (!target) return target.problems();
  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = {depth, false, GL_GEQUAL};
  gl::apply(state);
  target->clearColor(0, glm::vec4(0.0f));
  bindInputs(inputs);
  const Status drawn =
      drawGroups(inputs, inputs.vertices, uploadDraws(list), state,
                 [&](const DrawGroup&, const Material*) -> Result<const gl::Program*> { return *program; });
  if (!drawn) return drawn.problems();
  std::vector<std::uint8_t> masks(static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height));
  target->readColor(0, state.viewport, {GL_RED, GL_UNSIGNED_BYTE}, std::as_writable_bytes(std::span(masks)));
  return masks;
}

/// What was drawn, as rays and light maps start from it.
struct ShownPicture {
  SampleGrid grid;
  std::shared_ptr<const TracedScene> traced;
  std::vector<std::uint32_t> numbers;
  ShownNumbers shown;
  std::vector<std::uint8_t> masks;
  std::optional<PicturePoints> points; ///< refers to all of these
};

Result<std::unique_ptr<ShownPicture>> readPicture(const PassInputs& inputs, const Shading& shading,
                                                  const FrameWork& work, std::span<const int> layered,
                                                  const Surfaces& surfaces) {
  const std::vector<Light>& lights = *shading.spec.lights;
  auto picture = std::make_unique<ShownPicture>();
  picture->grid = {inputs.width, inputs.height, surfaces.samplePositions};
  const auto traced = work.traced();
  if (!traced) return traced.problems();
  picture->traced = *traced;
  auto numbers = shownTriangles(inputs, surfaces);
  if (!numbers) return numbers.problems();
  picture->numbers = std::move(*numbers);
  picture->shown = inOrder(picture->grid, picture->numbers);
  if (sendsRays(layered, lights)) {
    auto masks = maskCoverage(inputs, shading.survey);
    if (!masks) return masks.problems();
    picture->masks = std::move(*masks);
  }
  const TraceInput rays{*picture->traced, inputs.camera, inputs.width, inputs.height, lights, inputs.nodes};
  picture->points.emplace(rays, picture->grid, surfaces.numbers, picture->shown, picture->masks);
  return picture;
}

TracedShadow shadowOf(const FrameWork& work, const PicturePoints& points, int light) {
  const Shadow& shadow = *points.rays().lights[static_cast<std::size_t>(light)].shadow;
  if (traitsOf(shadow.technique).baked) return bakedShadow(points, *work.baked(light));
  return tracedShadow(points, points.rays(), light, shadow.raySamples);
}

} // namespace

bool needsTriangles(std::span<const int> layered, std::span<const Light> lights) {
  return std::any_of(layered.begin(), layered.end(), [&](int light) {
    return traitsOf(lights[static_cast<std::size_t>(light)].shadow->technique).traced;
  });
}

Result<ExactShadows> exactShadows(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                                  std::span<const int> layered, const Surfaces& surfaces,
                                  std::span<const std::uint16_t> volumeShares) {
  auto layers = makeVisibilityLayers(inputs.width, inputs.height, static_cast<int>(surfaces.samplePositions.size()),
                                     static_cast<int>(layered.size() + (volumeShares.empty() ? 0 : 1)));
  if (!layers) return layers.problems();
  ExactShadows shadows{std::move(*layers), {}, gl::Timer::start()};
  std::unique_ptr<ShownPicture> picture;
  std::optional<StencilCounts> counts;
  for (const int light : layered) {
    const auto start = std::chrono::steady_clock::now();
    LayerFacts facts{light};
    const Light& source = (*shading.spec.lights)[static_cast<std::size_t>(light)];
    if (traitsOf(source.shadow->technique).traced) {
      if (!picture) {
        auto read = readPicture(inputs, shading, work, layered, surfaces);
        if (!read) return read.problems();
        picture = std::move(*read);
      }
      const TracedShadow found = shadowOf(work, *picture->points, light);
      writeVisibility(shadows.layers, static_cast<int>(shadows.lights.size()), found.values);
      facts.tracedPixels = found.tracedPixels;
    } else if (const Status drawn = stencilShadow(inputs, shading, surfaces, source, counts, shadows); !drawn) {
      return drawn.problems();
    }
    facts.cpuMilliseconds = millisecondsSince(start);
    shadows.lights.push_back(facts);
  }
  if (!volumeShares.empty()) writeVisibility(shadows.layers, static_cast<int>(layered.size()), volumeShares);
  shadows.timer.stop();
  return shadows;
}

} // namespace gnomon

#include "renderer/techniques/exact_shadows.h"

#include <chrono>
#include <optional>

#include "renderer/passes/views/volume_pass.h"
#include "renderer/techniques/hybrid_shadow.h"
#include "renderer/techniques/ray_traced_shadow.h"

namespace gnomon {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Draws the next light's layer by shadow volumes; `counts` is made for the first of them.
Status volumeShadow(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces, const Light& light,
                    std::optional<VolumeCounts>& counts, ExactShadows& shadows) {
  if (!counts) {
    auto made = volumeCounts(inputs, surfaces.ownDepth.id() != 0 ? surfaces.ownDepth : shading.survey.depth);
    if (!made) return made.problems();
    counts = std::move(*made);
    shadows.countBytes = counts->depthStencil.bytes();
  }
  const auto volumes =
      drawVolumes(inputs, *counts, light, shadows.layers.texture, static_cast<int>(shadows.lights.size()));
  if (!volumes) return volumes.problems();
  shadows.triangles += volumes->triangles;
  shadows.drawCalls += volumes->drawCalls;
  return Done{};
}

} // namespace

Result<ExactShadows> exactShadows(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                                  const Surfaces& surfaces) {
  const SampleGrid grid{inputs.width, inputs.height, surfaces.samplePositions};
  auto layers = makeVisibilityLayers(inputs.width, inputs.height, static_cast<int>(grid.samples()),
                                     static_cast<int>(exact.lights.size()));
  if (!layers) return layers.problems();
  ExactShadows shadows{std::move(*layers), {}, gl::Timer::start()};

  const std::vector<Light>& lights = *shading.spec.lights;
  std::optional<std::vector<SurfacePoint>> centres;
  std::optional<VolumeCounts> counts;
  for (const int light : exact.lights) {
    const auto start = std::chrono::steady_clock::now();
    const int layer = static_cast<int>(shadows.lights.size());
    ExactShadow shadow{light, 0, {}};
    const Light& source = lights[static_cast<std::size_t>(light)];
    if (source.shadow->technique == ShadowTechnique::shadowVolume) {
      const Status drawn = volumeShadow(inputs, shading, surfaces, source, counts, shadows);
      if (!drawn) return drawn.problems();
    } else {
      const auto traced = exact.traced();
      if (!traced) return traced.problems();
      const TraceInput rays{**traced, inputs.camera, inputs.width, inputs.height, lights, inputs.nodes};
      if (source.shadow->technique == ShadowTechnique::rayTraced) {
        if (!centres) centres = firstHits(rays, centresOf(grid));
        writeVisibility(shadows.layers, layer, rayTracedShadow(rays, light, grid, *centres));
        shadow.tracedPixels = grid.pixels();
      } else {
        const auto hybrid = hybridShadow(inputs, shading, surfaces, rays, light, grid);
        if (!hybrid) return hybrid.problems();
        writeVisibility(shadows.layers, layer, hybrid->values);
        shadow.tracedPixels = hybrid->tracedPixels;
      }
    }
    shadow.milliseconds = millisecondsSince(start);
    shadows.lights.push_back(shadow);
  }
  shadows.timer.stop();
  return shadows;
}

} // namespace gnomon

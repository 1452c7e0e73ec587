#include "renderer/passes/views/exact_shadows.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>

#include "protocol/base/elapsed.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/passes/views/map_queries.h"
#include "renderer/passes/views/shown_triangles.h"
#include "renderer/passes/views/volume_pass.h"
#include "renderer/techniques/baked_shadow.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon {

namespace {

/// Draws the next light's layer by shadow volumes; `counts` is made for the first of them.
Status volumeShadow(const PassInputs& inputs, const Shading& shading, const Surfaces& surfaces, const Light& light,
                    std::optional<VolumeCounts>& counts, ExactShadows& shadows) {
  if (!counts) {
    auto made = volumeCounts(inputs, depthOf(surfaces, shading.survey));
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

/// The shadow map, if there is one, decides where it is sure, rays do elsewhere: everywhere towards a light that has a
/// size, of which the map knows the middle alone.
Result<TracedShadow> hybridShadow(const PassInputs& inputs, const Shading& shading, const Surfaces& surfaces,
                                  const PicturePoints& points, int light) {
  const Light& source = points.rays().lights[static_cast<std::size_t>(light)];
  if (hasSize(source)) return tracedShadow(points, points.rays(), light, source.shadow->raySamples);
  const auto verdicts = mapVerdicts(inputs, shading, surfaces, light);
  if (!verdicts) return verdicts.problems();
  return tracedShadow(points, points.rays(), light, 1, *verdicts);
}

} // namespace

bool needsRays(std::span<const int> layered, std::span<const Light> lights) {
  return std::any_of(layered.begin(), layered.end(), [&](int light) {
    return traitsOf(lights[static_cast<std::size_t>(light)].shadow->technique).traced;
  });
}

Result<ExactShadows> exactShadows(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                                  const Surfaces& surfaces) {
  const SampleGrid grid{inputs.width, inputs.height, surfaces.samplePositions};
  auto layers = makeVisibilityLayers(inputs.width, inputs.height, static_cast<int>(grid.samples()),
                                     static_cast<int>(work.layered.size()));
  if (!layers) return layers.problems();
  ExactShadows shadows{std::move(*layers), {}, gl::Timer::start()};

  const std::vector<Light>& lights = *shading.spec.lights;
  std::shared_ptr<const TracedScene> traced;
  std::vector<std::uint32_t> numbers;
  ShownNumbers shown;
  std::vector<std::uint8_t> masks;
  std::optional<PicturePoints> points; // after what it refers to
  std::optional<VolumeCounts> counts;
  for (const int light : work.layered) {
    const auto start = std::chrono::steady_clock::now();
    const int layer = static_cast<int>(shadows.lights.size());
    LayerFacts shadow{light};
    const Light& source = lights[static_cast<std::size_t>(light)];
    const TechniqueTraits& traits = traitsOf(source.shadow->technique);
    if (!traits.traced) {
      const Status drawn = volumeShadow(inputs, shading, surfaces, source, counts, shadows);
      if (!drawn) return drawn.problems();
    } else {
      if (!points) {
        const auto made = work.traced();
        if (!made) return made.problems();
        traced = *made;
        auto read = shownTriangles(inputs, surfaces);
        if (!read) return read.problems();
        numbers = std::move(*read);
        shown = inOrder(grid, numbers);
        auto covered = maskCoverage(inputs, shading.survey);
        if (!covered) return covered.problems();
        masks = std::move(*covered);
        points.emplace(TraceInput{*traced, inputs.camera, inputs.width, inputs.height, lights, inputs.nodes}, grid,
                       surfaces.numbers, shown, masks);
      }
      if (traits.baked) {
        writeVisibility(shadows.layers, layer, bakedShadow(*points, *work.baked(light)));
        shadow.cpuMilliseconds = millisecondsSince(start);
        shadows.lights.push_back(shadow);
        continue;
      }
      auto found = traits.mapSparesRays()
                       ? hybridShadow(inputs, shading, surfaces, *points, light)
                       : Result(tracedShadow(*points, points->rays(), light, source.shadow->raySamples));
      if (!found) return found.problems();
      writeVisibility(shadows.layers, layer, found->values);
      shadow.tracedPixels = found->tracedPixels;
    }
    shadow.cpuMilliseconds = millisecondsSince(start);
    shadows.lights.push_back(shadow);
  }
  shadows.timer.stop();
  return shadows;
}

} // namespace gnomon

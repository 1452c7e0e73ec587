#include "renderer/draw_views.h"

#include "renderer/passes/tiles/atlas_depth_pass.h"

namespace gnomon {
namespace {

/// The surveyed depth alone, for a view that shows nothing else.
Surfaces depthOnly() {
  Surfaces surfaces;
  surfaces.samplePositions = {glm::vec2(0.5f)};
  return surfaces;
}

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                             const ShadowPlan& plan, const PlannedLight* shown) {
  DrawnViews drawn;
  const Surfaces noSurfaces = depthOnly();
  const VisibilityLayers noLayers;
  for (const View view : shading.spec.views) {
    if (view == View::atlas || view == View::tile) {
      if (drawn.flatAtlas.id() == 0) {
        auto flat = flattenAtlas(inputs, shading.atlas.textures->depth);
        if (!flat) return flat.problems();
        drawn.flatAtlas = std::move(*flat);
      }
      drawn.views.emplace_back();
      continue;
    }
    const int samples = isPicture(view) ? shading.survey.samples : 1;
    const bool surveyed = view == View::depth && shading.survey.samples == 1;
    if (!surveyed && !drawn.surfaces.contains(samples)) {
      auto surfaces = drawSurfaces(inputs, shading.survey, samples);
      if (!surfaces) return surfaces.problems();
      drawn.surfaces.emplace(samples, std::move(*surfaces));
    }
    if (view == View::casterIds) {
      auto casters = drawCasterNodes(inputs, plan, shown, *shading.spec.lights);
      if (!casters) return casters.problems();
      drawn.casters = std::move(*casters);
    }
    if (showsShadow(view) && !exact.lights.empty() && !drawn.exactShadows.contains(samples)) {
      auto shadows = exactShadows(inputs, shading, exact, drawn.surfaces.at(samples));
      if (!shadows) return shadows.problems();
      drawn.exactShadows.emplace(samples, std::move(*shadows));
    }
    const auto layers = drawn.exactShadows.find(samples);
    auto made = drawView(inputs, shading,
                         {surveyed ? noSurfaces : drawn.surfaces.at(samples),
                          layers == drawn.exactShadows.end() ? noLayers : layers->second.layers, drawn.casters},
                         view);
    if (!made) return made.problems();
    drawn.views.push_back(std::move(*made));
  }
  return drawn;
}

} // namespace gnomon

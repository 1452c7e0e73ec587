#include "renderer/frame/draw_views.h"

#include <algorithm>

#include "renderer/frame/error_views.h"
#include "renderer/passes/tiles/atlas_depth_pass.h"

namespace gnomon {
namespace {

/// The surveyed depth alone, for a view that shows nothing else.
Surfaces depthOnly() {
  Surfaces surfaces;
  surfaces.samplePositions = {glm::vec2(0.5f)};
  return surfaces;
}

/// What all views of a frame are drawn from; what they share is drawn once.
struct Studio {
  const PassInputs& inputs;
  const ViewInputs& shading;
  const ExactInputs& exact;
  DrawnViews& drawn;
};

Status needSurfaces(const Studio& studio, int samples) {
  if (studio.drawn.surfaces.contains(samples)) return Done{};
  auto surfaces =
      drawSurfaces(studio.inputs, studio.shading.survey, samples, needsRays(studio.exact, *studio.shading.spec.lights));
  if (!surfaces) return surfaces.problems();
  studio.drawn.surfaces.emplace(samples, std::move(*surfaces));
  return Done{};
}

Status needExactShadows(const Studio& studio, int samples) {
  if (studio.exact.lights.empty() || studio.drawn.exactShadows.contains(samples)) return Done{};
  auto shadows = exactShadows(studio.inputs, studio.shading, studio.exact, studio.drawn.surfaces.at(samples));
  if (!shadows) return shadows.problems();
  studio.drawn.exactShadows.emplace(samples, std::move(*shadows));
  return Done{};
}

/// `shading`: the studio's, or another of the same lights.
Result<DrawnView> drawShaded(const Studio& studio, const ViewInputs& shading, int samples, View view) {
  if (const Status there = needSurfaces(studio, samples); !there) return there.problems();
  if (showsShadow(view)) {
    if (const Status there = needExactShadows(studio, samples); !there) return there.problems();
  }
  const auto exact = studio.drawn.exactShadows.find(samples);
  const VisibilityLayers noLayers;
  return drawView(studio.inputs, shading,
                  {studio.drawn.surfaces.at(samples),
                   exact == studio.drawn.exactShadows.end() ? noLayers : exact->second.layers, studio.drawn.casters},
                  view);
}

/// The share of the light that the technique lets through, whatever the shadow's strength, as numbers.
Result<DrawnView> drawFullShadow(const Studio& studio) {
  const ViewInputs& shading = studio.shading;
  FrameSpec spec = shading.spec;
  spec.output.format = ImageFormat::exr;
  std::vector<shared::LightData> lights(shading.lights.begin(), shading.lights.end());
  for (shared::LightData& light : lights) light.cone.z = 1;
  const ViewInputs full{shading.survey, shading.atlas,     lights, shading.tiles, shading.lightLists,
                        spec,           shading.debugLight};
  return drawShaded(studio, full, 1, View::shadow);
}

Status drawBesides(const Studio& studio) {
  const FrameSpec& spec = studio.shading.spec;
  const std::vector<View>& views = spec.views;
  if (!spec.debug.predictEdges && std::none_of(views.begin(), views.end(), isErrorView)) return Done{};
  auto shadow = drawFullShadow(studio);
  if (!shadow) return shadow.problems();
  studio.drawn.besides.emplace(View::shadow, std::move(*shadow));

  const bool shown = std::find(views.begin(), views.end(), View::color) != views.end();
  const bool wanted = spec.output.format == ImageFormat::png && std::any_of(views.begin(), views.end(), hasBackdrop);
  if (shown || !wanted) return Done{};
  auto color = drawShaded(studio, studio.shading, 1, View::color);
  if (!color) return color.problems();
  studio.drawn.besides.emplace(View::color, std::move(*color));
  return Done{};
}

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                             const ShadowPlan& plan, const PlannedLight* shown) {
  DrawnViews drawn;
  const Studio studio{inputs, shading, exact, drawn};
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
    if (isErrorView(view)) {
      drawn.views.emplace_back();
      continue;
    }
    const int samples = isPicture(view) ? shading.survey.samples : 1;
    if (view == View::casterIds) {
      auto casters = drawCasterNodes(inputs, plan, shown, *shading.spec.lights);
      if (!casters) return casters.problems();
      drawn.casters = std::move(*casters);
    }
    const bool surveyed = view == View::depth && shading.survey.samples == 1;
    auto made = surveyed ? drawView(inputs, shading, {depthOnly(), VisibilityLayers{}, drawn.casters}, view)
                         : drawShaded(studio, shading, samples, view);
    if (!made) return made.problems();
    drawn.views.push_back(std::move(*made));
  }
  if (const Status made = drawBesides(studio); !made) return made.problems();
  return drawn;
}

} // namespace gnomon

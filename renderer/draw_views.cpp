#include "renderer/draw_views.h"

#include <algorithm>

#include "renderer/error_views.h"
#include "renderer/passes/tiles/atlas_depth_pass.h"

namespace gnomon {
namespace {

const VisibilityLayers kNoLayers;

/// The surveyed depth alone, for a view that shows nothing else.
Surfaces depthOnly() {
  Surfaces surfaces;
  surfaces.samplePositions = {glm::vec2(0.5f)};
  return surfaces;
}

/// Draws the surfaces of that many samples a pixel where they are not there yet.
Status needSurfaces(const PassInputs& inputs, const Survey& survey, int samples, DrawnViews& drawn) {
  if (drawn.surfaces.contains(samples)) return Done{};
  auto surfaces = drawSurfaces(inputs, survey, samples);
  if (!surfaces) return surfaces.problems();
  drawn.surfaces.emplace(samples, std::move(*surfaces));
  return Done{};
}

/// Finds the shadows of exact techniques at those surfaces where they are not there yet.
Status needExactShadows(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact, int samples,
                        DrawnViews& drawn) {
  if (exact.lights.empty() || drawn.exactShadows.contains(samples)) return Done{};
  auto shadows = exactShadows(inputs, shading, exact, drawn.surfaces.at(samples));
  if (!shadows) return shadows.problems();
  drawn.exactShadows.emplace(samples, std::move(*shadows));
  return Done{};
}

/// What is there to make a view of so many samples a pixel from.
ViewSources sourcesOf(const DrawnViews& drawn, int samples) {
  const auto layers = drawn.exactShadows.find(samples);
  return {drawn.surfaces.at(samples), layers == drawn.exactShadows.end() ? kNoLayers : layers->second.layers,
          drawn.casters};
}

/// The share of the light that the technique lets through, whatever the shadow's strength, as numbers.
Result<DrawnView> drawFullShadow(const PassInputs& inputs, const ViewInputs& shading, const ViewSources& sources) {
  FrameSpec spec = shading.spec;
  spec.output.format = ImageFormat::exr;
  std::vector<shared::LightData> lights(shading.lights.begin(), shading.lights.end());
  for (shared::LightData& light : lights) light.cone.z = 1;
  ViewInputs full{shading.survey, shading.atlas, lights, shading.tiles, shading.lightLists, spec, shading.debugLight};
  return drawView(inputs, full, sources, View::shadow);
}

Status drawBesides(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact, DrawnViews& drawn) {
  const std::vector<View>& views = shading.spec.views;
  if (std::none_of(views.begin(), views.end(), isErrorView)) return Done{};
  if (const Status there = needSurfaces(inputs, shading.survey, 1, drawn); !there) return there;
  if (const Status there = needExactShadows(inputs, shading, exact, 1, drawn); !there) return there;
  const ViewSources sources = sourcesOf(drawn, 1);
  auto shadow = drawFullShadow(inputs, shading, sources);
  if (!shadow) return shadow.problems();
  drawn.besides.emplace(View::shadow, std::move(*shadow));

  const bool shown = std::find(views.begin(), views.end(), View::color) != views.end();
  const bool wanted =
      shading.spec.output.format == ImageFormat::png && std::any_of(views.begin(), views.end(), hasBackdrop);
  if (shown || !wanted) return Done{};
  auto color = drawView(inputs, shading, sources, View::color);
  if (!color) return color.problems();
  drawn.besides.emplace(View::color, std::move(*color));
  return Done{};
}

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading, const ExactInputs& exact,
                             const ShadowPlan& plan, const PlannedLight* shown) {
  DrawnViews drawn;
  const Surfaces noSurfaces = depthOnly();
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
    const bool surveyed = view == View::depth && shading.survey.samples == 1;
    if (!surveyed) {
      if (const Status there = needSurfaces(inputs, shading.survey, samples, drawn); !there) return there.problems();
    }
    if (view == View::casterIds) {
      auto casters = drawCasterNodes(inputs, plan, shown, *shading.spec.lights);
      if (!casters) return casters.problems();
      drawn.casters = std::move(*casters);
    }
    if (showsShadow(view)) {
      const Status there = needExactShadows(inputs, shading, exact, samples, drawn);
      if (!there) return there.problems();
    }
    auto made = drawView(inputs, shading,
                         surveyed ? ViewSources{noSurfaces, kNoLayers, drawn.casters} : sourcesOf(drawn, samples), view);
    if (!made) return made.problems();
    drawn.views.push_back(std::move(*made));
  }
  if (const Status made = drawBesides(inputs, shading, exact, drawn); !made) return made.problems();
  return drawn;
}

} // namespace gnomon

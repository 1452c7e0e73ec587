#include "renderer/draw_views.h"

#include <algorithm>

#include "renderer/error_views.h"
#include "renderer/passes/tiles/atlas_depth_pass.h"

namespace gnomon {
namespace {

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

/// The share of the light that the technique lets through, whatever the shadow's strength, as numbers.
Result<DrawnView> drawFullShadow(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces) {
  FrameSpec spec = shading.spec;
  spec.output.format = ImageFormat::exr;
  std::vector<shared::LightData> lights(shading.lights.begin(), shading.lights.end());
  for (shared::LightData& light : lights) light.cone.z = 1;
  ViewInputs full{shading.survey, shading.atlas, lights, shading.tiles, shading.lightLists, spec, shading.debugLight};
  return drawView(inputs, full, surfaces, {}, View::shadow);
}

Status drawBesides(const PassInputs& inputs, const ViewInputs& shading, DrawnViews& drawn) {
  const std::vector<View>& views = shading.spec.views;
  if (std::none_of(views.begin(), views.end(), isErrorView)) return Done{};
  if (const Status there = needSurfaces(inputs, shading.survey, 1, drawn); !there) return there;
  const Surfaces& surfaces = drawn.surfaces.at(1);
  auto shadow = drawFullShadow(inputs, shading, surfaces);
  if (!shadow) return shadow.problems();
  drawn.besides.emplace(View::shadow, std::move(*shadow));

  const bool shown = std::find(views.begin(), views.end(), View::color) != views.end();
  const bool wanted =
      shading.spec.output.format == ImageFormat::png && std::any_of(views.begin(), views.end(), hasBackdrop);
  if (shown || !wanted) return Done{};
  auto color = drawView(inputs, shading, surfaces, {}, View::color);
  if (!color) return color.problems();
  drawn.besides.emplace(View::color, std::move(*color));
  return Done{};
}

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading, const ShadowPlan& plan,
                             const PlannedLight* shown) {
  DrawnViews drawn;
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
    auto made = surveyed ? drawView(inputs, shading, depthOnly(), {}, view)
                         : drawView(inputs, shading, drawn.surfaces.at(samples), drawn.casters, view);
    if (!made) return made.problems();
    drawn.views.push_back(std::move(*made));
  }
  if (const Status made = drawBesides(inputs, shading, drawn); !made) return made.problems();
  return drawn;
}

} // namespace gnomon

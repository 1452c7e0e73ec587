#include "renderer/draw_views.h"

namespace gnomon {
namespace {

/// The surveyed depth alone, for a view that shows nothing else.
Surfaces depthOnly() {
  Surfaces surfaces;
  surfaces.samplePositions = {glm::vec2(0.5f)};
  return surfaces;
}

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const ViewInputs& shading) {
  DrawnViews drawn;
  for (const View view : shading.spec.views) {
    if (view == View::atlas) {
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
    auto made = surveyed ? drawView(inputs, shading, depthOnly(), view)
                         : drawView(inputs, shading, drawn.surfaces.at(samples), view);
    if (!made) return made.problems();
    drawn.views.push_back(std::move(*made));
  }
  return drawn;
}

} // namespace gnomon

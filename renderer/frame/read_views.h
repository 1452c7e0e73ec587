#pragma once

#include <vector>

#include "renderer/frame/draw_views.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/measured_shadow.h"

namespace gnomon {

/// What a frame's pictures are read from.
struct PictureSources {
  const FrameSpec& spec; ///< effective
  const DrawnViews& drawn;
  const ShadowAtlas& atlas;
  const ShadowPlan& plan;
  const ShadowTile* tile;         ///< of the plan; null where no view shows one
  const MeasuredShadow* measured; ///< null where no view holds a shadow against rays
};

/// The pictures of the spec's views, in their order.
std::vector<ViewImage> readViews(const PictureSources& sources);

/// The debug light's shadow at full strength, a value a pixel, first row on top; drawn where a view needs it.
std::vector<float> readFullShadow(const DrawnViews& drawn);

} // namespace gnomon

#pragma once

#include <vector>

#include "protocol/spec/format_traits.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/reference/trace.h"

/// View casterIds of a light whose shadow no map decides: rays from what each pixel's centre shows find its caster.
namespace gnomon {

/// Nodes, one a pixel; -1 where none casts a shadow: see casterInstances. `rays`: of the frame that `shown` is of.
std::vector<int> casterNodes(const ShownGeometry& shown, const TraceInput& rays, int light);

/// The nodes as numbers; or each as its color, and what none shadows as grey, the lighter the more it faces the eye.
Image casterView(const ShownGeometry& shown, const std::vector<int>& nodes, PixelType pixels);

} // namespace gnomon

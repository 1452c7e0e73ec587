#pragma once

#include "renderer/image/image.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A grey picture of the atlas of 8 or 16 bits, first row on top, as RGB with each of the plan's tiles outlined in its
/// tint (as the view `cascades` has it) and named "light.tile". Pure.
Image namedTiles(const Image& grey, const ShadowPlan& plan);

} // namespace gnomon

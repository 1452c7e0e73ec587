#pragma once

#include "renderer/passes/draw_list.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// The draws of everything that may throw a shadow onto what a tile serves. Pure.
DrawList castersInto(const ShadowTile& tile, const Scene& scene, const SceneView& view, const FrameGeometry& geometry);

} // namespace gnomon

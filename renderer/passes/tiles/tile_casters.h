#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/spec/light.h"
#include "renderer/passes/draw_list.h"
#include "renderer/scene/node_switches.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// What is drawn into a tile.
struct TileCasters {
  DrawUse use = DrawUse::cast;
  std::vector<std::uint8_t> slots; ///< one a slot of the geometry; 0 = left out
};

/// Everything that may throw a shadow of `light` onto what its tile serves. `nodes`: one a node of the file; empty =
/// every node has the defaults. Pure.
TileCasters castersInto(const ShadowTile& tile, const Light& light, const SceneView& view,
                        const FrameGeometry& geometry, std::span<const NodeSwitches> nodes);

/// The light that each tile of the plan is of. `lights`: those that were planned for; they outlive the result.
std::vector<const Light*> lightsOfTiles(const ShadowPlan& plan, std::span<const Light> lights);

} // namespace gnomon

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/prepare/draw_list.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/scene/node_switches.h"
#include "renderer/shadow/shadow_plan.h"

/// The clusters that a survey draws, in which order, and those that cast into a tile: slots are marked by a byte each.
namespace gnomon {

struct SurveyInput {
  const Scene& scene;
  const SceneView& view;
  const FrameGeometry& geometry;
  const CameraView& camera;
  std::span<const NodeSwitches> nodes; ///< one a node of the file; empty = every node has the defaults
};

/// The slots that may lie in the camera's view, of nodes that it may see.
std::vector<std::uint8_t> slotsInView(const SurveyInput& input);

/// Of the slots in view those to be drawn first, because they may hide others: the nearest, with a share of all
/// triangles in view; every one where there are few triangles.
std::vector<std::uint8_t> firstToDraw(const SurveyInput& input, const std::vector<std::uint8_t>& inView);

/// The marked slots whose instances belong to one of these receiver groups, a bit each.
std::vector<std::uint8_t> slotsOfGroups(const FrameGeometry& geometry, std::uint32_t groups,
                                        std::vector<std::uint8_t> marked);

/// The marked slots that `done` does not mark.
std::vector<std::uint8_t> without(std::span<const std::uint8_t> marked, std::span<const std::uint8_t> done);

/// What is drawn into a tile.
struct TileCasters {
  DrawUse use = DrawUse::cast;
  std::vector<std::uint8_t> slots; ///< one a slot of the geometry; 0 = left out
};

/// Everything that may cast a shadow of `light` onto what its tile serves. `nodes`: one a node of the file; empty =
/// every node has the defaults. Pure.
TileCasters castersInto(const ShadowTile& tile, const Light& light, const SceneView& view,
                        const FrameGeometry& geometry, std::span<const NodeSwitches> nodes);

/// Everything that a tile's texels depend on, in one text: equal keys mean equal texels at the same place.
using TileKey = std::string;

/// The key of a tile as it is to be drawn, `samples` depths a texel. `scene`: a number that no other scene has; `view`:
/// index into its scenes.
TileKey tileKey(std::uint64_t scene, int view, const ShadowTile& tile, const Light& light, const TileCasters& casters,
                int samples);

/// The light that each tile of the plan is of. `lights`: those that were planned for; they outlive the result.
std::vector<const Light*> lightsOfTiles(const ShadowPlan& plan, std::span<const Light> lights);

} // namespace gnomon

#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/passes/stencil/stencil_outlines.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Which triangles of a connected piece cast its shadow.
enum class StencilCaps {
  turnedAway, ///< of a solid, those that face away from the light: no lit surface touches the volume
  turnedTo,   ///< of a solid, those that face the light: its inside is in shadow too, if the light is outside
  all         ///< of anything else
};

struct StencilCaster {
  std::uint32_t instance = 0;    ///< index into SceneView::instances
  std::vector<StencilCaps> caps; ///< of a solid that is not flattened, one a piece (EdgeMesh::pieces); else one for all
};

/// What casts a shadow of `light` into the view. The inside of a solid counts where the camera may see it: where the
/// solid is not drawn, or the camera's near plane reaches into it. Each piece of a solid is one for itself: the camera
/// may be in a street, and the light in one of its houses, all of them one primitive. Where light and camera may
/// both be inside of a piece, all of its triangles cast. `edges`: one a primitive. `nodes`: one a node of the file;
/// empty = every node has the defaults. Pure.
std::vector<StencilCaster> stencilCasters(const Scene& scene, const SceneView& view, const FrameGeometry& geometry,
                                          const CameraView& camera, const Light& light, std::span<const EdgeMesh> edges,
                                          std::span<const NodeSwitches> nodes);

} // namespace gnomon

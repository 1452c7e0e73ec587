#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/passes/stencil/stencil_casters.h"
#include "renderer/passes/stencil/stencil_outlines.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon {

/// Triangles as ranges of an index list.
struct IndexedDraws {
  std::vector<std::uint32_t> indices;
  std::vector<DrawRange> ranges;
};

/// What closes volumes towards the light: the casters' own triangles, in their own order, over the scene's positions.
/// Those whose corners go round against the clock seen from the light, and the others.
struct StencilEnds {
  IndexedDraws sides[2];
  IndexedDraws beyond[2]; ///< those of them that reach behind the camera's far plane
};

/// The shadow volumes of one light: closed, front faces outside. They reach to infinity.
struct StencilMesh {
  /// w < 0: in the primitive's own space; else homogeneous and relative to the eye.
  std::vector<glm::vec4> places;
  IndexedDraws walls;   ///< from the silhouettes away from the light, and what closes them there; over `places`
  StencilEnds caps;     ///< lit surfaces may lie in their planes
  StencilEnds awayCaps; ///< of solids, turned away from the light: what touches them is in the dark
};

/// Everitt and Kilgard, "Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering", 2002; for
/// what is not closed, Kim, Kim and Turk, "A Shadow-Volume Algorithm for Opaque and Transparent Nonmanifold Casters",
/// 2008: a volume for each triangle, less the walls that two of them share. `light`: as placeOf gives it. `edges`:
/// one a primitive. Pure.
StencilMesh stencilMesh(const Scene& scene, const SceneView& view, const CameraView& camera, const glm::dvec4& light,
                        std::span<const StencilCaster> casters, std::span<const EdgeMesh> edges);

} // namespace gnomon

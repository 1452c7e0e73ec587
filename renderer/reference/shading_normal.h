#pragma once

#include "renderer/reference/trace.h"
#include "renderer/reference/traced_scene.h"

namespace gnomon {

/// The normal by which a picture shades a point, unit length: its triangle's vertices' own, mixed, on the eye's side
/// where the material is double-sided; without a normal map. The triangle's where vertices have none. REQUIRES: a
/// surface.
glm::dvec3 shadingNormal(const TracedScene::Tree& tree, const SurfacePoint& point);

} // namespace gnomon

#pragma once

#include <optional>

#include "renderer/rays/light_source.h"
#include "renderer/rays/traced_scene.h"

/// The curved surface that shading shows in place of a triangle whose vertices have normals of their own
/// (renderer/shaders/shared/smooth_surface.h).
namespace gnomon {

/// The place of that surface whence rays to the light start instead of from `point`, which lies on its triangle: where
/// the triangle's plane leaves a part of the light behind it, the surface bends outwards, and faces more of the light.
/// `way`: from the point to the light.
std::optional<SurfacePoint> smoothPoint(const TracedScene::Tree& tree, const LightSource& light,
                                        const SurfacePoint& point, const WayToLight& way);

/// False only where smoothPoint finds nothing for any point of a triangle. `normal`: of the triangle, on the side that
/// is seen; zero = not known.
bool mayFace(const TracedScene::Tree& tree, const LightSource& light, const PlacedTriangle& triangle,
             const glm::dvec3& normal);

/// The normal by which a picture shades a point, unit length: its triangle's vertices' own, mixed, on the eye's side
/// where the material is double-sided; without a normal map. The triangle's where vertices have none. REQUIRES: a
/// surface.
glm::dvec3 shadingNormal(const TracedScene::Tree& tree, const SurfacePoint& point);

} // namespace gnomon

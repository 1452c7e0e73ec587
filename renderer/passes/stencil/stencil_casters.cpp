#include "renderer/passes/stencil/stencil_casters.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "renderer/core/camera_view.h"
#include "renderer/core/linear_algebra.h"

namespace gnomon {
namespace {

Aabb boundsOf(const FrameGeometry& geometry, std::size_t instance) {
  Aabb bounds;
  for (std::uint32_t slot = geometry.firstSlot[instance]; slot < geometry.firstSlot[instance + 1]; ++slot) {
    bounds.add(geometry.slotBounds[slot]);
  }
  return bounds;
}

/// The greatest value of dot(normal, p) over a box, and how far rounding may have lowered it.
struct Greatest {
  double value = 0;
  double slack = 0;
};

Greatest greatestOver(const Aabb& box, const glm::dvec3& normal) {
  constexpr double kRounding = 1e-14;
  const glm::dvec3 products = normal * glm::mix(box.min, box.max, glm::greaterThanEqual(normal, glm::dvec3(0.0)));
  return {products.x + products.y + products.z,
          kRounding * (std::abs(products.x) + std::abs(products.y) + std::abs(products.z))};
}

/// False only where the box and all that lies behind it, seen from the light (relative to the eye), is outside of one
/// plane of the view.
bool shadowMayIntersect(const Frustum& frustum, const Aabb& box, const glm::dvec4& light) {
  return std::none_of(frustum.planes.begin(), frustum.planes.end(), [&](const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    const Greatest nearest = greatestOver(box, normal);
    if (nearest.value + plane.w >= -nearest.slack - 1e-14 * std::abs(plane.w)) return false;
    const double ofLight = glm::dot(normal, glm::dvec3(light));
    const double away = light.w == 0 ? -ofLight : nearest.value - ofLight;
    return away < -nearest.slack - 1e-14 * glm::length(normal) * glm::length(glm::dvec3(light));
  });
}

/// Around the near plane's part of the picture, and the eye of a perspective view.
Aabb nearBox(const CameraView& camera) {
  Aabb box;
  if (camera.perspective) box.add(glm::dvec3(0.0));
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) box.add(pointAt(camera, {x, y}, drawnNear(camera)));
  }
  return box;
}

bool overlap(const Aabb& a, const Aabb& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

/// The box with what floats may add to it, whose places are relative to the eye.
Aabb widened(const Aabb& box) {
  constexpr double kFloats = 1e-6;
  const double margin = kFloats * glm::length(glm::max(glm::abs(box.min), glm::abs(box.max)));
  return {box.min - margin, box.max + margin};
}

/// One a piece of a solid. `nearest`: where the camera may look into it; absent = everywhere. `light`: relative to the
/// eye.
std::vector<StencilCaps> capsOfPieces(const EdgeMesh& mesh, const glm::dmat4& relativeFromLocal,
                                      const std::optional<Aabb>& nearest, const glm::dvec4& light) {
  std::vector<StencilCaps> caps(mesh.pieces.size(), StencilCaps::turnedAway);
  for (std::size_t i = 0; i < caps.size(); ++i) {
    const Aabb box = widened(transformed(relativeFromLocal, mesh.pieces[i]));
    if (nearest && !overlap(box, *nearest)) continue;
    const bool lightMayBeInside = light.w > 0 && squaredDistance(box, glm::dvec3(light)) == 0;
    caps[i] = lightMayBeInside ? StencilCaps::all : StencilCaps::turnedTo;
  }
  return caps;
}

} // namespace

std::vector<StencilCaster> stencilCasters(const Scene& scene, const SceneView& view, const FrameGeometry& geometry,
                                          const CameraView& camera, const Light& light, std::span<const EdgeMesh> edges,
                                          std::span<const NodeSwitches> nodes) {
  const glm::dvec4 place = placeOf(light);
  const glm::dvec4 relativeLight = place - place.w * glm::dvec4(camera.eye, 0.0);
  const Frustum frustum = frustumOf(camera);
  const Aabb nearest = nearBox(camera);

  std::vector<StencilCaster> casters;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    const NodeSwitches node = switchesOf(nodes, instance.node);
    const Aabb box = boundsOf(geometry, i);
    if (!castsFrom(light, node) || box.empty() || !shadowMayIntersect(frustum, box, relativeLight)) continue;
    if (place.w > 0 && light.range && squaredDistance(box, glm::dvec3(relativeLight)) > *light.range * *light.range) {
      continue;
    }
    StencilCaster caster{static_cast<std::uint32_t>(i), {StencilCaps::all}};
    const auto primitive = static_cast<std::size_t>(instance.primitive);
    if (scene.primitives[primitive].solid && !isFlat(instance.worldFromLocal)) {
      caster.caps = capsOfPieces(edges[primitive], geometry.instances[i].relativeFromLocal,
                                 node.visible ? std::optional(nearest) : std::nullopt, relativeLight);
    }
    casters.push_back(std::move(caster));
  }
  return casters;
}

} // namespace gnomon

#include "renderer/frame/frame_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "protocol/base/text.h"
#include "protocol/spec/traits.h"
#include "renderer/core/stop.h"
#include "renderer/frame/faces_away.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::infinity();

/// Pixels that a texel may span before a frame warns; filters hide some of a shadow map's.
constexpr double kCoarseMapTexel = 16;
constexpr double kCoarseLightMapTexel = 8;

Aabb fromEye(const Aabb& world, const glm::dvec3& eye) {
  return {world.min - eye, world.max - eye};
}

glm::dmat4 relativeFromLocal(const Instance& instance, const glm::dvec3& eye) {
  glm::dmat4 matrix = instance.worldFromLocal;
  matrix[3] -= glm::dvec4(eye, 0.0);
  return matrix;
}

/// The nearest depth of the part of a triangle that is inside of all planes; infinity where none is.
double nearestDepthWithin(const Frustum& region, const std::array<glm::dvec3, 3>& corners, const glm::dvec3& forward) {
  std::vector<glm::dvec3> polygon(corners.begin(), corners.end());
  for (const glm::dvec4& plane : region.planes) polygon = clipped(polygon, plane);
  double nearest = kUnseen;
  for (const glm::dvec3& p : polygon) nearest = std::min(nearest, glm::dot(p, forward));
  return nearest;
}

/// What lies between the eye and the near plane; before an orthographic one, all that is ahead of the eye.
std::optional<Frustum> cutRegion(const CameraView& camera) {
  const double near = camera.near + camera.ahead;
  if (!(near > 0)) return std::nullopt;
  Frustum region = frustumOf(camera);
  region.planes[4] = glm::dvec4(camera.forward, camera.ahead);
  region.planes[5] = glm::dvec4(-camera.forward, camera.near - 1e-9 * near);
  return region;
}

/// The visible instances of a scene, without a ground, and those of them whose boxes reach into the picture.
struct InstancesInView {
  std::size_t visible = 0;
  std::vector<std::uint32_t> instances; ///< indices into SceneView::instances
};

InstancesInView instancesInView(const Scene& scene, const SceneView& view, const ResolvedFrame& frame) {
  const Frustum frustum = frustumOf(frame.view);
  InstancesInView in;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    if (isGround(scene, instance) || !switchesOf(frame.nodes, instance.node).visible) continue;
    ++in.visible;
    if (mayIntersect(frustum, fromEye(instance.bounds, frame.view.eye))) {
      in.instances.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return in;
}

/// All that is visible lies outside of the frustum.
std::optional<std::string> warningOfNothingInView(const ResolvedFrame& frame, const InstancesInView& inView) {
  if (inView.visible == 0 || !inView.instances.empty()) return std::nullopt;
  const std::string size = inView.visible == 1 ? "the only surface of the scene lies"
                                               : "all " + std::to_string(inView.visible) + " surfaces of the scene lie";
  const std::string how = std::isinf(frame.view.far) ? "" : ", or beyond its far plane,";
  return "The picture shows nothing: " + size + how +
         " outside of the camera's view. Turn or move the camera, or leave "
         "out its place to have the scene framed.";
}

/// A part of a surface lies within the picture's sides and in front of the eye, but nearer than the near plane.
std::optional<std::string> warningOfNearPlane(const Scene& scene, const SceneView& view, const ResolvedFrame& frame) {
  const CameraView& camera = frame.view;
  const auto region = cutRegion(camera);
  if (!region) return std::nullopt;
  double nearest = kUnseen;
  for (const Instance& instance : view.instances) {
    if (!switchesOf(frame.nodes, instance.node).visible || !mayIntersect(*region, fromEye(instance.bounds, camera.eye)))
      continue;
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    const bool bothSides = scene.materials[static_cast<std::size_t>(materialOf(scene, instance))].doubleSided;
    const FacesOf faces(camera, instance);
    const glm::dmat4 placed = relativeFromLocal(instance, camera.eye);
    for (std::uint32_t k = 0; k < primitive.clusterCount; ++k) {
      if (!mayIntersect(*region, transformed(placed, scene.clusters[primitive.firstCluster + k].bounds))) continue;
      const std::uint32_t last = std::min((k + 1) * kClusterTriangles, primitive.indexCount / 3);
      stopIfAsked();
      for (std::uint32_t triangle = k * kClusterTriangles; triangle < last; ++triangle) {
        const auto corners = cornersOf(scene, instance, triangle, camera.eye);
        if (!bothSides && !faces.front(corners)) continue;
        nearest = std::min(nearest, nearestDepthWithin(*region, corners, camera.forward));
      }
    }
  }
  if (!(nearest < camera.near)) return std::nullopt;
  const std::string field = camera.perspective ? "near" : "camera.orthographic.near";
  return "The near plane at " + shortNumber(camera.near) + " m cuts away surfaces that are in view from " +
         shortNumber(nearest) + " m on. Lower " + field +
         (camera.perspective ? " of the camera's lens, or leave it out." : ", or move the eye back.");
}

std::string lightName(int light) {
  return "Light " + std::to_string(light);
}

/// The light casts shadows, but its map got no texels.
std::optional<std::string> warningOfNoTexel(const PlannedLight& planned) {
  switch (planned.noTexels) {
    case NoTexels::none:
      return std::nullopt;
    case NoTexels::atlasFull:
      return lightName(planned.light) + " casts no shadow: the atlas has no room for its tiles of " +
             std::to_string(planned.askedTileSize) +
             " texels. Raise atlas.size, lower shadow.size or "
             "shadow.importance of other lights, or take shadow.technique rayTraced, which needs no atlas.";
    case NoTexels::outOfRange:
      return lightName(planned.light) +
             " casts no shadow: nothing in view lies within its shadow.depthRange. "
             "Widen shadow.depthRange.min to max, or set its mode to automatic.";
  }
  return std::nullopt;
}

/// One block of the picture in twenty, or more, reads texels of a map that span more than kCoarseMapTexel pixels; a map
/// beside a visibility layer decides nothing that shows.
std::optional<std::string> warningOfCoarseTexels(const WarnedFrame& warned, const PlannedLight& planned,
                                                 const std::optional<PredictedError>& error) {
  const bool isLayered = std::ranges::find(warned.layered, planned.light) != warned.layered.end();
  if (!error || !(error->p95 > kCoarseMapTexel) || isLayered) return std::nullopt;
  const Light& light = (*warned.frame.spec.lights)[static_cast<std::size_t>(planned.light)];
  const std::string size = planned.grantedTileSize < planned.askedTileSize ? "atlas.size" : "shadow.size";
  return lightName(planned.light) + "'s shadow is coarse: a texel of its map spans up to " + shortNumber(error->p95) +
         " pixels (over " + shortNumber(kCoarseMapTexel) + " is warned of). " +
         (traitsOf(light.type).parallel ? "Raise shadow.cascadeCount or " : "Move the light nearer, raise ") + size +
         ", or take shadow.technique rayTraced.";
}

/// Texels of the light map, seen straight on, span more than kCoarseLightMapTexel pixels.
std::optional<std::string> warningOfCoarseLightMap(const CameraView& view, const ReceiverDepths& seen, int light,
                                                   const LightMapLayout& layout) {
  if (seen.width <= 0 || !(layout.texelsPerMetre > 0)) return std::nullopt;
  std::vector<float> extents;
  for (const DepthSpan& span : seen.blocks) {
    if (span.empty()) continue;
    const double metres = 2 * view.halfSize.y / seen.height * (view.perspective ? double{span.nearest} : 1.0);
    extents.push_back(static_cast<float>(1.0 / (layout.texelsPerMetre * metres)));
  }
  const auto error = errorOf(std::move(extents));
  if (!error || !(error->p95 > kCoarseLightMapTexel)) return std::nullopt;
  return lightName(light) + "'s light map is coarse: its texels of " + shortNumber(1.0 / layout.texelsPerMetre) +
         " m span up to " + shortNumber(error->p95) + " pixels (over " + shortNumber(kCoarseLightMapTexel) +
         " is warned of). Raise shadow.lightMap.texelsPerMetre or shadow.lightMap.size.";
}

} // namespace

std::vector<std::string> frameWarnings(const WarnedFrame& warned, WarnedBy by,
                                       std::span<const LightMapCache::Found> baked) {
  std::vector<std::string> warnings;
  const auto add = [&](std::optional<std::string> warning) {
    if (warning) warnings.push_back(*std::move(warning));
  };
  const auto inView = instancesInView(warned.scene, warned.view, warned.frame);
  add(warningOfNothingInView(warned.frame, inView));
  add(warningOfNearPlane(warned.scene, warned.view, warned.frame));
  if (by == WarnedBy::drawing) {
    add(warningOfFacesAway(warned.scene, warned.view, warned.frame.view, warned.seen, inView.instances));
  }
  for (std::size_t i = 0; i < warned.plan.lights.size(); ++i) {
    add(warningOfNoTexel(warned.plan.lights[i]));
    add(warningOfCoarseTexels(warned, warned.plan.lights[i], warned.errors.lights[i]));
  }
  for (std::size_t light = 0; light < baked.size(); ++light) {
    if (baked[light].baked) {
      add(warningOfCoarseLightMap(warned.frame.view, warned.seen, static_cast<int>(light),
                                  *baked[light].baked->layout));
    }
  }
  return warnings;
}

} // namespace gnomon

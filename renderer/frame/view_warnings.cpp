#include "renderer/frame/view_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "protocol/base/text.h"
#include "renderer/core/stop.h"
#include "renderer/frame/faces_away.h"
#include "renderer/frame/geometry_views.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isVisible(const ResolvedFrame& frame, const Instance& instance) {
  return switchesOf(frame.nodes, instance.node).visible;
}

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
  for (const glm::dvec4& plane : region.planes) {
    const auto inside = [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; };
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3& from = polygon[i];
      const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
      const double a = inside(from);
      const double b = inside(to);
      if (a >= 0) kept.push_back(from);
      if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(glm::mix(from, to, a / (a - b)));
    }
    polygon = std::move(kept);
  }
  double nearest = kInfinity;
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

} // namespace

InstancesInView instancesInView(const SceneView& view, const ResolvedFrame& frame) {
  const Frustum frustum = frustumOf(frame.view);
  InstancesInView in;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    if (!isVisible(frame, instance)) continue;
    ++in.visible;
    if (mayIntersect(frustum, fromEye(instance.bounds, frame.view.eye))) {
      in.instances.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return in;
}

std::optional<std::string> warningOfNothingInView(const ResolvedFrame& frame, const InstancesInView& inView) {
  if (inView.visible == 0 || !inView.instances.empty()) return std::nullopt;
  const std::string size = inView.visible == 1 ? "the only surface of the scene lies"
                                               : "all " + std::to_string(inView.visible) + " surfaces of the scene lie";
  const std::string how = std::isinf(frame.view.far) ? "" : ", or beyond its far plane,";
  return "The picture shows nothing: " + size + how +
         " outside of the camera's view. Turn or move the camera, or leave "
         "out its place to have the scene framed.";
}

std::optional<std::string> warningOfNearPlane(const Scene& scene, const SceneView& view, const ResolvedFrame& frame) {
  const CameraView& camera = frame.view;
  const auto region = cutRegion(camera);
  if (!region) return std::nullopt;
  double nearest = kInfinity;
  for (const Instance& instance : view.instances) {
    if (!isVisible(frame, instance) || !mayIntersect(*region, fromEye(instance.bounds, camera.eye))) continue;
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

} // namespace gnomon

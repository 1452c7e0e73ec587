#include "renderer/resolve/resolve_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

/// The smallest sphere around the box, which holds the scene. A scene without surfaces is a metre wide.
struct BoundingSphere {
  glm::dvec3 center{0};
  double radius = 1;
};

BoundingSphere sphereAround(const Aabb& bounds) {
  if (bounds.empty()) return {};
  const double radius = glm::length(bounds.halfExtent());
  return {bounds.center(), radius > 0 ? radius : 1.0};
}

/// Orthonormal axes; `up` is bent to stand on the view direction.
void orient(CameraView& view, const EyeTarget& place) {
  view.eye = toVector(place.eye);
  view.forward = glm::normalize(toVector(place.target) - view.eye);
  view.right = glm::normalize(glm::cross(view.forward, glm::normalize(toVector(place.up))));
  view.up = glm::cross(view.right, view.forward);
}

/// The least distance from `target` at which a camera that looks along `forward` sees all corners of the scene's box.
double framingDistance(const Aabb& bounds, const EyeTarget& directions, const Camera& camera, double aspect) {
  const double margin = 1.05;
  const BoundingSphere sphere = sphereAround(bounds);
  if (bounds.empty() || camera.orthographic) return 2 * sphere.radius * margin;
  CameraView view;
  orient(view, directions);
  const double tanY = std::tan(glm::radians(camera.perspective.value_or(Perspective{}).fovYDegrees) / 2) / margin;
  const double tanX = tanY * aspect;
  double distance = sphere.radius * 1e-3;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const glm::dvec3 p = bounds.center() + sign * bounds.halfExtent() - toVector(directions.target);
    const double towards = -glm::dot(p, view.forward);
    distance = std::max({distance, std::abs(glm::dot(p, view.right)) / tanX + towards,
                         std::abs(glm::dot(p, view.up)) / tanY + towards});
  }
  return distance;
}

EyeTarget placeOrbit(const Orbit& orbit, const Camera& camera, const Aabb& bounds, double aspect) {
  const double azimuth = glm::radians(orbit.azimuthDegrees);
  const double elevation = glm::radians(orbit.elevationDegrees);
  const glm::dvec3 outward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           -std::cos(azimuth) * std::cos(elevation));
  // Straight above and below, the picture's upper edge points where the horizon in front would be.
  const glm::dvec3 up = std::abs(outward.y) > 0.999999
                            ? glm::dvec3(-std::sin(azimuth), 0, std::cos(azimuth)) * (outward.y > 0 ? 1.0 : -1.0)
                            : glm::dvec3(0, 1, 0);
  const glm::dvec3 target = orbit.target ? toVector(*orbit.target) : sphereAround(bounds).center;
  const EyeTarget directions{toTriple(target + outward), toTriple(target), toTriple(up)};
  const double distance = orbit.distance ? *orbit.distance : framingDistance(bounds, directions, camera, aspect);
  return {toTriple(target + outward * distance), toTriple(target), toTriple(up)};
}

Result<const SceneCamera*> findCamera(const std::variant<int, std::string>& node, const SceneView& scene) {
  std::string known;
  for (const SceneCamera& camera : scene.cameras) {
    const bool found = std::holds_alternative<int>(node) ? std::get<int>(node) == camera.node
                                                         : std::get<std::string>(node) == camera.name;
    if (found) return &camera;
    known += (known.empty() ? "" : ", ") + std::to_string(camera.node);
    if (!camera.name.empty()) known += " (" + camera.name + ")";
  }
  const std::string asked =
      std::holds_alternative<int>(node) ? std::to_string(std::get<int>(node)) : std::get<std::string>(node);
  return Problem{ProblemCode::invalidValue, "/camera/node", "No node of this scene by that index or name has a camera.",
                 known.empty() ? "the scene has no cameras" : "one of " + known, asked};
}

} // namespace

Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, double aspect) {
  ResolvedCamera resolved;
  Camera& out = resolved.camera;
  out.perspective = camera.perspective;
  out.orthographic = camera.orthographic;
  const BoundingSphere sphere = sphereAround(scene.bounds);

  if (camera.lookAt) {
    out.lookAt = camera.lookAt;
  } else if (camera.node) {
    const auto found = findCamera(*camera.node, scene);
    if (!found) return found.problems();
    const SceneCamera& node = **found;
    // A target as far as the scene is large keeps the direction's digits.
    out.lookAt = EyeTarget{toTriple(node.eye), toTriple(node.eye + node.forward * sphere.radius), toTriple(node.up)};
    if (!out.perspective && !out.orthographic) {
      out.perspective = node.perspective;
      out.orthographic = node.orthographic;
    }
  } else {
    out.lookAt = placeOrbit(camera.orbit.value_or(Orbit{}), out, scene.bounds, aspect);
  }

  CameraView& view = resolved.view;
  orient(view, *out.lookAt);
  if (out.orthographic) {
    view.perspective = false;
    view.halfSize = {out.orthographic->height / 2 * aspect, out.orthographic->height / 2};
    view.near = out.orthographic->near;
    view.far = out.orthographic->far;
    return resolved;
  }
  if (!out.perspective) out.perspective = Perspective{};
  Perspective& lens = *out.perspective;
  // Reversed float depth keeps its relative precision however small near is, so it only has to be out of the way.
  if (!lens.near) lens.near = std::min(sphere.radius * 1e-4, lens.far.value_or(HUGE_VAL) * 1e-3);
  view.halfSize.y = std::tan(glm::radians(lens.fovYDegrees) / 2);
  view.halfSize.x = view.halfSize.y * aspect;
  view.near = *lens.near;
  if (lens.far) view.far = *lens.far;
  return resolved;
}

} // namespace gnomon

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

/// The numbers of a calibration are rounded: `forward` stays as it is, and `up` is bent to stand on it.
void orient(CameraView& view, const CameraPose& pose) {
  const auto column = [&](std::size_t i) {
    const Rows4& rows = pose.worldFromCamera;
    return glm::dvec3(rows[0][i], rows[1][i], rows[2][i]);
  };
  const double turned = pose.axes == CameraAxes::opencv ? -1.0 : 1.0; // there, y leads down and z ahead
  view.eye = column(3);
  view.forward = glm::normalize(column(2) * -turned);
  view.right = glm::normalize(glm::cross(view.forward, column(1) * turned));
  view.up = glm::cross(view.right, view.forward);
}

/// Settles what a lens shows of a picture of `size` pixels.
void setExtent(const Perspective& lens, const glm::dvec2& size, CameraView& view) {
  view.halfSize.y = std::tan(glm::radians(lens.fovYDegrees) / 2);
  view.halfSize.x = view.halfSize.y * (size.x / size.y);
}

void setExtent(Intrinsics& lens, const glm::dvec2& size, CameraView& view) {
  const glm::dvec2 middle = 0.5 * (size - 1.0); // the first pixel's centre is at 0
  if (!lens.cx) lens.cx = middle.x;
  if (!lens.cy) lens.cy = middle.y;
  const glm::dvec2 focal(lens.fx, lens.fy);
  view.halfSize = 0.5 * size / focal;
  view.center = glm::dvec2(middle.x - *lens.cx, *lens.cy - middle.y) / focal; // rows count downwards
}

/// `radius`: of the scene, metres.
template <class Lens>
void setDepths(Lens& lens, double radius, CameraView& view) {
  // Reversed float depth keeps its relative precision however small near is, so it only has to be out of the way.
  if (!lens.near) lens.near = std::min(radius * 1e-4, lens.far.value_or(HUGE_VAL) * 1e-3);
  view.near = *lens.near;
  if (lens.far) view.far = *lens.far;
}

/// What of a view its lens decides. Settles the lens; without one, it is the usual one.
CameraView lensOf(Camera& camera, double radius, const glm::dvec2& size) {
  CameraView view;
  if (camera.orthographic) {
    view.perspective = false;
    view.halfSize = {camera.orthographic->height / 2 * (size.x / size.y), camera.orthographic->height / 2};
    view.near = camera.orthographic->near;
    view.far = camera.orthographic->far;
    return view;
  }
  if (camera.intrinsics) {
    setExtent(*camera.intrinsics, size, view);
    setDepths(*camera.intrinsics, radius, view);
    return view;
  }
  if (!camera.perspective) camera.perspective = Perspective{};
  setExtent(*camera.perspective, size, view);
  setDepths(*camera.perspective, radius, view);
  return view;
}

/// The least distance from `target` at which a camera that looks along `forward` sees all corners of the scene's box;
/// infinite where the axis does not lie in the picture, so that no distance does. `lens`: what the lens is of a view.
double framingDistance(const Aabb& bounds, const EyeTarget& directions, const CameraView& lens) {
  const double margin = 1.05;
  const BoundingSphere sphere = sphereAround(bounds);
  if (bounds.empty() || !lens.perspective) return 2 * sphere.radius * margin;
  CameraView view = lens;
  orient(view, directions);
  const glm::dvec2 low = (view.halfSize - view.center) / margin; // tangents from the axis to the picture's sides
  const glm::dvec2 high = (view.halfSize + view.center) / margin;
  if (!glm::all(glm::greaterThan(glm::min(low, high), glm::dvec2(0.0)))) return HUGE_VAL;
  double distance = sphere.radius * 1e-3;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const glm::dvec3 p = bounds.center() + sign * bounds.halfExtent() - toVector(directions.target);
    const double towards = -glm::dot(p, view.forward);
    const glm::dvec2 across(glm::dot(p, view.right), glm::dot(p, view.up));
    const glm::dvec2 needed = glm::max(across / high, -across / low) + towards;
    distance = std::max({distance, needed.x, needed.y});
  }
  return distance;
}

/// `lens`: what the lens is of a view.
Result<EyeTarget> placeOrbit(const Orbit& orbit, const CameraView& lens, const Aabb& bounds) {
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
  const double distance = orbit.distance ? *orbit.distance : framingDistance(bounds, directions, lens);
  if (!(distance < HUGE_VAL)) {
    return Problem{ProblemCode::invalidValue, "/camera/orbit/distance",
                   "With this lens no distance shows the whole scene, so that it has to be given.",
                   "a principal point within the picture", "absent"};
  }
  return EyeTarget{toTriple(target + outward * distance), toTriple(target), toTriple(up)};
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

Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, const glm::ivec2& size) {
  ResolvedCamera resolved;
  Camera& out = resolved.camera;
  out.pose = camera.pose;
  out.lookAt = camera.lookAt;
  out.perspective = camera.perspective;
  out.intrinsics = camera.intrinsics;
  out.orthographic = camera.orthographic;
  const double radius = sphereAround(scene.bounds).radius;

  if (camera.node) {
    const auto found = findCamera(*camera.node, scene);
    if (!found) return found.problems();
    const SceneCamera& node = **found;
    // A target as far as the scene is large keeps the direction's digits.
    out.lookAt = EyeTarget{toTriple(node.eye), toTriple(node.eye + node.forward * radius), toTriple(node.up)};
    if (!out.perspective && !out.intrinsics && !out.orthographic) {
      out.perspective = node.perspective;
      out.orthographic = node.orthographic;
    }
  }
  resolved.view = lensOf(out, radius, glm::dvec2(size));
  if (!out.pose && !out.lookAt) {
    const auto place = placeOrbit(camera.orbit.value_or(Orbit{}), resolved.view, scene.bounds);
    if (!place) return place.problems();
    out.lookAt = *place;
  }
  if (out.pose) {
    orient(resolved.view, *out.pose);
  } else {
    orient(resolved.view, *out.lookAt);
  }
  return resolved;
}

} // namespace gnomon

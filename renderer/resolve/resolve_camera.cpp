#include "renderer/resolve/resolve_camera.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string_view>

#include "renderer/core/linear_algebra.h"

namespace gnomon {
namespace {

/// Orthonormal axes; `up` is made perpendicular to the view direction.
void orient(CameraView& view, const EyeTarget& place) {
  view.eye = toVector(place.eye);
  view.forward = glm::normalize(toVector(place.target) - view.eye);
  view.right = glm::normalize(glm::cross(view.forward, glm::normalize(toVector(place.up))));
  view.up = glm::cross(view.right, view.forward);
}

/// The numbers of a calibration are rounded: `forward` stays as it is, and `up` is made perpendicular to it.
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

/// Reversed float depth keeps its relative precision however small near is, so it only has to be out of the way: of
/// whatever is a millimetre before the eye.
constexpr double kNearestDrawn = 5e-4;

/// `radius`: of the scene, metres.
template <class Lens>
void setDepths(Lens& lens, double radius, CameraView& view) {
  if (!lens.near) lens.near = std::min({radius * 1e-4, kNearestDrawn, lens.far.value_or(HUGE_VAL) * 1e-3});
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

/// Of an orbit: where its camera looks from, and what is above in its picture.
struct OrbitAxes {
  glm::dvec3 outward{0, 0, 1}, up{0, 1, 0};
};

OrbitAxes axesOf(const Orbit& orbit) {
  const double azimuth = glm::radians(orbit.azimuthDegrees);
  const double elevation = glm::radians(orbit.elevationDegrees);
  const glm::dvec3 outward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           -std::cos(azimuth) * std::cos(elevation));
  // Straight above and below, the picture's upper edge points where the horizon in front would be.
  const glm::dvec3 up = std::abs(outward.y) > 0.999999
                            ? glm::dvec3(-std::sin(azimuth), 0, std::cos(azimuth)) * (outward.y > 0 ? 1.0 : -1.0)
                            : glm::dvec3(0, 1, 0);
  return {outward, up};
}

/// `lens`: what the lens is of a view.
Result<EyeTarget> placeOrbit(const Orbit& orbit, const CameraView& lens, const glm::dvec3& center,
                             const FramedSubject& seen) {
  const auto [outward, up] = axesOf(orbit);
  const Problem noneShowsAll{ProblemCode::invalidValue, "/camera/orbit/distance",
                             "With this lens no distance shows the whole scene, so that it has to be given.",
                             "a principal point within the picture", "absent"};
  CameraView view = lens;
  const glm::dvec3 target = orbit.target ? toVector(*orbit.target) : center;
  orient(view, EyeTarget{toTriple(target + outward), toTriple(target), toTriple(up)});
  if (!orbit.target && !orbit.distance) {
    const auto eye = framingEye(view, seen);
    if (!eye) return noneShowsAll;
    const double depth = std::max(glm::dot(seen.center - *eye, view.forward), seen.radius * 1e-3);
    return EyeTarget{toTriple(*eye), toTriple(*eye + view.forward * depth), toTriple(up)};
  }
  const auto distance = orbit.distance ? orbit.distance : framingDistance(view, target, seen);
  if (!distance) return noneShowsAll;
  return EyeTarget{toTriple(target + outward * *distance), toTriple(target), toTriple(up)};
}

/// The whole number that a text is; nothing where it is none.
std::optional<std::size_t> numberIn(std::string_view text) {
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// By its name, or else by its index among the scene's cameras, or by its node's index behind "node:".
const SceneCamera* findCamera(const std::string& asked, const SceneView& scene) {
  constexpr std::string_view kNode = "node:";
  const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                  [&](const SceneCamera& camera) { return camera.name == asked; });
  if (named != scene.cameras.end()) return &*named;
  if (const auto index = numberIn(asked)) return *index < scene.cameras.size() ? &scene.cameras[*index] : nullptr;
  const auto held = std::find_if(scene.cameras.begin(), scene.cameras.end(), [&](const SceneCamera& camera) {
    return asked == std::string(kNode) + std::to_string(camera.node);
  });
  return held == scene.cameras.end() ? nullptr : &*held;
}

/// Every camera that may be asked for: "0 = overview (node:4)".
std::string camerasOf(const SceneView& scene) {
  std::string known;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    known += (known.empty() ? "one of " : ", ") + std::to_string(i);
    if (!camera.name.empty()) known += " = " + camera.name;
    known += " (node:" + std::to_string(camera.node) + ")";
  }
  return known.empty() ? "the scene has no cameras" : known;
}

Result<const SceneCamera*> findCamera(const std::variant<int, std::string>& node, const SceneView& scene) {
  const auto* index = std::get_if<int>(&node);
  const std::string asked = index ? std::to_string(*index) : std::get<std::string>(node);
  if (const SceneCamera* found = findCamera(asked, scene)) return found;
  return Problem{ProblemCode::invalidValue, "/camera/node", "The scene has no camera of this name or index.",
                 camerasOf(scene), asked};
}

} // namespace

Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, const glm::ivec2& size) {
  return resolveCamera(camera, scene, size, subjectOf(scene.bounds));
}

Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, const glm::ivec2& size,
                                     const FramedSubject& seen) {
  ResolvedCamera resolved;
  Camera& out = resolved.camera;
  out.pose = camera.pose;
  out.lookAt = camera.lookAt;
  out.perspective = camera.perspective;
  out.intrinsics = camera.intrinsics;
  out.orthographic = camera.orthographic;
  const FramedSubject whole = subjectOf(scene.bounds);
  const double radius = whole.radius;

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
    const auto place = placeOrbit(camera.orbit.value_or(Orbit{}), resolved.view, whole.center, seen);
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

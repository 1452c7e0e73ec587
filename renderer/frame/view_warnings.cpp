#include "renderer/frame/view_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/core/stop.h"
#include "renderer/frame/warned_number.h"
#include "renderer/shadow/depth_range.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isVisible(const ResolvedFrame& frame, const Instance& instance) {
  return frame.nodes.empty() || frame.nodes[static_cast<std::size_t>(instance.node)].visible;
}

Aabb fromEye(const Aabb& world, const glm::dvec3& eye) {
  return {world.min - eye, world.max - eye};
}

glm::dmat4 relativeFromLocal(const Instance& instance, const glm::dvec3& eye) {
  glm::dmat4 matrix = instance.worldFromLocal;
  matrix[3] -= glm::dvec4(eye, 0.0);
  return matrix;
}

using Corners = std::array<glm::dvec3, 3>;

/// Shows `visit` the triangles first .. last - 1 of an instance, eye-relative, until it returns false.
template <class Visit>
void eachTriangle(const Scene& scene, const Instance& instance, const glm::dvec3& eye, std::uint32_t first,
                  std::uint32_t last, const Visit& visit) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const glm::dmat4 placed = relativeFromLocal(instance, eye);
  for (std::uint32_t triangle = first; triangle < last; ++triangle) {
    if (triangle % kClusterTriangles == 0) stopIfAsked();
    Corners corners;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t index = scene.indices[primitive.firstIndex + 3 * triangle + i];
      const glm::vec3& local = scene.positions[primitive.baseVertex + index];
      corners[i] = glm::dvec3(placed * glm::dvec4(glm::dvec3(local), 1.0));
    }
    if (!visit(corners)) return;
  }
}

/// Towards the viewer from a point, of any length.
glm::dvec3 towardsViewer(const CameraView& camera, const glm::dvec3& point) {
  return camera.perspective ? -point : -camera.forward;
}

/// Over 0 where the front is seen, below 0 where the back is.
double facing(const CameraView& camera, const Corners& corners, bool mirrored) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  return glm::dot(normal, towardsViewer(camera, corners[0])) * (mirrored ? -1.0 : 1.0);
}

bool isMirrored(const Instance& instance) {
  return glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0;
}

const Material& materialOf(const Scene& scene, const SceneView& view, std::uint32_t instance) {
  return scene.materials[static_cast<std::size_t>(gnomon::materialOf(scene, view.instances[instance]))];
}

std::string nodeName(const Scene& scene, const Instance& instance) {
  const std::string& name = scene.nodes[static_cast<std::size_t>(instance.node)].name;
  return "node " + std::to_string(instance.node) + (name.empty() ? "" : " \"" + name + "\"");
}

/// The nearest depth of the part of a triangle that is inside of all planes; infinity where none is.
double nearestDepthWithin(const Frustum& region, const Corners& corners, const glm::dvec3& forward) {
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
  for (std::uint32_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    if (!isVisible(frame, instance) || !mayIntersect(*region, fromEye(instance.bounds, camera.eye))) continue;
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    const bool bothSides = materialOf(scene, view, i).doubleSided;
    const bool mirrored = isMirrored(instance);
    const glm::dmat4 placed = relativeFromLocal(instance, camera.eye);
    for (std::uint32_t k = 0; k < primitive.clusterCount; ++k) {
      if (!mayIntersect(*region, transformed(placed, scene.clusters[primitive.firstCluster + k].bounds))) continue;
      const std::uint32_t last = std::min((k + 1) * kClusterTriangles, primitive.indexCount / 3);
      eachTriangle(scene, instance, camera.eye, k * kClusterTriangles, last, [&](const Corners& corners) {
        if (bothSides || facing(camera, corners, mirrored) > 0) {
          nearest = std::min(nearest, nearestDepthWithin(*region, corners, camera.forward));
        }
        return true;
      });
    }
  }
  if (!(nearest < camera.near)) return std::nullopt;
  const std::string field = camera.perspective ? "near" : "camera.orthographic.near";
  return "The near plane at " + warnedNumber(camera.near + camera.ahead) +
         " m cuts away surfaces that are in view from " + warnedNumber(nearest + camera.ahead) + " m on. Lower " +
         field + (camera.perspective ? " of the camera's lens, or leave it out." : ", or move the eye back.");
}

namespace {

/// Whether a triangle that shows its back would be seen, were it drawn.
class Uncovered {
 public:
  Uncovered(const CameraView& camera, const ReceiverDepths& seen) : camera_(camera), seen_(seen) {}

  /// At its middle, and at the middles of the blocks of the survey that it spans.
  bool operator()(const Corners& corners) const {
    if (at((corners[0] + corners[1] + corners[2]) / 3.0)) return true;
    glm::dvec2 low(-1.0);
    glm::dvec2 high(1.0);
    const auto ahead = [&](const glm::dvec3& p) { return glm::dot(p, camera_.forward) > 0; };
    if (!camera_.perspective || std::all_of(corners.begin(), corners.end(), ahead)) {
      low = glm::dvec2(kInfinity);
      high = -low;
      for (const glm::dvec3& corner : corners) {
        low = glm::min(low, ndcOf(camera_, corner));
        high = glm::max(high, ndcOf(camera_, corner));
      }
      low = glm::max(low, glm::dvec2(-1.0));
      high = glm::min(high, glm::dvec2(1.0));
    }
    const auto place = [&](double ndc, int pixels) { return (ndc + 1.0) * 0.5 * pixels / seen_.blockSize; };
    const int lastColumn = std::min(static_cast<int>(place(high.x, seen_.width)), seen_.columns - 1);
    const int lastRow = std::min(static_cast<int>(place(-low.y, seen_.height)), seen_.rows - 1);
    for (int row = static_cast<int>(place(-high.y, seen_.height)); row <= lastRow; ++row) {
      for (int column = static_cast<int>(place(low.x, seen_.width)); column <= lastColumn; ++column) {
        if (const auto point = onTriangle(corners, middleOf(row, column)); point && at(*point)) return true;
      }
    }
    return false;
  }

 private:
  glm::dvec2 middleOf(int row, int column) const {
    const glm::dvec2 pixel = (glm::dvec2(column, row) + 0.5) * static_cast<double>(seen_.blockSize);
    return {2.0 * pixel.x / seen_.width - 1.0, 1.0 - 2.0 * pixel.y / seen_.height};
  }

  /// Where the line of sight through a place of the picture meets the triangle.
  std::optional<glm::dvec3> onTriangle(const Corners& corners, const glm::dvec2& ndc) const {
    const glm::dvec3 start = camera_.perspective ? glm::dvec3(0.0) : pointAt(camera_, ndc, 0.0);
    const glm::dvec3 way = pointAt(camera_, ndc, 1.0) - start;
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double along = glm::dot(normal, corners[0] - start) / glm::dot(normal, way);
    if (!std::isfinite(along) || (camera_.perspective && along <= 0)) return std::nullopt;
    const glm::dvec3 point = start + way * along;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 inwards = glm::cross(normal, corners[(i + 1) % 3] - corners[i]);
      if (glm::dot(inwards, point - corners[i]) < 0) return std::nullopt;
    }
    return point;
  }

  bool at(const glm::dvec3& point) const {
    const double depth = glm::dot(point, camera_.forward);
    if (depth < camera_.near || depth > camera_.far) return false;
    const glm::dvec2 ndc = ndcOf(camera_, point);
    if (!(std::abs(ndc.x) < 1 && std::abs(ndc.y) < 1)) return false;
    const int column = static_cast<int>((ndc.x + 1) * 0.5 * seen_.width) / seen_.blockSize;
    const int row = static_cast<int>((1 - ndc.y) * 0.5 * seen_.height) / seen_.blockSize;
    const DepthSpan& span = seen_.blocks[static_cast<std::size_t>(row * seen_.columns + column)];
    const double nearest = span.nearest;
    return span.empty() || depth < nearest - std::max(1e-4 * std::abs(nearest), 10.0 * depthSlack(camera_, nearest));
  }

  const CameraView& camera_;
  const ReceiverDepths& seen_;
};

/// Every triangle shows its back, and some would be seen. A triangle without an area shows nothing.
bool facesAway(const Scene& scene, const Instance& instance, const CameraView& camera, const Uncovered& uncovered) {
  const bool mirrored = isMirrored(instance);
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const std::uint32_t triangles = primitive.indexCount / 3;
  bool away = true;
  eachTriangle(scene, instance, camera.eye, 0, triangles,
               [&](const Corners& corners) { return away = !(facing(camera, corners, mirrored) > 0); });
  if (!away) return false;
  bool seen = false;
  eachTriangle(scene, instance, camera.eye, 0, triangles, [&](const Corners& corners) {
    seen = facing(camera, corners, mirrored) < 0 && uncovered(corners);
    return !seen;
  });
  return seen;
}

} // namespace

std::optional<std::string> warningOfFacesAway(const Scene& scene, const SceneView& view, const CameraView& camera,
                                              const ReceiverDepths& seen, const std::vector<std::uint32_t>& inView) {
  const Uncovered uncovered(camera, seen);
  std::size_t count = 0;
  std::string first;
  for (const std::uint32_t i : inView) {
    if (materialOf(scene, view, i).doubleSided) continue;
    if (!facesAway(scene, view.instances[i], camera, uncovered)) continue;
    if (count++ == 0) first = nodeName(scene, view.instances[i]);
  }
  if (count == 0) return std::nullopt;
  const std::string surfaces = count == 1 ? "A single-sided surface in view faces"
                                          : std::to_string(count) + " single-sided surfaces in view face";
  return surfaces + " away from the camera everywhere and " + (count == 1 ? "is" : "are") + " not drawn (" +
         (count == 1 ? "" : "first: ") + first + "). Turn the camera, or set doubleSided in the file's material.";
}

} // namespace gnomon

#include "renderer/frame/faces_away.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/stop.h"
#include "renderer/frame/geometry_views.h"

namespace gnomon {
namespace {

using Corners = std::array<glm::dvec3, 3>;

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
      low = glm::dvec2(HUGE_VAL);
      high = -low;
      for (const glm::dvec3& corner : corners) {
        low = glm::min(low, ndcOf(camera_, corner));
        high = glm::max(high, ndcOf(camera_, corner));
      }
      low = glm::max(low, glm::dvec2(-1.0));
      high = glm::min(high, glm::dvec2(1.0));
      if (!(low.x <= high.x && low.y <= high.y)) return false; // beside the picture, however far
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
    if (!std::isfinite(along) || along <= 0) return std::nullopt;
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
    return span.empty() || depth < span.nearest - 1e-4 * std::abs(span.nearest);
  }

  const CameraView& camera_;
  const ReceiverDepths& seen_;
};

/// Every triangle shows its back, and some would be seen. A triangle without an area shows nothing.
bool facesAway(const Scene& scene, const Instance& instance, const CameraView& camera, const Uncovered& uncovered) {
  const std::uint32_t triangles = scene.primitives[static_cast<std::size_t>(instance.primitive)].indexCount / 3;
  const FacesOf faces(camera, instance);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    if (i % kClusterTriangles == 0) stopIfAsked();
    if (faces.front(cornersOf(scene, instance, i, camera.eye))) return false;
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    if (i % kClusterTriangles == 0) stopIfAsked();
    const Corners corners = cornersOf(scene, instance, i, camera.eye);
    if (faces.back(corners) && uncovered(corners)) return true;
  }
  return false;
}

std::string nameOf(const Scene& scene, const Instance& instance) {
  const std::string& name = scene.nodes[static_cast<std::size_t>(instance.node)].name;
  return "node " + std::to_string(instance.node) + (name.empty() ? "" : " \"" + name + "\"");
}

} // namespace

FacesOf::FacesOf(const CameraView& camera, const Instance& instance)
    : camera_(camera), mirrored_(glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0) {}

double FacesOf::side(const std::array<glm::dvec3, 3>& corners) const {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const glm::dvec3 towards = camera_.perspective ? -corners[0] : -camera_.forward;
  return glm::dot(normal, towards) * (mirrored_ ? -1.0 : 1.0);
}

std::optional<std::string> warningOfFacesAway(const Scene& scene, const SceneView& view, const CameraView& camera,
                                              const ReceiverDepths& seen, std::span<const std::uint32_t> inView) {
  const Uncovered uncovered(camera, seen);
  std::size_t count = 0;
  std::string first;
  for (const std::uint32_t i : inView) {
    const Instance& instance = view.instances[i];
    if (scene.materials[static_cast<std::size_t>(materialOf(scene, instance))].doubleSided) continue;
    if (!facesAway(scene, instance, camera, uncovered)) continue;
    if (count++ == 0) first = nameOf(scene, instance);
  }
  if (count == 0) return std::nullopt;
  const std::string surfaces = count == 1 ? "A single-sided surface in view faces"
                                          : std::to_string(count) + " single-sided surfaces in view face";
  return surfaces + " away from the camera everywhere and " + (count == 1 ? "is" : "are") + " not drawn (" +
         (count == 1 ? "" : "first: ") + first + "). Turn the camera, or set doubleSided in the file's material.";
}

} // namespace gnomon

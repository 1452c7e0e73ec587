#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

/// Where cameras are placed by what a scene shows.
namespace gnomon {

/// Of the points of something the one that lies farthest along a direction (of any length but zero), in the world.
using Farthest = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// Of a box, which is not empty.
Farthest farthestOf(const Aabb& box);

/// Of the vertices of triangles that a camera may see: those of a scene's view whose nodes are visible, without a
/// ground. Everything given outlives it; one thread at a time.
class SeenExtent {
 public:
  /// `nodes`: as resolveNodes gives them. `scene` is posed.
  SeenExtent(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes);

  bool empty() const { return bounds_.empty(); }
  const Aabb& bounds() const { return bounds_; } ///< of the boxes of what is seen; empty = nothing is

  /// REQUIRES: not empty.
  glm::dvec3 farthest(const glm::dvec3& direction);

 private:
  const Scene& scene_;
  std::vector<const Instance*> instances_;
  Aabb bounds_;
  std::vector<glm::dvec3> found_; ///< by earlier directions: the next one begins with the best of them
};

/// What is to be seen.
struct FramedSubject {
  Farthest farthest;
  glm::dvec3 center{0}; ///< any point amid it
  double radius = 1;    ///< about its size, metres; > 0
};

/// Of what lies in these bounds; without `farthest` all of their box is to be seen. Where there is nothing, a metre
/// around the origin is.
FramedSubject subjectOf(const Aabb& bounds, Farthest farthest = {});

/// The eye from which the picture shows all of the subject as large as it may be, in the middle: opposite sides keep
/// equal margins, and one of the two pairs kFramingMargin of the picture's shorter side. For a perspective view each
/// side is a plane that the subject's convex hull touches, so that the eye's depth solves a linear program (as Lengyel
/// does in "Fitting a camera to points"); an orthographic one is well before the subject. Nothing where the axis does
/// not lie in the picture. `view`: its axes and its lens count.
std::optional<glm::dvec3> framingEye(const CameraView& view, const FramedSubject& subject);

/// The least distance from a target at which the picture shows all of the subject, of each side's way from the axis
/// twice kFramingMargin left. Nothing where the axis does not lie in the picture.
std::optional<double> framingDistance(const CameraView& view, const glm::dvec3& target, const FramedSubject& subject);

inline constexpr double kFramingMargin = 0.025; ///< of the picture's shorter side, at each side

/// The same orthographic picture from an eye amid the receivers that it may show, so that places relative to the eye
/// are small, and with depths stored between planes no farther apart than what it may show (CameraView::ahead,
/// drawnDepths). The eye moves by whole steps, so that it stays put while the camera moves a little. A perspective view
/// stays as it is. `receiving`: one an instance, 1 where it shows shadows; where none of them is in view, all count.
CameraView movedToScene(const CameraView& view, const SceneView& scene, std::span<const std::uint8_t> receiving);

} // namespace gnomon

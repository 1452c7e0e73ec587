#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "renderer/core/aabb.h"

namespace gnomon {

/// A camera, resolved: its position, orthonormal axes and lens. All in world units and double precision.
/// Everything the renderer computes for a frame is relative to `eye`, so that no large coordinate meets a float.
struct CameraView {
  glm::dvec3 eye{0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 forward{0, 0, -1};
  bool perspective = true;
  /// Half the width and the height of the picture: as tangents, at a depth of one metre (perspective), or in metres.
  glm::dvec2 halfSize{1, 1};
  /// The middle of the picture, to the right of the view axis and above it, as tangents; any size, so that the picture
  /// may lie wholly beside the axis. REQUIRES: 0 for an orthographic view.
  glm::dvec2 center{0, 0};
  double near = 0.1;                                    ///< view depth, metres; > 0 for perspective
  double far = std::numeric_limits<double>::infinity(); ///< view depth; infinite only for perspective
  /// Orthographic: metres by which `eye` lies ahead of the eye that was asked for. All view depths here are from `eye`;
  /// those that a caller gives or gets are so much more.
  double ahead = 0;
  /// Orthographic: the planes between which all lies that is drawn; absent = near and far.
  std::optional<std::array<double, 2>> drawnDepths{};
};

/// The planes between which depths are stored: no coarser than they have to be.
inline double drawnNear(const CameraView& view) {
  return view.drawnDepths ? (*view.drawnDepths)[0] : view.near;
}
inline double drawnFar(const CameraView& view) {
  return view.drawnDepths ? (*view.drawnDepths)[1] : view.far;
}

/// The way through the middle of the picture, world axes: one metre of view depth long.
inline glm::dvec3 wayToMiddle(const CameraView& view) {
  return view.forward + view.right * view.center.x + view.up * view.center.y;
}

/// A point relative to the eye (world axes), given its position on the picture (-1..1, y up) and its view depth.
inline glm::dvec3 pointAt(const CameraView& view, glm::dvec2 ndc, double depth) {
  const double scale = view.perspective ? depth : 1.0;
  return wayToMiddle(view) * depth + view.right * (ndc.x * view.halfSize.x * scale) +
         view.up * (ndc.y * view.halfSize.y * scale);
}

/// Where the picture shows a point relative to the eye (world axes): -1..1, y up. REQUIRES: perspective has it ahead.
inline glm::dvec2 ndcOf(const CameraView& view, const glm::dvec3& point) {
  const double scale = view.perspective ? 1.0 / glm::dot(point, view.forward) : 1.0;
  const glm::dvec2 across(glm::dot(point, view.right), glm::dot(point, view.up));
  return (across * scale - view.center) / view.halfSize;
}

/// View space (right, up, -forward) from eye-relative world space: a rotation.
glm::dmat4 viewFromRelative(const CameraView& view);

/// Clip space from view space, depth reversed: 1 at near, 0 at far or at infinity.
/// (Reversed depth: Reed, "Depth Precision Visualized", 2015.)
glm::dmat4 clipFromView(const CameraView& view);

/// The view depth in metres of a depth of that clip space; infinite for 0 where the far plane is.
double viewDepthOf(const CameraView& view, double depth);

/// The planes of a view, eye-relative; a point p is inside where dot(plane.xyz, p) + plane.w >= 0.
/// An infinite far plane is (0,0,0,1).
struct Frustum {
  std::array<glm::dvec4, 6> planes{};
};

Frustum frustumOf(const CameraView& view);

/// False only where the box is surely outside: a box across a corner may be kept.
bool mayIntersect(const Frustum& frustum, const Aabb& box);

/// The part of a convex polygon that is inside of a plane (Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974).
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, const glm::dvec4& plane);

/// What a column or row of blocks of pixels adds to a point: least and greatest, component by component.
struct BlockStrip {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

/// The strips of `count` columns or rows of blocks, each half a pixel wider on both sides (rasterizers move vertices by
/// a fraction of one). `pixels` is the length of the picture along them; `axis` is what ndc 1 adds, at depth 1
/// (perspective) or at any depth (orthographic).
std::vector<BlockStrip> blockStrips(int count, int blockSize, int pixels, const glm::dvec3& axis);

/// The box around the piece of view behind one block, from depth `from` to depth `to`. `middle` is wayToMiddle in the
/// coordinates of the strips.
Aabb blockPiece(bool perspective, const glm::dvec3& middle, const BlockStrip& column, const BlockStrip& row,
                double from, double to);

} // namespace gnomon

#include "renderer/resolve/framing.h"

#include <algorithm>
#include <utility>

namespace gnomon {
namespace {

/// Half of the picture less its margin: as tangents, or in metres.
glm::dvec2 usable(const CameraView& view) {
  return view.halfSize - 2 * kFramingMargin * std::min(view.halfSize.x, view.halfSize.y);
}

/// The ways across the picture, each along the plane through its middle: what a point has of them is its distance from
/// that plane's rays, whatever its depth.
glm::dvec3 acrossOf(const CameraView& view, int axis) {
  return (axis == 0 ? view.right : view.up) - view.forward * view.center[axis];
}

/// How far a subject reaches, from its center.
class Reach {
 public:
  Reach(const CameraView& view, const FramedSubject& subject) : subject_(subject), forward_(view.forward) {}

  struct Point {
    double across = 0, depth = 0;
  };

  /// The point that is the farthest to one side (1 or -1) of a plane along `across` which leans outwards by `tangent`.
  Point farthest(const glm::dvec3& across, double side, double tangent) const {
    const glm::dvec3 p = subject_.farthest(across * side - forward_ * tangent) - subject_.center;
    return {glm::dot(p, across), glm::dot(p, forward_)};
  }

  double nearest() const { return glm::dot(subject_.farthest(-forward_) - subject_.center, forward_); }

 private:
  const FramedSubject& subject_;
  glm::dvec3 forward_;
};

/// Half the angle's tangent that both sides need to hold the subject from an eye of this depth, and the eye's
/// place across. What the two sides lack together falls with the tangent as a convex line of straight pieces, so that
/// Newton's steps from below end in its zero after few of them.
double centred(const Reach& reach, const glm::dvec3& across, double eyeDepth) {
  constexpr int kMostSteps = 64;
  double tangent = 0;
  for (int step = 0;; ++step) {
    const Reach::Point right = reach.farthest(across, 1, tangent), left = reach.farthest(across, -1, tangent);
    const double rightDepth = right.depth - eyeDepth, leftDepth = left.depth - eyeDepth;
    const double rightEdge = right.across - tangent * rightDepth, leftEdge = left.across + tangent * leftDepth;
    const double next = (right.across - left.across) / (rightDepth + leftDepth);
    const bool isFound = !(next > tangent * (1 + 1e-12)) || step == kMostSteps;
    if (isFound) return 0.5 * (rightEdge + leftEdge);
    tangent = next;
  }
}

bool holdsAxis(const CameraView& view) {
  return glm::all(glm::lessThan(glm::abs(view.center), view.halfSize));
}

constexpr double kOrthographicRadii = 2.1; // from the eye to the center: well before the subject

} // namespace

FramedSubject subjectOf(const Aabb& bounds, Farthest farthest) {
  if (bounds.empty()) return {farthestOf(Aabb{glm::dvec3(-0.5), glm::dvec3(0.5)}), glm::dvec3(0.0), 1};
  const double radius = glm::length(bounds.halfExtent());
  return {farthest ? std::move(farthest) : farthestOf(bounds), bounds.center(), radius > 0 ? radius : 1.0};
}

std::optional<glm::dvec3> framingEye(const CameraView& view, const FramedSubject& subject) {
  const Reach reach(view, subject);
  const glm::dvec2 half = usable(view);
  const glm::dvec3 right = acrossOf(view, 0), up = acrossOf(view, 1);
  if (!view.perspective) {
    const auto middle = [&](const glm::dvec3& across) {
      return 0.5 * (reach.farthest(across, 1, 0).across + reach.farthest(across, -1, 0).across);
    };
    return subject.center + right * middle(right) + up * middle(up) -
           view.forward * (kOrthographicRadii * subject.radius);
  }
  if (!holdsAxis(view)) return std::nullopt;
  double depth = reach.nearest() - subject.radius * 1e-3;
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec3 across = axis == 0 ? right : up;
    const Reach::Point a = reach.farthest(across, 1, half[axis]), b = reach.farthest(across, -1, half[axis]);
    depth = std::min(depth, (half[axis] * (a.depth + b.depth) - (a.across - b.across)) / (2 * half[axis]));
  }
  // Across, the eye's places are measured along the plane through the picture's middle, which passes through the eye.
  const glm::dvec2 place(centred(reach, right, depth) + view.center.x * depth,
                         centred(reach, up, depth) + view.center.y * depth);
  return subject.center + view.right * place.x + view.up * place.y + view.forward * depth;
}

std::optional<double> framingDistance(const CameraView& view, const glm::dvec3& target, const FramedSubject& subject) {
  if (!view.perspective) return kOrthographicRadii * subject.radius;
  if (!holdsAxis(view)) return std::nullopt;
  double distance = subject.radius * 1e-3;
  for (int axis = 0; axis < 2; ++axis) {
    for (const double side : {1.0, -1.0}) {
      // From the axis, on which the target lies, to this side of the picture.
      const double tangent = (view.halfSize[axis] + side * view.center[axis]) * (1 - 2 * kFramingMargin);
      const glm::dvec3 needed = (axis == 0 ? view.right : view.up) * (side / tangent) - view.forward;
      distance = std::max(distance, glm::dot(subject.farthest(needed) - target, needed));
    }
  }
  return distance;
}

} // namespace gnomon

#include "renderer/resolve/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "renderer/prepare/box_depths.h"

namespace gnomon {
namespace {

/// The farthest that any point of a box may lie along a direction.
double reachOf(const Aabb& box, const glm::dvec3& direction) {
  return glm::dot(box.center(), direction) + glm::dot(box.halfExtent(), glm::abs(direction));
}

/// The best point so far.
struct Best {
  double reach = -std::numeric_limits<double>::infinity();
  glm::dvec3 point{0};
};

void look(const Scene& scene, const Instance& instance, const glm::dvec3& direction, Best& best) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const glm::dvec3 local = glm::transpose(glm::dmat3(instance.worldFromLocal)) * direction;
  const double offset = glm::dot(glm::dvec3(instance.worldFromLocal[3]), direction);
  constexpr std::uint32_t kClusterIndices = kClusterTriangles * 3;
  for (std::uint32_t cluster = 0; cluster < primitive.clusterCount; ++cluster) {
    if (reachOf(scene.clusters[primitive.firstCluster + cluster].bounds, local) + offset <= best.reach) continue;
    const std::uint32_t begin = cluster * kClusterIndices;
    const std::uint32_t end = std::min(primitive.indexCount, begin + kClusterIndices);
    for (std::uint32_t i = begin; i < end; ++i) {
      const glm::dvec3 vertex(scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + i]]);
      const double reach = glm::dot(vertex, local) + offset;
      if (!(reach > best.reach)) continue;
      best = {reach, glm::dvec3(instance.worldFromLocal * glm::dvec4(vertex, 1.0))};
    }
  }
}

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

void add(std::optional<DepthInterval>& sum, const DepthInterval& depths) {
  sum = sum ? DepthInterval{std::min(sum->near, depths.near), std::max(sum->far, depths.far)} : depths;
}

/// What the picture may show of the instances, between the planes: of all, and of those that receive shadows.
struct ShownDepths {
  std::optional<DepthInterval> all, receiving;
};

ShownDepths shownDepths(const CameraView& view, const SceneView& scene, std::span<const std::uint8_t> receiving) {
  ShownDepths shown;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Aabb& bounds = scene.instances[i].bounds;
    if (bounds.empty()) continue;
    auto depths = possibleDepths(view, {bounds.min - view.eye, bounds.max - view.eye});
    if (!depths || depths->far < view.near || depths->near > view.far) continue;
    *depths = {std::max(depths->near, view.near), std::min(depths->far, view.far)};
    add(shown.all, *depths);
    if (receiving[i] != 0) add(shown.receiving, *depths);
  }
  return shown;
}

/// The greatest power of two that is not above it. REQUIRES: > 0.
double powerBelow(double length) {
  return std::exp2(std::floor(std::log2(length)));
}

} // namespace

Farthest farthestOf(const Aabb& box) {
  return [box](const glm::dvec3& direction) {
    const glm::dvec3 side(direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1, direction.z < 0 ? -1 : 1);
    return box.center() + side * box.halfExtent();
  };
}

SeenExtent::SeenExtent(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes) : scene_(scene) {
  for (const Instance& instance : view.instances) {
    if (isGround(scene, instance) || !switchesOf(nodes, instance.node).visible) continue;
    instances_.push_back(&instance);
    bounds_.add(instance.bounds);
  }
}

glm::dvec3 SeenExtent::farthest(const glm::dvec3& direction) {
  Best best;
  for (const glm::dvec3& point : found_) {
    const double reach = glm::dot(point, direction);
    if (reach > best.reach) best = {reach, point};
  }
  for (const Instance* instance : instances_) {
    if (reachOf(instance->bounds, direction) > best.reach) look(scene_, *instance, direction, best);
  }
  found_.push_back(best.point);
  return best.point;
}

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

CameraView movedToScene(const CameraView& view, const SceneView& scene, std::span<const std::uint8_t> receiving) {
  if (view.perspective) return view;
  const ShownDepths shown = shownDepths(view, scene, receiving);
  if (!shown.all) return view;
  const DepthInterval amid = shown.receiving.value_or(*shown.all);
  const double picture = glm::length(view.halfSize);
  const double step = powerBelow(std::max(amid.far - amid.near, picture)) / 4;
  CameraView moved = view;
  moved.ahead = std::round(0.5 * (amid.near + amid.far) / step) * step;
  moved.eye = view.eye + view.forward * moved.ahead;
  moved.near = view.near - moved.ahead;
  moved.far = view.far - moved.ahead;

  // Planes by steps, too: where they change, depths round otherwise.
  const double length = std::max(shown.all->far - shown.all->near, picture);
  const double planes = powerBelow(length) / 4;
  const double drawnNear = (std::floor(shown.all->near / planes) - 1) * planes - moved.ahead;
  const double drawnFar = (std::ceil(shown.all->far / planes) + 1) * planes - moved.ahead;
  moved.drawnDepths = {std::max(moved.near, drawnNear), std::min(moved.far, drawnFar)};
  return moved;
}

} // namespace gnomon

#include "renderer/shadow/penumbra_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "renderer/core/camera_view.h"

namespace gnomon {
namespace {

/// The corners of a box's six sides, in order round each: bit i of a corner's number chooses its end of axis i.
constexpr std::array<std::array<unsigned, 4>, 6> kSides{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

/// The least z of the part of a box that lies inside of all planes; none where none does. REQUIRES: that part has its
/// nearest point in the box's surface.
std::optional<double> nearestWithin(const Aabb& box, const glm::dmat4& lightFromBox,
                                    const std::array<glm::dvec4, 4>& planes) {
  if (box.empty()) return std::nullopt;
  std::array<glm::dvec3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    const glm::dvec3 corner(i & 1u ? box.max.x : box.min.x, i & 2u ? box.max.y : box.min.y,
                            i & 4u ? box.max.z : box.min.z);
    corners[i] = glm::dvec3(lightFromBox * glm::dvec4(corner, 1.0));
  }
  std::optional<double> nearest;
  for (const auto& side : kSides) {
    std::vector<glm::dvec3> polygon;
    for (const unsigned corner : side) polygon.push_back(corners[corner]);
    for (const glm::dvec4& plane : planes) polygon = clipped(polygon, plane);
    for (const glm::dvec3& point : polygon) nearest = std::min(nearest.value_or(point.z), point.z);
  }
  return nearest;
}

} // namespace

// A box over a rectangle is convex, and so lowest in a corner; each of its corners lies on a side of the box.
std::optional<double> nearestOver(const Aabb& box, const glm::dmat4& lightFromBox, const glm::dvec2& lowest,
                                  const glm::dvec2& highest) {
  return nearestWithin(box, lightFromBox,
                       {{{-1, 0, 0, highest.x}, {1, 0, 0, -lowest.x}, {0, -1, 0, highest.y}, {0, 1, 0, -lowest.y}}});
}

// The same holds in a pyramid, unless the box holds its apex: then that is the nearest.
std::optional<double> nearestInPyramid(const Aabb& box, const glm::dmat4& lightFromBox, const glm::dvec2& lowest,
                                       const glm::dvec2& highest) {
  const glm::dvec3 apex(glm::inverse(lightFromBox) * glm::dvec4(0, 0, 0, 1));
  if (!box.empty() && glm::clamp(apex, box.min, box.max) == apex) return 0.0;
  return nearestWithin(box, lightFromBox,
                       {{{-1, 0, highest.x, 0}, {1, 0, -lowest.x, 0}, {0, -1, highest.y, 0}, {0, 1, -lowest.y, 0}}});
}

PenumbraReach penumbraReach(const Aabb& receiversLs, const Aabb& scene, const glm::dmat4& lightFromScene,
                            double lightRadius) {
  constexpr int kTurns = 6;
  constexpr double kRoom = 1e-6; // of lengths: far above the rounding of doubles
  const double far = receiversLs.max.z;
  const auto reachTo = [&](double nearest) {
    return PenumbraReach{nearest, lightRadius * std::max(far - nearest, 0.0)};
  };
  PenumbraReach reach = reachTo(transformed(lightFromScene, scene).min.z);
  const double slack = kRoom * glm::length(receiversLs.max - receiversLs.min);
  for (int turn = 0; turn < kTurns; ++turn) {
    const glm::dvec2 room(reach.radius * (1.0 + kRoom) + slack);
    const auto nearest =
        nearestOver(scene, lightFromScene, glm::dvec2(receiversLs.min) - room, glm::dvec2(receiversLs.max) + room);
    if (!nearest) return {receiversLs.min.z, 0.0};
    if (!(*nearest > reach.nearest)) break;
    reach = reachTo(*nearest);
  }
  return reach;
}

double penumbraTangent(double nearest, double farthest, double lightRadius) {
  if (!(nearest > 0)) return lightRadius > 0 ? HUGE_VAL : 0.0;
  return lightRadius * std::max(1.0 / nearest - 1.0 / farthest, 0.0);
}

double nearestCasterInPyramid(const Aabb& seen, const Aabb& scene, const glm::dmat4& lightFromScene, double lightRadius,
                              double widest) {
  constexpr int kTurns = 6;
  constexpr double kRoom = 1e-6; // far above the rounding of doubles
  double nearest = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double radius = std::min(penumbraTangent(nearest, seen.max.z, lightRadius), widest);
    const glm::dvec2 room(radius * (1.0 + kRoom) + kRoom);
    const auto found =
        nearestInPyramid(scene, lightFromScene, glm::dvec2(seen.min) - room, glm::dvec2(seen.max) + room);
    if (!found) return seen.min.z;
    if (!(*found > nearest)) break;
    nearest = *found;
  }
  return nearest;
}

} // namespace gnomon

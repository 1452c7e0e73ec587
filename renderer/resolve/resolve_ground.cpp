#include "renderer/resolve/resolve_ground.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "renderer/core/linear_algebra.h"
#include "renderer/resolve/framing.h"
#include "renderer/resolve/ground_shadows.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/resolve/resolve_nodes.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/reach.h"

namespace gnomon {
namespace {

/// What stands on a ground.
struct Standing {
  Aabb bounds;
  double lowest = 0;
};

/// What is hidden altogether stands there as if it were seen; where there is nothing, a metre around the origin does.
Standing standing(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes) {
  SeenExtent seen(scene, view, nodes);
  if (!seen.empty()) return {seen.bounds(), seen.farthest({0, -1, 0}).y};
  if (!view.bounds.empty()) return {view.bounds, view.bounds.min.y};
  return {Aabb{glm::dvec3(-0.5), glm::dvec3(0.5)}, 0};
}

double largestSide(const Aabb& bounds) {
  const glm::dvec3 sides = bounds.max - bounds.min;
  const double side = std::max({sides.x, sides.y, sides.z});
  return side > 0 ? side : 1;
}

/// The sides of a square around a place that holds a box, as seen from above.
double sidesAround(const glm::dvec3& center, const Aabb& box) {
  const glm::dvec3 reach = glm::max(glm::abs(box.min - center), glm::abs(box.max - center));
  return 2 * std::max(reach.x, reach.z);
}

/// Where a catcher ends is not seen as long as no shadow ends there. One that is no larger than shadows need leaves
/// shadow maps as fine as they are without it.
double autoSize(const FrameSpec& spec, const SceneView& view, std::span<const NodeSwitches> nodes, const Aabb& bounds,
                const GroundPlane& plane) {
  const double side = largestSide(bounds);
  const double most = kGroundSides * side;
  if (!plane.catchesShadows) return most;
  auto needed = shadowsOnGround(spec, view, nodes, plane.center.y);
  if (!needed) return most;
  needed->add(bounds);
  constexpr double kMargin = 0.2; // for filters of shadow maps, which widen shadows by texels
  return std::min(sidesAround(plane.center, *needed) + kMargin * side, most);
}

Result<GroundPlane> placed(const Ground& asked, const FrameSpec& spec, const Scene& scene, const SceneView& view,
                           std::span<const NodeSwitches> nodes) {
  const auto [bounds, lowest] = standing(scene, view, nodes);
  GroundPlane plane;
  plane.catchesShadows = asked.mode == GroundMode::catcher;
  plane.color = glm::vec3(toVector(asked.color));
  plane.roughness = static_cast<float>(asked.roughness);
  plane.center = bounds.center();
  plane.center.y = asked.height.value_or(lowest - kGroundGap * largestSide(bounds));
  plane.size = asked.size ? *asked.size : autoSize(spec, view, nodes, bounds, plane);
  const glm::dvec3 half(plane.size / 2, 0, plane.size / 2);
  if (isWithinReach(plane.center - half) && isWithinReach(plane.center + half)) return plane;
  std::ostringstream size;
  size << plane.size << " metres";
  return Problem{ProblemCode::invalidValue, "/ground/size", "The ground reaches too far.", reachLimit(), size.str()};
}

} // namespace

Result<std::shared_ptr<const Scene>> stagedScene(const std::shared_ptr<const Scene>& loaded, const FrameSpec& spec) {
  auto posed = posedScene(loaded, poseOf(spec));
  if (!posed || !spec.ground) return posed;
  const Scene& scene = **posed;
  ProblemList others;
  const int index = resolveScene(spec, scene, others);
  const auto nodes = resolveNodes(spec.nodes, scene);
  if (index < 0 || !nodes) return posed;
  auto plane = placed(*spec.ground, spec, scene, scene.scenes[static_cast<std::size_t>(index)], *nodes);
  if (!plane) return std::move(plane).problems();
  Pose pose = poseOf(spec);
  pose.ground = *plane;
  return posedScene(loaded, pose);
}

} // namespace gnomon

#include "renderer/frame/motion_view.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "renderer/core/collect.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

/// What an instance is known by in every pose of its scene.
using Identity = std::array<int, 3>;

Identity identityOf(const Instance& instance) {
  return {instance.node, instance.primitive, instance.copy};
}

std::vector<std::uint32_t> instancesThen(const SceneView& now, const SceneView& then) {
  std::vector<std::uint32_t> order(then.instances.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto identity = [&](std::uint32_t i) { return identityOf(then.instances[i]); };
  std::ranges::sort(order, {}, identity);
  std::vector<std::uint32_t> found;
  found.reserve(now.instances.size());
  for (const Instance& instance : now.instances) {
    const auto at = std::ranges::lower_bound(order, identityOf(instance), {}, identity);
    const bool there = at != order.end() && identity(*at) == identityOf(instance);
    found.push_back(there ? *at : kNoSurface);
  }
  return found;
}

/// What settles the camera of the earlier frame, and which of the scenes it shows.
/// `now`: the frame's camera with nothing left open.
FrameSpec frameThen(const FrameSpec& asked, const Camera& now) {
  FrameSpec then;
  then.width = asked.width;
  then.height = asked.height;
  // A camera of the file moves with its node; one that is fitted to the scene stays as it is fitted now.
  then.camera = asked.motionFrom->camera.value_or(asked.camera.node ? asked.camera : now);
  then.scene = asked.scene;
  then.materialVariant = asked.materialVariant;
  return then;
}

/// Problems with what motionFrom gives point there; with the rest, into the frame itself.
Problems placedInMotion(Problems problems, const MotionFrom& from) {
  const auto isIn = [](const Problem& problem, std::string_view member) { return problem.pointer.starts_with(member); };
  for (Problem& problem : problems) {
    const bool given = (from.camera && isIn(problem, "/camera")) || (from.animation && isIn(problem, "/animation")) ||
                       (from.nodes && isIn(problem, "/nodes"));
    if (given) problem.pointer.insert(0, "/motionFrom");
  }
  return problems;
}

/// Relative to the eye; nothing where the camera has it not ahead.
std::optional<glm::dvec2> placeBefore(const CameraView& camera, const glm::dvec3& point) {
  if (camera.perspective && !(glm::dot(point, camera.forward) > 0)) return std::nullopt;
  return ndcOf(camera, point);
}

} // namespace

Result<EarlierMoment> earlierMoment(const std::shared_ptr<const Scene>& loaded, const FrameSpec& asked,
                                    const Camera& now, const SceneView& view,
                                    const std::optional<GroundPlane>& ground) {
  const MotionFrom& from = *asked.motionFrom;
  const Pose pose{from.animation ? from.animation : asked.animation, from.nodes ? *from.nodes : asked.nodes, ground};
  ProblemList problems;
  const auto scene = collect(posedScene(loaded, pose), problems).value_or(loaded);
  const ResolvedFrame frame = resolveFrame(*scene, frameThen(asked, now), problems);
  if (!problems.empty()) return placedInMotion(std::move(problems).take(), from);
  const SceneView& then = scene->scenes[static_cast<std::size_t>(frame.scene)];
  return EarlierMoment{scene, frame.scene, frame.view, frame.spec.camera, instancesThen(view, then)};
}

glm::dvec2 motionAt(const ShownGeometry& shown, const EarlierMoment& earlier, const PlacedTriangle& triangle,
                    glm::dvec2 place) {
  const glm::dvec2 none(std::numeric_limits<double>::infinity());
  if (triangle.instance == kNoSurface || earlier.instances[triangle.instance] == kNoSurface) return none;
  const SceneView& view = earlier.scene->scenes[static_cast<std::size_t>(earlier.index)];
  const Instance& then = view.instances[earlier.instances[triangle.instance]];
  const glm::dvec3 weights = seenWeights(shown, triangle, place);
  // Both places go the same way, so that what does not move has a motion of exactly 0.
  const auto before = placeBefore(
      earlier.camera, pointOf(cornersOf(*earlier.scene, then, triangle.triangle, earlier.camera.eye), weights));
  const Instance& now = shown.view.instances[triangle.instance];
  const auto after =
      placeBefore(shown.camera, pointOf(cornersOf(shown.scene, now, triangle.triangle, shown.camera.eye), weights));
  if (!before || !after) return none;
  return (*after - *before) * glm::dvec2(shown.width, -shown.height) / 2.0;
}

} // namespace gnomon

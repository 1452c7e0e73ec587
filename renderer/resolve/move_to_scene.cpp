#include "renderer/resolve/move_to_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/prepare/box_depths.h"

namespace gnomon {
namespace {

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

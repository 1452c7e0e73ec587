#include "renderer/passes/light_lists.h"

#include <algorithm>
#include <cmath>

#include "renderer/shadow/light_coverage.h"

namespace gnomon {
namespace {

constexpr int kBlocksAcross = GNOMON_REGION_SIZE / GNOMON_BLOCK_SIZE;

/// The surfaces of one block, as a box relative to the eye.
Aabb blockBox(const CameraView& view, const ReceiverDepths& receivers, int column, int row) {
  const DepthSpan& span = receivers.blocks[static_cast<std::size_t>(row) * receivers.columns + column];
  if (span.empty()) return {};
  constexpr double kMargin = 0.5; // pixels
  Aabb box;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = (column + (corner & 1)) * receivers.blockSize + ((corner & 1) != 0 ? kMargin : -kMargin);
    const double y = (row + (corner >> 1 & 1)) * receivers.blockSize + ((corner & 2) != 0 ? kMargin : -kMargin);
    const double depth = (corner & 4) != 0 ? span.farthest * (1 + 1e-5) : span.nearest * (1 - 1e-5);
    const glm::dvec3 across = view.right * (view.halfSize.x * (2 * x / receivers.width - 1)) -
                              view.up * (view.halfSize.y * (2 * y / receivers.height - 1));
    box.add(view.forward * depth + across * (view.perspective ? depth : 1.0));
  }
  return box;
}

/// What a light reaches; a negative radius stands for everything.
Sphere reachOf(const shared::LightData& light) {
  if (light.direction.w == GNOMON_DIRECTIONAL || light.position.w <= 0) return {{}, -1};
  ShadowCaster caster;
  caster.type = light.direction.w == GNOMON_SPOT ? LightType::spot : LightType::point;
  caster.position = glm::dvec3(light.position);
  caster.direction = glm::dvec3(light.direction);
  caster.range = light.position.w;
  if (caster.type == LightType::spot) {
    caster.outerCone = std::acos(std::clamp(-double(light.cone.y) / light.cone.x, -1.0, 1.0));
  }
  Sphere sphere = reachOf(caster);
  sphere.radius *= 1 + 1e-4; // the shader's lights are floats
  return sphere;
}

bool touches(const Sphere& sphere, const Aabb& box) {
  if (box.empty()) return false;
  if (sphere.radius < 0) return true;
  const glm::dvec3 away = glm::max(glm::max(box.min - sphere.center, sphere.center - box.max), glm::dvec3(0.0));
  return glm::dot(away, away) <= sphere.radius * sphere.radius;
}

} // namespace

std::vector<std::uint32_t> lightLists(const CameraView& view, const ReceiverDepths& receivers,
                                      std::span<const shared::LightData> lights) {
  std::vector<Sphere> reaches;
  std::transform(lights.begin(), lights.end(), std::back_inserter(reaches),
                 [](const shared::LightData& light) { return reachOf(light); });
  const int columns = (receivers.columns + kBlocksAcross - 1) / kBlocksAcross;
  const int rows = (receivers.rows + kBlocksAcross - 1) / kBlocksAcross;
  std::vector<std::uint32_t> lists(2 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<Aabb> boxes;
  for (int region = 0; region < columns * rows; ++region) {
    boxes.clear();
    Aabb whole;
    const int firstColumn = region % columns * kBlocksAcross;
    const int firstRow = region / columns * kBlocksAcross;
    for (int row = firstRow; row < std::min(firstRow + kBlocksAcross, receivers.rows); ++row) {
      for (int column = firstColumn; column < std::min(firstColumn + kBlocksAcross, receivers.columns); ++column) {
        boxes.push_back(blockBox(view, receivers, column, row));
        whole.add(boxes.back());
      }
    }
    lists[2 * static_cast<std::size_t>(region)] = static_cast<std::uint32_t>(lists.size());
    for (std::uint32_t i = 0; i < reaches.size(); ++i) {
      const auto reached = [&](const Aabb& box) { return touches(reaches[i], box); };
      if (reached(whole) && std::any_of(boxes.begin(), boxes.end(), reached)) lists.push_back(i);
    }
    lists[2 * static_cast<std::size_t>(region) + 1] = static_cast<std::uint32_t>(lists.size());
  }
  return lists;
}

} // namespace gnomon

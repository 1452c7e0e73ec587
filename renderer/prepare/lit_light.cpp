#include "renderer/prepare/lit_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/spec/traits.h"
#include "renderer/core/camera_view.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/tile_size.h"

namespace gnomon {
namespace {

glm::dvec3 colorOf(const Light& light) {
  if (light.temperatureKelvin) return blackBodyColor(*light.temperatureKelvin);
  return toVector(light.color.value_or(Vec3{1, 1, 1}));
}

std::optional<ManualBias> manualBias(const Bias& bias) {
  const auto offset = manualOffset(bias);
  if (!offset) return std::nullopt;
  return ManualBias{bias.depth.value_or(0.0), bias.slope.value_or(0.0), *offset};
}

LitLight litLight(const Light& light, const glm::dvec3& eye) {
  LitLight lit;
  lit.type = light.type;
  lit.direction = directionOf(light);
  if (light.position) {
    lit.position = toVector(*light.position) - eye;
    lit.range = light.range.value_or(0.0);
  }
  lit.radiance = colorOf(light) * light.intensity;
  lit.innerCone = glm::radians(light.innerConeDegrees);
  lit.outerCone = glm::radians(light.outerConeDegrees);
  return lit;
}

constexpr int kBlocksAcross = kLightListSquare / kSurveyBlock;

/// The surfaces of every block, as boxes relative to the eye; empty where there are none.
std::vector<Aabb> blockBoxes(const CameraView& view, const ReceiverDepths& receivers) {
  const auto columns =
      blockStrips(receivers.columns, receivers.blockSize, receivers.width, view.right * view.halfSize.x);
  const auto rows = blockStrips(receivers.rows, receivers.blockSize, receivers.height, view.up * -view.halfSize.y);
  std::vector<Aabb> boxes;
  for (const BlockStrip& row : rows) {
    for (const BlockStrip& column : columns) {
      const DepthSpan& span = receivers.blocks[boxes.size()];
      boxes.push_back(span.empty() ? Aabb{}
                                   : blockPiece(view.perspective, wayToMiddle(view), column, row,
                                                span.nearest - depthSlack(view, span.nearest),
                                                span.farthest + depthSlack(view, span.farthest)));
    }
  }
  return boxes;
}

/// What a light reaches; absent = everything.
std::optional<Sphere> reachOf(const LitLight& light) {
  if (traitsOf(light.type).parallel || light.range <= 0) return std::nullopt;
  ShadowCaster caster;
  caster.type = light.type;
  caster.position = light.position;
  caster.direction = light.direction;
  caster.range = light.range;
  caster.outerCone = light.outerCone;
  Sphere sphere = reachOf(caster);
  sphere.radius *= 1 + 1e-4; // devices light in floats
  return sphere;
}

bool reaches(const std::optional<Sphere>& sphere, const Aabb& box) {
  if (box.empty()) return false;
  return !sphere || squaredDistance(box, sphere->center) <= sphere->radius * sphere->radius;
}

} // namespace

std::vector<LitLight> litLights(std::span<const Light> lights, const ShadowPlan& plan, const glm::dvec3& eye,
                                std::span<const LitGroups> groups, std::span<const int> layered) {
  std::vector<LitLight> lit;
  for (const Light& light : lights) {
    lit.push_back(litLight(light, eye));
    if (!groups.empty()) lit.back().groups = groups[lit.size() - 1];
  }
  for (const PlannedLight& planned : plan.lights) {
    const auto index = static_cast<std::size_t>(planned.light);
    const Shadow& shadow = *lights[index].shadow;
    LitLight& light = lit[index];
    light.firstTile = planned.firstTile;
    light.tileCount = planned.tileCount;
    light.filter = kernelOf(shadow.filter, radiusOf(lights[index]));
    light.manualBias = manualBias(shadow.bias);
    light.fadesOut = planned.fadeOut;
    light.smoothTerminator = shadow.terminator == Terminator::smooth;
    light.strength = shadow.strength;
    light.shadowColor = toVector(shadow.color);
  }
  for (std::size_t layer = 0; layer < layered.size(); ++layer) {
    const auto index = static_cast<std::size_t>(layered[layer]);
    lit[index].visibilityLayer = static_cast<int>(layer);
    const TechniqueTraits& technique = traitsOf(lights[index].shadow->technique);
    lit[index].layerOmitsTurnedFaces = !technique.traced || technique.baked;
    lit[index].strength = lights[index].shadow->strength;
    lit[index].shadowColor = toVector(lights[index].shadow->color);
  }
  return lit;
}

std::vector<LitLight> atFullStrength(std::vector<LitLight> lights) {
  for (LitLight& light : lights) light.strength = 1;
  return lights;
}

std::vector<std::uint32_t> lightLists(const CameraView& view, const ReceiverDepths& receivers,
                                      std::span<const LitLight> lights) {
  std::vector<std::optional<Sphere>> spheres;
  std::transform(lights.begin(), lights.end(), std::back_inserter(spheres),
                 [](const LitLight& light) { return reachOf(light); });
  const int columns = (receivers.columns + kBlocksAcross - 1) / kBlocksAcross;
  const int rows = (receivers.rows + kBlocksAcross - 1) / kBlocksAcross;
  std::vector<std::uint32_t> lists(2 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const std::vector<Aabb> blocks = blockBoxes(view, receivers);
  std::vector<Aabb> boxes;
  for (int region = 0; region < columns * rows; ++region) {
    boxes.clear();
    Aabb whole;
    const int firstColumn = region % columns * kBlocksAcross;
    const int firstRow = region / columns * kBlocksAcross;
    for (int row = firstRow; row < std::min(firstRow + kBlocksAcross, receivers.rows); ++row) {
      for (int column = firstColumn; column < std::min(firstColumn + kBlocksAcross, receivers.columns); ++column) {
        boxes.push_back(blocks[static_cast<std::size_t>(row) * receivers.columns + column]);
        whole.add(boxes.back());
      }
    }
    lists[2 * static_cast<std::size_t>(region)] = static_cast<std::uint32_t>(lists.size());
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
      const auto reached = [&](const Aabb& box) { return reaches(spheres[i], box); };
      if (reached(whole) && std::any_of(boxes.begin(), boxes.end(), reached)) lists.push_back(i);
    }
    lists[2 * static_cast<std::size_t>(region) + 1] = static_cast<std::uint32_t>(lists.size());
  }
  return lists;
}

} // namespace gnomon

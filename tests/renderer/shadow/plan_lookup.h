#pragma once

#include <vector>

#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {

/// A surface point that the survey allows.
struct ReceiverPoint {
  glm::dvec3 relative{0};
  double depth = 0; ///< view depth
};

/// Anywhere in a random block between its nearest and farthest depth; the survey must not be empty.
inline ReceiverPoint randomReceiver(Dice& dice, const PlanInput& input) {
  const ReceiverDepths& r = input.receivers;
  const int count = r.columns * r.rows;
  int block = dice.below(count);
  while (r.blocks[static_cast<std::size_t>(block)].empty()) block = (block + 1) % count;
  const DepthSpan& span = r.blocks[static_cast<std::size_t>(block)];
  const int column = block % r.columns;
  const int row = block / r.columns;
  const auto pixel = [&](int strip, int pixels) {
    return dice.between(strip * r.blockSize, std::min((strip + 1) * r.blockSize, pixels));
  };
  const glm::dvec2 ndc(2 * pixel(column, r.width) / r.width - 1, 1 - 2 * pixel(row, r.height) / r.height);
  const double depth = dice.chance(0.2)   ? span.nearest
                       : dice.chance(0.2) ? span.farthest
                                          : dice.between(span.nearest, span.farthest);
  return {pointAt(input.view, ndc, depth), depth};
}

/// The tiles that a shader reads for a pixel: the first whose far is not less than the depth, and the one after it
/// where the pixel lies in the blend zone. In floats, as the shader compares. None outside a manual range.
inline std::vector<const ShadowTile*> tilesRead(const ShadowPlan& plan, const PlannedLight& light, double depth) {
  const float d = static_cast<float>(depth);
  for (int i = 0; i < light.tileCount; ++i) {
    const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(light.firstTile + i)];
    if (i == 0 && d < static_cast<float>(tile.near)) return {};
    if (d > static_cast<float>(tile.far)) continue;
    std::vector<const ShadowTile*> tiles{&tile};
    const bool blends = d > static_cast<float>(tile.blendNear) && i + 1 < light.tileCount;
    if (blends) tiles.push_back(&tile + 1);
    return tiles;
  }
  return {};
}

/// Texels from the tile's lowest corner, and z.
inline glm::dvec3 tileCoordinates(const ShadowTile& tile, const glm::dvec3& relative) {
  const glm::dvec3 clip(tile.clipFromRelative * glm::dvec4(relative, 1.0));
  return {(0.5 * clip.x + 0.5) * tile.rect.width, (0.5 * clip.y + 0.5) * tile.rect.height, clip.z};
}

/// Within the part of the tile that is not border, and between z 0 and 1.
inline bool isServed(const ShadowTile& tile, const glm::dvec3& relative) {
  const glm::dvec3 at = tileCoordinates(tile, relative);
  const double low = tile.border - 1e-6;
  const double high = tile.rect.width - tile.border + 1e-6;
  return tile.rect.width > 0 && at.x >= low && at.x <= high && at.y >= low && at.y <= high && at.z >= 0 && at.z <= 1;
}

/// A view of 90 degrees by 90, along -Z from the origin, that sees a surface from `nearest` to `farthest` in every
/// block, and one sun at 45 degrees.
inline PlanInput simplePlan(float nearest, float farthest) {
  PlanInput input;
  input.frameWidth = input.receivers.width = 640;
  input.frameHeight = input.receivers.height = 640;
  input.receivers.columns = input.receivers.rows = 80;
  input.receivers.range = {nearest, farthest};
  input.receivers.blocks.assign(6400, {nearest, farthest});
  input.sceneBounds.add(glm::dvec3(-100));
  input.sceneBounds.add(glm::dvec3(100));
  input.casters.push_back({0, glm::normalize(glm::dvec3(1, -1, 0.2)), {}});
  return input;
}

} // namespace gnomon

#include "renderer/shadow/predicted_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

/// Where a short step in the world leads in the picture, pixels.
glm::dvec2 pixelsOf(const CameraView& view, const SeenBlocks& seen, const glm::dvec2& ndc, double depth,
                    const glm::dvec3& step) {
  const glm::dvec2 across = glm::dvec2(glm::dot(step, view.right), glm::dot(step, view.up)) / view.halfSize;
  const glm::dvec2 fromAxis = ndc + view.center / view.halfSize;
  const glm::dvec2 moved = view.perspective ? (across - fromAxis * glm::dot(step, view.forward)) / depth : across;
  return moved * seen.pixels * 0.5;
}

float texelExtent(const CameraView& view, const SeenBlocks& seen, const TileSpace& space, const glm::dvec2& ndc,
                  double depth, double distance) {
  const glm::dvec2 size = space.fit.texelSize * (space.fit.perspective ? distance : 1.0);
  const glm::dvec2 right = pixelsOf(view, seen, ndc, depth, space.basis.right * size.x);
  const glm::dvec2 up = pixelsOf(view, seen, ndc, depth, space.basis.up * size.y);
  return static_cast<float>(std::max(glm::length(right + up), glm::length(right - up)));
}

/// A cascade serves by view depth alone.
std::vector<float> extentsInCascade(const CameraView& view, const SeenBlocks& seen, const ShadowTile& tile) {
  std::vector<float> extents;
  for (const SeenBlock& block : seen.blocks) {
    const double depth = std::max(block.depths[0], tile.near);
    if (depth > std::min(block.depths[1], tile.far)) continue;
    extents.push_back(texelExtent(view, seen, tile.space, block.ndc, depth, 0.0));
  }
  return extents;
}

/// A face serves what lies in its pyramid.
std::vector<float> extentsInFace(const CameraView& view, const SeenBlocks& seen, const ShadowTile& tile) {
  std::vector<float> extents;
  const glm::dvec3& direction = tile.space.basis.direction;
  const double offset = glm::dot(tile.space.origin, direction);
  for (const SeenBlock& block : seen.blocks) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double distance = glm::dot(block.points[end], direction) - offset;
      if (!(distance > 0) || distance < tile.near || distance > tile.far) continue;
      const glm::dvec2 clip(tile.clipFromRelative * glm::dvec4(block.points[end], 1.0));
      if (std::abs(clip.x) > distance || std::abs(clip.y) > distance) continue;
      extents.push_back(texelExtent(view, seen, tile.space, block.ndc, block.depths[end], distance));
      break;
    }
  }
  return extents;
}

} // namespace

SeenBlocks seenBlocks(const CameraView& view, const ReceiverDepths& receivers) {
  const auto middle = [&](int strip, int pixels) {
    const double begin = strip * receivers.blockSize;
    const double end = std::min<double>(begin + receivers.blockSize, pixels);
    return (begin + end) / pixels - 1.0;
  };
  SeenBlocks seen;
  seen.pixels = {receivers.width, receivers.height};
  seen.blocks.reserve(receivers.blocks.size());
  for (int row = 0; row < receivers.rows; ++row) {
    for (int column = 0; column < receivers.columns; ++column) {
      const DepthSpan& span = receivers.blocks[static_cast<std::size_t>(row * receivers.columns + column)];
      if (span.empty()) continue;
      SeenBlock block;
      block.ndc = {middle(column, receivers.width), -middle(row, receivers.height)};
      block.depths = {span.nearest, span.farthest};
      for (std::size_t end = 0; end < 2; ++end) block.points[end] = pointAt(view, block.ndc, block.depths[end]);
      seen.blocks.push_back(block);
    }
  }
  return seen;
}

std::vector<float> texelExtents(const CameraView& view, const SeenBlocks& seen, const ShadowTile& tile) {
  if (tile.rect.width == 0) return {};
  return tile.space.fit.perspective ? extentsInFace(view, seen, tile) : extentsInCascade(view, seen, tile);
}

std::optional<PredictedError> errorOf(std::vector<float> extents) {
  if (extents.empty()) return std::nullopt;
  const auto atShare = [&](double share) -> double {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(extents.size())));
    const auto place = extents.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
    std::nth_element(extents.begin(), place, extents.end());
    return *place;
  };
  return PredictedError{atShare(0.5), atShare(0.95), atShare(1.0)};
}

PredictedErrors predictErrors(const PlanInput& input, const ShadowPlan& plan) {
  PredictedErrors errors;
  errors.tiles.resize(plan.tiles.size());
  if (plan.tiles.empty()) {
    errors.lights.resize(plan.lights.size());
    return errors;
  }
  std::map<int, SeenBlocks> seen;
  std::vector<const SeenBlocks*> seenOf(plan.tiles.size());
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    const ShadowCaster& caster = input.casters[i];
    if (plan.lights[i].tileCount == 0) continue;
    const auto [found, isNew] = seen.try_emplace(caster.part);
    if (isNew) found->second = seenBlocks(input.view, receiversOf(input, caster));
    std::fill_n(seenOf.begin() + plan.lights[i].firstTile, plan.lights[i].tileCount, &found->second);
  }
  std::vector<std::vector<float>> extents(plan.tiles.size());
  forEach(extents.size(), [&](std::size_t tile) {
    extents[tile] = texelExtents(input.view, *seenOf[tile], plan.tiles[tile]);
    errors.tiles[tile] = errorOf(extents[tile]);
  });
  std::vector<float> all;
  for (const PlannedLight& light : plan.lights) {
    std::vector<float> ofLight;
    for (int i = 0; i < light.tileCount; ++i) {
      const std::vector<float>& ofTile = extents[static_cast<std::size_t>(light.firstTile + i)];
      ofLight.insert(ofLight.end(), ofTile.begin(), ofTile.end());
    }
    all.insert(all.end(), ofLight.begin(), ofLight.end());
    errors.lights.push_back(errorOf(std::move(ofLight)));
  }
  errors.all = errors.lights.size() == 1 ? errors.lights.front() : errorOf(std::move(all));
  return errors;
}

} // namespace gnomon

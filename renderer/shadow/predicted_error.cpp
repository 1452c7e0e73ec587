#include "renderer/shadow/predicted_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon {
namespace {

/// A place in the picture: -1..1, y up, and the view depth.
struct Place {
  glm::dvec2 ndc{0};
  double depth = 0;
};

/// Where a short step in the world leads in the picture, pixels.
glm::dvec2 pixelsOf(const CameraView& view, const ReceiverDepths& receivers, const Place& place,
                    const glm::dvec3& step) {
  const glm::dvec2 across = glm::dvec2(glm::dot(step, view.right), glm::dot(step, view.up)) / view.halfSize;
  const glm::dvec2 ndc = view.perspective ? (across - place.ndc * glm::dot(step, view.forward)) / place.depth : across;
  return ndc * glm::dvec2(receivers.width, receivers.height) * 0.5;
}

double texelExtent(const CameraView& view, const ReceiverDepths& receivers, const TileSpace& space, const Place& place,
                   double distance) {
  const glm::dvec2 size = space.fit.texelSize * (space.fit.perspective ? distance : 1.0);
  const glm::dvec2 right = pixelsOf(view, receivers, place, space.basis.right * size.x);
  const glm::dvec2 up = pixelsOf(view, receivers, place, space.basis.up * size.y);
  return std::max(glm::length(right + up), glm::length(right - up));
}

/// A cascade serves by view depth alone.
std::optional<double> extentInCascade(const CameraView& view, const ReceiverDepths& receivers, const ShadowTile& tile,
                                      const glm::dvec2& ndc, const DepthSpan& span) {
  const Place place{ndc, std::max<double>(span.nearest, tile.near)};
  if (place.depth > std::min<double>(span.farthest, tile.far)) return std::nullopt;
  return texelExtent(view, receivers, tile.space, place, 0.0);
}

/// A face serves what lies in its pyramid.
std::optional<double> extentInFace(const CameraView& view, const ReceiverDepths& receivers, const ShadowTile& tile,
                                   const glm::dvec2& ndc, const DepthSpan& span) {
  for (const double depth : {double{span.nearest}, double{span.farthest}}) {
    const Place place{ndc, depth};
    const glm::dvec3 point = pointAt(view, ndc, depth);
    const double distance = glm::dot(point - tile.space.origin, tile.space.basis.direction);
    if (!(distance > 0) || distance < tile.near || distance > tile.far) continue;
    const glm::dvec2 clip(tile.clipFromRelative * glm::dvec4(point, 1.0));
    if (std::abs(clip.x) <= distance && std::abs(clip.y) <= distance) {
      return texelExtent(view, receivers, tile.space, place, distance);
    }
  }
  return std::nullopt;
}

} // namespace

std::vector<float> texelExtents(const CameraView& view, const ReceiverDepths& receivers, const ShadowTile& tile) {
  std::vector<float> extents;
  if (tile.rect.width == 0) return extents;
  const auto middle = [&](int strip, int pixels) {
    const double begin = strip * receivers.blockSize;
    const double end = std::min<double>(begin + receivers.blockSize, pixels);
    return (begin + end) / pixels - 1.0;
  };
  for (int row = 0; row < receivers.rows; ++row) {
    for (int column = 0; column < receivers.columns; ++column) {
      const DepthSpan& span = receivers.blocks[static_cast<std::size_t>(row * receivers.columns + column)];
      if (span.empty()) continue;
      const glm::dvec2 ndc(middle(column, receivers.width), -middle(row, receivers.height));
      const auto extent = tile.space.fit.perspective ? extentInFace(view, receivers, tile, ndc, span)
                                                     : extentInCascade(view, receivers, tile, ndc, span);
      if (extent) extents.push_back(static_cast<float>(*extent));
    }
  }
  return extents;
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

PredictedErrors predictErrors(const CameraView& view, const ReceiverDepths& receivers, const ShadowPlan& plan) {
  PredictedErrors errors;
  errors.tiles.resize(plan.tiles.size());
  std::vector<float> all;
  for (const PlannedLight& light : plan.lights) {
    std::vector<float> ofLight;
    for (int i = 0; i < light.tileCount; ++i) {
      const auto tile = static_cast<std::size_t>(light.firstTile + i);
      std::vector<float> extents = texelExtents(view, receivers, plan.tiles[tile]);
      ofLight.insert(ofLight.end(), extents.begin(), extents.end());
      errors.tiles[tile] = errorOf(std::move(extents));
    }
    all.insert(all.end(), ofLight.begin(), ofLight.end());
    errors.lights.push_back(errorOf(std::move(ofLight)));
  }
  errors.all = errorOf(std::move(all));
  return errors;
}

} // namespace gnomon

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

constexpr double kBand = 2;          ///< pixels, as in renderer/reference/error_measures.cpp
constexpr double kQuarter = 0.25;    ///< mean of |x| over -0.5..0.5
constexpr double kSteepShare = 0.68; ///< of that, what is left across the texels of one bilinear lookup
constexpr double kSteepPower = -0.6; ///< and how it falls with more of them: both fitted, see the tests
constexpr double kScatter = 0.019;   ///< radii: of a disc's bilinear comparisons, turned by pixel; see the tests

/// The integral of min(|x|, limit) from 0 to x.
double cutIntegral(double x, double limit) {
  const double size = std::abs(x);
  const double area = size <= limit ? 0.5 * size * size : limit * size - 0.5 * limit * limit;
  return std::copysign(area, x);
}

/// The mean of min(|x|, limit) over x from middle - reach to middle + reach.
double cutMean(double middle, double reach, double limit) {
  const double size = std::abs(middle);
  // Where the interval is short the difference of integrals would be lost in rounding.
  if (reach <= 1e-6 * std::max(size, limit)) return std::min(size, limit);
  return (cutIntegral(size + reach, limit) - cutIntegral(size - reach, limit)) / (2 * reach);
}

/// The even kernel of the same variance as the one of `size` comparisons a side (shaders/common_shadow_filter.glsl):
/// n even taps have a variance of (n^2 - 1) / 12.
double tapsOfKernel(int size) {
  const double variance = size <= 1 ? 0.0 : size == 3 ? 1.0 / 2 : size == 5 ? 7.0 / 6 : 41.0 / 26;
  return std::sqrt(12 * variance + 1);
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

MapReading readingOf(const ShadowTile& tile, int atlasSamples) {
  const FilterKernel& filter = tile.filter;
  MapReading reading;
  reading.bilinear = atlasSamples <= 1 || filter.moments;
  reading.taps = filter.moments ? filter.size : tapsOfKernel(filter.size);
  const double texel = std::max(tile.space.fit.texelSize.x, tile.space.fit.texelSize.y);
  if (filter.kind != MapReadingKind::disc || !(texel > 0)) return reading;
  return overDisc(reading, tile.space.fit.radius / texel);
}

MapReading overDisc(MapReading reading, double radius) {
  // A disc weighs as a square of the same variance does, whose side is sqrt 3 times the radius.
  reading.taps += std::sqrt(3.0) * radius;
  reading.scatter += kScatter * radius;
  return reading;
}

double staircase(const MapReading& reading, double slope) {
  if (!reading.bilinear && reading.taps <= 1) {
    // The mean of |a x + b y| over a texel, a >= b the normal's components: a / 4 + b^2 / (12 a).
    return (kQuarter + slope * slope / 12) / std::sqrt(1 + slope * slope);
  }
  // The rows that a lookup weighs span `taps` texels along the edge; a row's cut moves by `slope` from one to the next.
  return kQuarter * std::max(1 - reading.taps * slope, kSteepShare * std::pow(reading.taps, kSteepPower));
}

double expectedDisplacement(const EdgeOnTexels& edge, const MapReading& reading) {
  const double limit = std::min(edge.room, kBand + std::max(std::abs(edge.across.x), std::abs(edge.across.y)));
  const glm::dvec2 inTexels =
      glm::abs(glm::dvec2(glm::dot(edge.across, edge.texelU), glm::dot(edge.across, edge.texelV)));
  const double texel = glm::length(inTexels);
  const double shift = glm::dot(edge.across, edge.shift);
  if (!std::isfinite(texel) || !std::isfinite(shift)) return 0;
  const double greater = std::max(inTexels.x, inTexels.y);
  const double slope = greater > 0 ? std::min(inTexels.x, inTexels.y) / greater : 0;
  // Any place between -2 and 2 times the mean distance is as likely.
  return cutMean(shift, 2 * std::hypot(staircase(reading, slope), reading.scatter) * texel, limit);
}

} // namespace gnomon

#include "renderer/shadow/tile_size.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <tuple>

#include "protocol/spec/traits.h"
#include "renderer/core/camera_view.h"

namespace gnomon {
namespace {

bool isInView(const CameraView& view, const Sphere& sphere) {
  const Frustum frustum = frustumOf(view);
  const bool beforePlanes = std::all_of(frustum.planes.begin(), frustum.planes.end(), [&](const glm::dvec4& plane) {
    return glm::dot(glm::dvec3(plane), sphere.center) + plane.w >= -sphere.radius * glm::length(glm::dvec3(plane));
  });
  return beforePlanes &&
         mayIntersect(frustum, {sphere.center - glm::dvec3(sphere.radius), sphere.center + glm::dvec3(sphere.radius)});
}

/// Diameter of the circle around a sphere's picture, in lengths of the picture plane 1 m ahead; infinite where the
/// sphere reaches the plane of the eye. The picture is an ellipse along the way from the view axis, from the tangent of
/// one rim's angle to that of the other's.
double projectedDiameter(const CameraView& view, const Sphere& sphere) {
  const double distance = glm::length(sphere.center);
  const double offAxis = std::acos(std::clamp(glm::dot(sphere.center, view.forward) / distance, -1.0, 1.0));
  const double halfAngle = std::asin(std::min(1.0, sphere.radius / distance));
  if (offAxis + halfAngle >= 0.5 * glm::pi<double>()) return HUGE_VAL;
  return std::tan(offAxis + halfAngle) - std::tan(offAxis - halfAngle);
}

std::int64_t areaOf(std::span<const TileRequest> requests, const std::vector<int>& sizes) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    area += static_cast<std::int64_t>(requests[i].tileCount) * sizes[i] * sizes[i];
  }
  return area;
}

/// The request that yields first: of those that may, that of the least importance, the largest tiles and the highest
/// light; their number where none may.
template <class MayYield>
std::size_t firstToYield(std::span<const TileRequest> requests, const std::vector<int>& sizes, const MayYield& may) {
  const auto yields = [&](std::size_t i) {
    return std::tuple(-static_cast<int>(requests[i].importance), sizes[i], requests[i].light);
  };
  std::size_t best = requests.size();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (may(i) && (best == requests.size() || yields(i) > yields(best))) best = i;
  }
  return best;
}

/// What is left goes back to those that were halved, the most important and the lowest light first.
std::vector<int> grown(std::span<const TileRequest> requests, std::vector<int> sizes, int atlasSide) {
  const std::int64_t room = static_cast<std::int64_t>(atlasSide) * atlasSide;
  std::vector<std::size_t> order(requests.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(-static_cast<int>(requests[a].importance), requests[a].light) <
           std::tuple(-static_cast<int>(requests[b].importance), requests[b].light);
  });
  for (const std::size_t i : order) {
    while (sizes[i] > 0 && 2 * sizes[i] <= std::min(requests[i].size, atlasSide)) {
      sizes[i] *= 2;
      if (areaOf(requests, sizes) <= room) continue;
      sizes[i] /= 2;
      break;
    }
  }
  return sizes;
}

/// Every second bit, from the lowest, as one number.
int evenBits(std::uint64_t bits) {
  int result = 0;
  for (int i = 0; i < 31; ++i) result |= static_cast<int>((bits >> (2 * i)) & 1u) << i;
  return result;
}

} // namespace

// A cone of half angle a up to 45 degrees, cut by a sphere of radius R about its apex, fits the sphere through apex and
// rim; a wider one the sphere about its rim.
Sphere reachOf(const ShadowCaster& light) {
  if (!traitsOf(light.type).hasCone) return {light.position, light.range};
  const double cosine = std::cos(light.outerCone);
  if (light.outerCone <= glm::radians(45.0)) {
    const double radius = light.range / (2.0 * cosine);
    return {light.position + light.direction * radius, radius};
  }
  return {light.position + light.direction * (light.range * cosine), light.range * std::sin(light.outerCone)};
}

int lightSize(const ShadowCaster& light, const CameraView& view, int frameWidth, int frameHeight) {
  const int longest = std::max(frameWidth, frameHeight);
  if (traitsOf(light.type).parallel || light.range <= 0) return longest;
  const Sphere sphere = reachOf(light);
  if (!isInView(view, sphere)) return 0;
  if (view.perspective && glm::length(sphere.center) <= sphere.radius) return longest;
  const double across = view.perspective ? projectedDiameter(view, sphere) : 2.0 * sphere.radius;
  // Along the finer side of pixels that are no squares.
  const double pixels = across * std::max(frameWidth / (2.0 * view.halfSize.x), frameHeight / (2.0 * view.halfSize.y));
  return static_cast<int>(std::ceil(std::min<double>(pixels, longest)));
}

std::vector<int> grantTileSizes(std::span<const TileRequest> requests, int atlasSide) {
  const std::int64_t room = static_cast<std::int64_t>(atlasSide) * atlasSide;
  std::vector<bool> refused(requests.size(), atlasSide < kSmallestTile);
  for (;;) {
    std::vector<int> sizes(requests.size(), 0);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (!refused[i]) sizes[i] = std::min(requests[i].size, atlasSide);
    }
    while (areaOf(requests, sizes) > room) {
      const std::size_t halved = firstToYield(
          requests, sizes, [&](std::size_t i) { return sizes[i] > kSmallestTile && requests[i].tileCount > 0; });
      if (halved == requests.size()) break;
      sizes[halved] /= 2;
    }
    if (areaOf(requests, sizes) <= room) return grown(requests, std::move(sizes), atlasSide);

    const std::vector<int> noSizes(requests.size());
    refused[firstToYield(requests, noSizes, [&](std::size_t i) { return !refused[i]; })] = true;
  }
}

AtlasLayout packSquares(std::span<const TileSquare> squares) {
  AtlasLayout layout;
  layout.rects.resize(squares.size());
  if (squares.empty()) return layout;

  std::vector<std::size_t> order(squares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(-squares[a].size, squares[a].light, squares[a].cascade) <
           std::tuple(-squares[b].size, squares[b].light, squares[b].cascade);
  });

  std::uint64_t taken = 0; // texels along the curve; a multiple of the next square's area, as sizes only fall
  for (const std::size_t i : order) {
    const int size = squares[i].size;
    layout.rects[i] = {evenBits(taken), evenBits(taken >> 1), size, size};
    taken += static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size);
  }
  const int bits = std::countr_zero(std::bit_ceil(taken));
  layout.width = 1 << ((bits + 1) / 2);
  layout.height = 1 << (bits / 2);
  return layout;
}

} // namespace gnomon

#include "renderer/volume/volume_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"
#include "renderer/volume/march.h"
#include "renderer/volume/view_ray.h"

namespace gnomon {
namespace {

constexpr std::size_t kPiece = 64; // pixels
constexpr std::size_t kMostSamples = 4;
constexpr float kSameDepth = 0.01f;

/// Calls `each(pixel, x, y)` for every pixel, in parallel.
template <class Each>
void forEachPixel(const SeenSurfaces& seen, Each each) {
  const std::size_t width = static_cast<std::size_t>(seen.width);
  forEachPiece(width * static_cast<std::size_t>(seen.height), kPiece, [&](std::size_t first, std::size_t last) {
    for (std::size_t pixel = first; pixel < last; ++pixel) {
      each(pixel, static_cast<double>(pixel % width), static_cast<double>(pixel / width));
    }
  });
}

ViewRay rayThrough(const SeenSurfaces& seen, double x, double y) {
  return viewRayAt(seen.view, {2 * x / seen.width - 1, 2 * y / seen.height - 1});
}

std::span<const float> samplesOf(const SeenSurfaces& seen, std::size_t pixel) {
  return seen.depths.subspan(pixel * seen.places.size(), seen.places.size());
}

bool isSame(float depth, float other) {
  return depth == other || std::abs(depth - other) < kSameDepth * std::min(depth, other);
}

/// The earliest sample whose depth is about that of sample `i`.
std::size_t firstOf(std::span<const float> depths, std::size_t i) {
  std::size_t first = 0;
  while (!isSame(depths[first], depths[i])) ++first;
  return first;
}

} // namespace

std::vector<glm::vec4> marchPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                    const glm::dvec3& ambient) {
  std::vector<const Medium*> all;
  std::vector<const VolumeLight*> maps;
  for (const MappedMedium& each : media) {
    if (!each.medium->visible) continue;
    all.push_back(each.medium);
    maps.push_back(each.map);
  }
  const auto light = [&](std::size_t medium, const glm::dvec3& unit) {
    return lightAt(*maps[medium], unit) * glm::one_over_pi<double>() + ambient;
  };
  std::vector<glm::vec4> picture(static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height));
  forEachPixel(seen, [&](std::size_t pixel, double x, double y) {
    const ViewRay ray = rayThrough(seen, x + 0.5, y + 0.5);
    const std::span<const float> depths = samplesOf(seen, pixel);
    std::array<glm::dvec4, kMostSamples> marched;
    glm::dvec4 sum(0);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const std::size_t first = firstOf(depths, i); // of a chain of them the one before, which took its own first's
      if (first == i) {
        const double surface = double{depths[i]} * ray.metresPerDepth;
        const Marched seenHere = march(all, ray.ray, {ray.seen.from, std::min(ray.seen.to, surface)}, light);
        marched[i] = glm::dvec4(seenHere.color, seenHere.transmittance);
      } else {
        marched[i] = marched[first];
      }
      sum += marched[i];
    }
    picture[pixel] = glm::vec4(sum / static_cast<double>(depths.size()));
  });
  return picture;
}

std::vector<std::uint16_t> volumeShadowPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                               const glm::dvec3& towards) {
  std::vector<std::uint16_t> picture(seen.depths.size(), 65535);
  forEachPixel(seen, [&](std::size_t pixel, double x, double y) {
    const std::span<const float> depths = samplesOf(seen, pixel);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (!std::isfinite(depths[i])) continue;
      std::uint16_t& share = picture[pixel * depths.size() + i];
      if (const std::size_t first = firstOf(depths, i); first < i) {
        share = picture[pixel * depths.size() + first];
        continue;
      }
      const ViewRay ray = rayThrough(seen, x + double{seen.places[i].x}, y + double{seen.places[i].y});
      const glm::dvec3 place = pointAt(ray.ray, double{depths[i]} * ray.metresPerDepth);
      share = static_cast<std::uint16_t>(std::lround(volumeVisibility(media, place, towards) * 65535));
    }
  });
  return picture;
}

} // namespace gnomon

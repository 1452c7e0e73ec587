#include "renderer/volume/volume_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"
#include "renderer/volume/march.h"
#include "renderer/volume/view_ray.h"

namespace gnomon {
namespace {

constexpr std::size_t kPiece = 64; // pixels

/// Calls `each(pixel, ray)` for every pixel, in parallel.
template <class Each>
void forEachPixel(const SeenSurfaces& seen, Each each) {
  const std::size_t width = static_cast<std::size_t>(seen.width);
  forEachPiece(width * static_cast<std::size_t>(seen.height), kPiece, [&](std::size_t first, std::size_t last) {
    for (std::size_t pixel = first; pixel < last; ++pixel) {
      const std::size_t row = pixel / width, column = pixel % width;
      const glm::dvec2 place(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      each(pixel, viewRayAt(seen.view, {2 * place.x / seen.width - 1, 1 - 2 * place.y / seen.height}));
    }
  });
}

} // namespace

std::vector<glm::vec4> marchPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                    const glm::dvec3& ambient) {
  std::vector<const Medium*> all;
  for (const MappedMedium& each : media) all.push_back(each.medium);
  const auto light = [&](std::size_t medium, const glm::dvec3& unit) {
    return lightAt(*media[medium].map, unit) * glm::one_over_pi<double>() + ambient;
  };
  std::vector<glm::vec4> picture(seen.depths.size());
  forEachPixel(seen, [&](std::size_t pixel, const ViewRay& ray) {
    const double surface = double{seen.depths[pixel]} * ray.metresPerDepth;
    const Marched marched = march(all, ray.ray, {ray.seen.from, std::min(ray.seen.to, surface)}, light);
    picture[pixel] = glm::vec4(glm::vec3(marched.color), static_cast<float>(marched.transmittance));
  });
  return picture;
}

std::vector<float> volumeShadowPicture(const SeenSurfaces& seen, std::span<const MappedMedium> media,
                                       const glm::dvec3& towards) {
  std::vector<float> picture(seen.depths.size(), 1.0f);
  forEachPixel(seen, [&](std::size_t pixel, const ViewRay& ray) {
    const double depth = seen.depths[pixel];
    if (!std::isfinite(depth)) return;
    const glm::dvec3 place = pointAt(ray.ray, depth * ray.metresPerDepth);
    picture[pixel] = static_cast<float>(volumeVisibility(media, place, towards));
  });
  return picture;
}

} // namespace gnomon

#include "renderer/volume/volume_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/volume/volume_space.h"

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

constexpr double kHardlyAny = 0x1p-16; // of the light behind
constexpr double kMostVoxels = 512;    // of a way through a medium: steps of longer ones are as many
constexpr double kNudge = 1e-6;        // steps: surely beyond a brick's face

/// A medium that the ray meets.
struct Passage {
  const Medium* medium = nullptr;
  std::size_t index = 0;
  Ray ray{}; ///< in the unit cube
  Interval inside{};
  double step = 0;      ///< metres
  BrickPassage brick{}; ///< the last that was looked up
};

std::vector<Passage> passagesOf(std::span<const Medium* const> media, const Ray& ray, const Interval& piece,
                                double stepVoxels) {
  std::vector<Passage> passages;
  for (std::size_t i = 0; i < media.size(); ++i) {
    const Ray unit = toUnit(media[i]->space, ray);
    const auto line = insideUnitCube(unit);
    if (!line) continue;
    const Interval inside{std::max(line->from, piece.from), std::min(line->to, piece.to)};
    if (!(inside.from < inside.to)) continue;
    const double voxelsPerMetre = glm::length(unit.direction * glm::dvec3(media[i]->grid->size));
    if (!(voxelsPerMetre > 0)) continue; // a ray without a direction
    const double voxels = voxelsPerMetre * (inside.to - inside.from);
    const double step = stepVoxels * std::max(1.0, voxels / kMostVoxels) / voxelsPerMetre;
    passages.push_back({media[i], i, unit, inside, step, {inside.from, false}});
  }
  return passages;
}

/// What comes next on the ray: a step through what is filled, or none.
struct Stretch {
  double to = 0;
  bool filled = false;
};

Stretch stretchAt(std::span<Passage> passages, double from) {
  double bound = std::numeric_limits<double>::infinity(), empty = bound, step = bound;
  bool filled = false;
  for (Passage& passage : passages) {
    if (passage.inside.to <= from) continue;
    if (passage.inside.from > from) {
      bound = std::min(bound, passage.inside.from);
      continue;
    }
    bound = std::min(bound, passage.inside.to);
    step = std::min(step, passage.step);
    const double nudged = from + kNudge * passage.step;
    if (passage.brick.until <= nudged) passage.brick = brickAt(*passage.medium, passage.ray, nudged);
    filled = filled || passage.brick.filled;
    empty = std::min(empty, passage.brick.until);
  }
  // Far away a step may be too short for the digits of the distance.
  const double next = std::max(filled ? from + step : empty, std::nextafter(from, bound));
  return {std::min(bound, next), filled};
}

/// Calls `visit(passage, matter)` for each medium that holds something in the middle of the step from..to, which lies
/// wholly inside or outside each.
template <class Visit>
void visitMatter(std::span<const Passage> passages, double from, double to, Visit visit) {
  const double middle = from + (to - from) / 2;
  for (const Passage& passage : passages) {
    if (middle < passage.inside.from || middle > passage.inside.to) continue;
    const glm::dvec3 unit = pointAt(passage.ray, middle);
    const Matter matter = matterAt(*passage.medium, unit);
    if (matter.extinction > 0) visit(passage, unit, matter);
  }
}

/// Calls `each(from, to)` for all steps through what is filled, near to far, until one gives false.
template <class Each>
void forEachStep(std::span<Passage> passages, Each each) {
  double from = std::numeric_limits<double>::infinity(), end = -from;
  for (const Passage& passage : passages) {
    from = std::min(from, passage.inside.from);
    end = std::max(end, passage.inside.to);
  }
  while (from < end) {
    const Stretch stretch = stretchAt(passages, from);
    if (stretch.filled && !each(from, stretch.to)) return;
    from = stretch.to;
  }
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

Marched march(std::span<const Medium* const> media, const Ray& ray, const Interval& piece, const LightAt& lightAt,
              double stepVoxels) {
  std::vector<Passage> passages = passagesOf(media, ray, piece, stepVoxels);
  Marched marched;
  forEachStep(passages, [&](double from, double to) {
    glm::dvec3 scattered(0);
    double extinction = 0;
    visitMatter(passages, from, to, [&](const Passage& passage, const glm::dvec3& unit, const Matter& matter) {
      extinction += matter.extinction;
      scattered += matter.extinction * matter.color * lightAt(passage.index, unit);
    });
    if (extinction == 0) return true;
    const double taken = -std::expm1(-extinction * (to - from));
    marched.color += marched.transmittance * taken / extinction * scattered;
    marched.transmittance *= 1 - taken;
    if (marched.transmittance < kHardlyAny) marched.transmittance = 0;
    return marched.transmittance > 0;
  });
  return marched;
}

double opticalDepth(std::span<const Medium* const> media, const Ray& ray, const Interval& piece, double stepVoxels) {
  std::vector<Passage> passages = passagesOf(media, ray, piece, stepVoxels);
  double depth = 0;
  forEachStep(passages, [&](double from, double to) {
    visitMatter(passages, from, to, [&](const Passage&, const glm::dvec3&, const Matter& matter) {
      depth += matter.extinction * (to - from);
    });
    return true;
  });
  return depth;
}

} // namespace gnomon

#include "renderer/shadow/edge_displacement.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

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

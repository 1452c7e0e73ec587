#include "renderer/environment/sky_air.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

constexpr double kMoleculesScale = 8000; // metres of height in which the density falls to 1/e
constexpr double kHazeScale = 1200;

constexpr std::size_t kColumnHeights = 48;
constexpr std::size_t kColumnAngles = 96;

/// How far below the plane across the vertical the horizon lies.
double dipOf(double height) {
  return std::acos(kEarthRadius / (kEarthRadius + height));
}

double columnHeight(std::size_t row) {
  const double share = static_cast<double>(row) / (kColumnHeights - 1);
  return kAirTop * share * share;
}

/// What a row of angles spans, from the horizon to the zenith.
double spanOf(double height) {
  return glm::half_pi<double>() + dipOf(height);
}

} // namespace

AirColumn columnAlong(double height, double elevation) {
  constexpr int kSteps = 64;
  const double sine = std::sin(elevation);
  const double from = kEarthRadius + height;
  const double along = from * sine;
  const double top = kEarthRadius + kAirTop;
  const double beyond = std::sqrt(std::max(0.0, along * along - from * from + top * top));
  const double length = std::max(0.0, beyond - along); // rounding, at the top
  // The densest place: where the way is nearest to the ground. Steps are short there.
  const double densest = std::clamp(-along, 0.0, length);
  AirColumn sum;
  const auto walk = [&](double reach, double way) {
    for (int step = 0; step < kSteps && reach > 0; ++step) {
      const double begin = reach * step * step / (kSteps * kSteps);
      const double end = reach * (step + 1) * (step + 1) / (kSteps * kSteps);
      const double t = densest + way * (begin + end) / 2;
      const double radius = std::sqrt(from * from + t * t + 2 * t * along);
      sum = sum + densityAt(radius - kEarthRadius) * (end - begin);
    }
  };
  walk(length - densest, 1);
  walk(densest, -1);
  return sum;
}

double visibleDisc(const AirPlace& place) {
  const double above = std::asin(std::clamp(place.sunSine, -1.0, 1.0)) + dipOf(std::max(place.height, 0.0));
  const double x = std::clamp(2 * above / kSunRadians, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / glm::pi<double>();
}

AirColumn densityAt(double height) {
  const double above = std::max(height, 0.0);
  return {std::exp(-above / kMoleculesScale), std::exp(-above / kHazeScale),
          std::max(0.0, 1 - std::abs(above - 25'000) / 15'000)};
}

AirCoefficients coefficientsOf(double turbidity) {
  // Square metres of a molecule of ozone, times 1e25, at the middles of the bands: Gorshelev et al., "High spectral
  // resolution ozone absorption cross-sections", Atmospheric Measurement Techniques 7 (2014).
  constexpr std::array<double, kBands> kOzone = {0.015, 0.158, 0.775, 2.139, 4.266, 5.019, 2.662, 1.209};
  // 300 Dobson units, 2.687e20 molecules a square metre each, in a layer that amounts to 15 km of its densest.
  constexpr double kOzoneDensity = 300 * 2.687e20 / 15'000;
  constexpr double kScattered = 0.9;

  AirCoefficients air;
  for (std::size_t band = 0; band < kBands; ++band) {
    const double micrometres = wavelengthOf(band) / 1000;
    const double hazeDepth = (0.04608 * turbidity - 0.04586) * std::pow(micrometres, -1.3);
    air.molecules[band] = static_cast<float>(1.24062e-6 * std::pow(micrometres, -4));
    air.hazeLoss[band] = static_cast<float>(hazeDepth / kHazeScale);
    air.hazeScatter[band] = static_cast<float>(kScattered * hazeDepth / kHazeScale);
    air.ozoneAbsorbs[band] = static_cast<float>(kOzone[band] * 1e-25 * kOzoneDensity);
  }
  return air;
}

Spectrum transmittance(const AirCoefficients& air, const AirColumn& column) {
  const auto molecules = static_cast<float>(column.molecules), haze = static_cast<float>(column.haze);
  const auto ozone = static_cast<float>(column.ozone);
  Spectrum share;
  for (std::size_t band = 0; band < kBands; ++band) {
    share[band] =
        std::exp(-(air.molecules[band] * molecules + air.hazeLoss[band] * haze + air.ozoneAbsorbs[band] * ozone));
  }
  return share;
}

SunColumns::SunColumns() : columns_(kColumnHeights * kColumnAngles) {
  forEach(kColumnHeights, [&](std::size_t row) {
    const double height = columnHeight(row);
    for (std::size_t i = 0; i < kColumnAngles; ++i) {
      const double share = static_cast<double>(i) / (kColumnAngles - 1);
      columns_[row * kColumnAngles + i] = columnAlong(height, share * share * spanOf(height) - dipOf(height));
    }
  });
}

AirColumn SunColumns::columnAt(double height, double aboveHorizon) const {
  const double row = std::sqrt(std::clamp(height / kAirTop, 0.0, 1.0)) * (kColumnHeights - 1);
  const double column = std::sqrt(std::clamp(aboveHorizon / spanOf(height), 0.0, 1.0)) * (kColumnAngles - 1);
  const auto y = std::min(static_cast<std::size_t>(row), kColumnHeights - 2);
  const auto x = std::min(static_cast<std::size_t>(column), kColumnAngles - 2);
  const double right = column - static_cast<double>(x), below = row - static_cast<double>(y);
  const AirColumn* at = &columns_[y * kColumnAngles + x];
  return (at[0] * (1 - right) + at[1] * right) * (1 - below) +
         (at[kColumnAngles] * (1 - right) + at[kColumnAngles + 1] * right) * below;
}

Spectrum SunColumns::sunlight(const AirCoefficients& air, const AirPlace& place) const {
  const double disc = visibleDisc(place);
  if (disc <= 0) return {};
  const double height = std::clamp(place.height, 0.0, kAirTop);
  const double above = std::asin(std::clamp(place.sunSine, -1.0, 1.0)) + dipOf(height);
  Spectrum share = transmittance(air, columnAt(height, std::max(above, 0.0)));
  for (float& each : share) each *= static_cast<float>(disc);
  return share;
}

} // namespace gnomon

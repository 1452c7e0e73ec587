#include "renderer/environment/sky_scattering.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"

namespace gnomon {

namespace {

constexpr int kSteps = 40;           // of a ray to the eye
constexpr int kSecondSteps = 16;     // of a ray of the table
constexpr std::size_t kHeights = 12; // of the table
constexpr std::size_t kSuns = 17;
constexpr double kSunReach = 0.35; ///< radians: how far the sun of other places stands from that of the eye
constexpr std::size_t kDirections = 32;

/// Evenly spread over the sphere.
glm::dvec3 directionOf(std::size_t index) {
  constexpr double kGoldenAngle = 2.399963229728653;
  const double z = 1 - (2 * static_cast<double>(index) + 1) / kDirections;
  const double across = std::sqrt(1 - z * z), angle = kGoldenAngle * static_cast<double>(index);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

double heightOf(std::size_t row) {
  const double share = static_cast<double>(row) / (kHeights - 1);
  return kAirTop * share * share;
}

struct Reach {
  double length;
  bool meetsGround;
};

Reach reachOf(const AirRay& ray) {
  const double from = kEarthRadius + ray.height, along = from * ray.direction.z;
  const auto squareBeyond = [&](double radius) { return along * along - (from * from - radius * radius); };
  if (const double ground = squareBeyond(kEarthRadius); along < 0 && ground > 0) {
    return {std::max(0.0, -along - std::sqrt(ground)), true};
  }
  return {std::max(0.0, -along + std::sqrt(std::max(0.0, squareBeyond(kEarthRadius + kAirTop)))), false};
}

AirPlace placeOn(const AirRay& ray, double t, const glm::dvec3& towardsSun) {
  const glm::dvec3 place = glm::dvec3(0, 0, kEarthRadius + ray.height) + t * ray.direction;
  const double radius = glm::length(place);
  return {radius - kEarthRadius, glm::dot(place, towardsSun) / radius};
}

/// A piece of a ray, short enough that the air is the same all along it.
struct Step {
  AirPlace place;
  Spectrum byMolecules{}; ///< what of light in it is scattered to the ray's beginning, but for the phase function
  Spectrum byHaze{};
};

/// Calls `each` with all pieces of a ray and returns the share of light that passes through all of it.
template <class Each>
Spectrum walk(const AirCoefficients& air, const glm::dvec3& towardsSun, const AirRay& ray, double length, int pieces,
              const Each& each) {
  Spectrum left;
  left.fill(1);
  for (int i = 0; i < pieces; ++i) {
    const double begin = length * i * i / (pieces * pieces), end = length * (i + 1) * (i + 1) / (pieces * pieces);
    Step step{placeOn(ray, (begin + end) / 2, towardsSun)};
    const AirColumn density = densityAt(step.place.height);
    const Spectrum through = transmittance(air, density * (end - begin));
    for (std::size_t band = 0; band < kBands; ++band) {
      const float molecules = air.molecules[band] * static_cast<float>(density.molecules);
      const float haze = air.hazeScatter[band] * static_cast<float>(density.haze);
      const float loss = molecules + air.hazeLoss[band] * static_cast<float>(density.haze) +
                         air.ozoneAbsorbs[band] * static_cast<float>(density.ozone);
      // The integral along the piece of what passes.
      const float lit = left[band] * (loss > 1e-12f ? (1 - through[band]) / loss : static_cast<float>(end - begin));
      step.byMolecules[band] = molecules * lit;
      step.byHaze[band] = haze * lit;
      left[band] *= through[band];
    }
    each(step);
  }
  return left;
}

} // namespace

Spectrum ScatteringAir::moreOftenOf(const AirPlace& place, const Spectrum& albedo) const {
  Spectrum second{}, again{}; // after two scatterings; of unit light from everywhere what returns after one
  const double sunCosine = std::sqrt(std::max(0.0, 1 - place.sunSine * place.sunSine));
  const glm::dvec3 towardsSun(sunCosine, 0, place.sunSine);
  for (std::size_t i = 0; i < kDirections; ++i) {
    const AirRay ray{place.height, directionOf(i)};
    const Reach reach = reachOf(ray);
    const Spectrum left = walk(air_, towardsSun, ray, reach.length, kSecondSteps, [&](const Step& step) {
      const Spectrum sun = columns_.sunlight(air_, step.place);
      for (std::size_t band = 0; band < kBands; ++band) {
        const float scattered = step.byMolecules[band] + step.byHaze[band];
        second[band] += scattered * sun[band] / (4 * glm::pi<float>() * kDirections);
        again[band] += scattered / kDirections;
      }
    });
    if (!reach.meetsGround) continue;
    const AirPlace ground = placeOn(ray, reach.length, towardsSun);
    const Spectrum sun = columns_.sunlight(air_, {0, ground.sunSine});
    for (std::size_t band = 0; band < kBands; ++band) {
      const auto cosine = static_cast<float>(std::max(ground.sunSine, 0.0));
      second[band] += left[band] * albedo[band] * sun[band] * cosine / (glm::pi<float>() * kDirections);
    }
  }
  // Every further scattering returns the same share: a geometric series.
  for (std::size_t band = 0; band < kBands; ++band) second[band] /= 1 - again[band];
  return second;
}

double ScatteringAir::sunSineOfColumn(std::size_t column) const {
  const double turn = kSunReach * (2 * static_cast<double>(column) / (kSuns - 1) - 1);
  return std::sin(std::clamp(std::asin(towardsSun_.z) + turn, -glm::half_pi<double>(), glm::half_pi<double>()));
}

Spectrum ScatteringAir::moreOftenAt(const AirPlace& place) const {
  const double turn = std::asin(std::clamp(place.sunSine, -1.0, 1.0)) - std::asin(towardsSun_.z);
  const double column = (std::clamp(turn / kSunReach, -1.0, 1.0) + 1) / 2 * (kSuns - 1);
  const double row = std::sqrt(std::clamp(place.height / kAirTop, 0.0, 1.0)) * (kHeights - 1);
  const auto x = std::min(static_cast<std::size_t>(column), kSuns - 2);
  const auto y = std::min(static_cast<std::size_t>(row), kHeights - 2);
  const auto right = static_cast<float>(column - static_cast<double>(x));
  const auto below = static_cast<float>(row - static_cast<double>(y));
  const Spectrum* at = &moreOften_[y * kSuns + x];
  Spectrum mixed;
  for (std::size_t band = 0; band < kBands; ++band) {
    mixed[band] = (at[0][band] * (1 - right) + at[1][band] * right) * (1 - below) +
                  (at[kSuns][band] * (1 - right) + at[kSuns + 1][band] * right) * below;
  }
  return mixed;
}

ScatteringAir::ScatteringAir(const AirCoefficients& air, const glm::dvec3& towardsSun, const Spectrum& albedo)
    : air_(air), towardsSun_(towardsSun) {
  std::vector<Spectrum> table(kHeights * kSuns);
  forEach(table.size(), [&](std::size_t i) {
    table[i] = moreOftenOf({heightOf(i / kSuns), sunSineOfColumn(i % kSuns)}, albedo);
  });
  moreOften_ = std::move(table);
}

ScatteredLight ScatteringAir::along(const AirRay& ray) const {
  ScatteredLight light;
  walk(air_, towardsSun_, ray, reachOf(ray).length, kSteps, [&](const Step& step) {
    const Spectrum sun = columns_.sunlight(air_, step.place);
    const Spectrum more = moreOftenAt(step.place);
    for (std::size_t band = 0; band < kBands; ++band) {
      light.once[band] += step.byMolecules[band] * sun[band];
      light.onceHaze[band] += step.byHaze[band] * sun[band];
      light.moreOften[band] += (step.byMolecules[band] + step.byHaze[band]) * more[band];
    }
  });
  return light;
}

} // namespace gnomon

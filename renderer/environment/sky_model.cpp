#include "renderer/environment/sky_model.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/light.h"
#include "renderer/core/parallel.h"
#include "renderer/environment/make_environment.h"
#include "renderer/environment/sky_scattering.h"

namespace gnomon {
namespace {

constexpr int kWidth = 512, kHeight = 256; // of the map
constexpr double kEyeHeight = 2;           // metres
constexpr double kFaintest = 1e-3;         // lux; a sun that gives less is none. A full moon gives 0.3

// Directions for which light is computed, and between which it is interpolated: elevations close together at the
// horizon, azimuths from the sun's to the opposite one.
constexpr std::size_t kElevations = 64;
constexpr std::size_t kAzimuths = 33;

/// ScatteredLight as linear sRGB, which is as good to interpolate.
struct SkyColor {
  glm::dvec3 once{0}, onceHaze{0}, moreOften{0};

  SkyColor operator*(double by) const { return {once * by, onceHaze * by, moreOften * by}; }
  SkyColor operator+(const SkyColor& other) const {
    return {once + other.once, onceHaze + other.onceHaze, moreOften + other.moreOften};
  }
};

/// By elevation and azimuth from the sun.
using SkyTable = std::vector<SkyColor>;

SkyTable skyTable(const ScatteringAir& air) {
  SkyTable table(kElevations * kAzimuths);
  forEach(table.size(), [&](std::size_t i) {
    const double share = static_cast<double>(i / kAzimuths) / (kElevations - 1);
    const double elevation = share * share * glm::half_pi<double>();
    const double azimuth = static_cast<double>(i % kAzimuths) / (kAzimuths - 1) * glm::pi<double>();
    const ScatteredLight light = air.along(
        {kEyeHeight,
         {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)}});
    table[i] = {sunlightColor(light.once), sunlightColor(light.onceHaze), sunlightColor(light.moreOften)};
  });
  return table;
}

SkyColor colorAt(const SkyTable& table, double elevation, double azimuthFromSun) {
  const double row = std::sqrt(std::clamp(elevation / glm::half_pi<double>(), 0.0, 1.0)) * (kElevations - 1);
  const double column = std::clamp(azimuthFromSun / glm::pi<double>(), 0.0, 1.0) * (kAzimuths - 1);
  const auto y = std::min(static_cast<std::size_t>(row), kElevations - 2);
  const auto x = std::min(static_cast<std::size_t>(column), kAzimuths - 2);
  const double right = column - static_cast<double>(x), below = row - static_cast<double>(y);
  const SkyColor* at = &table[y * kAzimuths + x];
  return (at[0] * (1 - right) + at[1] * right) * (1 - below) +
         (at[kAzimuths] * (1 - right) + at[kAzimuths + 1] * right) * below;
}

/// Rayleigh's, a steradian.
double phaseOfMolecules(double cosine) {
  return 3 / (16 * glm::pi<double>()) * (1 + cosine * cosine);
}

/// Of Cornette and Shanks, "Physically reasonable analytic expression for the single-scattering phase function" (1992),
/// with g = 0.8, as Bruneton and Hillaire have it.
double phaseOfHaze(double cosine) {
  constexpr double g = 0.8;
  return 3 / (8 * glm::pi<double>()) * (1 - g * g) * (1 + cosine * cosine) /
         ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// Radiance of the sky in a direction above the horizon.
glm::dvec3 radianceOf(const SkyTable& table, const glm::dvec3& direction, const glm::dvec3& towardsSun) {
  const double elevation = std::asin(std::clamp(direction.y, -1.0, 1.0));
  // With the sun overhead every azimuth is as good.
  const double azimuth = std::atan2(direction.x * towardsSun.z - direction.z * towardsSun.x,
                                    direction.x * towardsSun.x + direction.z * towardsSun.z);
  const SkyColor color = colorAt(table, elevation, std::abs(azimuth));
  const double cosine = glm::dot(direction, towardsSun);
  const glm::dvec3 radiance =
      color.once * phaseOfMolecules(cosine) + color.onceHaze * phaseOfHaze(cosine) + color.moreOften;
  return withinSrgb(radiance);
}

glm::dvec3 directionAt(int x, int y) {
  return environmentDirection({(x + 0.5) / kWidth, (y + 0.5) / kHeight});
}

/// The share of light that ground of this color returns, by band: blue below 500 nm, red from 580 nm on.
Spectrum byBand(const Vec3& color) {
  Spectrum shares;
  for (std::size_t band = 0; band < kBands; ++band) {
    const double nm = wavelengthOf(band);
    shares[band] = static_cast<float>(nm < 500 ? color[2] : nm < 580 ? color[1] : color[0]);
  }
  return shares;
}

void drawSky(EnvironmentMap& map, const SkyTable& table, const glm::dvec3& towardsSun) {
  forEach(static_cast<std::size_t>(map.height / 2), [&](std::size_t row) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 direction = directionAt(x, static_cast<int>(row));
      map.texels[row * kWidth + static_cast<std::size_t>(x)] = glm::vec3(radianceOf(table, direction, towardsSun));
    }
  });
}

/// Illuminance of the ground by the sky alone, lux.
glm::dvec3 skyIlluminance(const EnvironmentMap& map) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < map.height / 2; ++y) {
    glm::dvec3 row(0.0);
    for (int x = 0; x < map.width; ++x) row += glm::dvec3(map.at(x, y));
    sum += row * (texelSolidAngle(map, y) * directionAt(0, y).y);
  }
  return sum;
}

void drawGround(EnvironmentMap& map, const glm::dvec3& radiance) {
  std::fill(map.texels.begin() + static_cast<std::ptrdiff_t>(map.texels.size() / 2), map.texels.end(),
            glm::vec3(radiance));
}

} // namespace

std::optional<FoundSun> sunOf(const Sky& sky) {
  const glm::dvec3 towards = towardsSun(sky.sun);
  const double disc = visibleDisc({kEyeHeight, towards.y});
  if (disc <= 0) return std::nullopt;
  const Spectrum share = transmittance(coefficientsOf(sky.turbidity), columnAlong(kEyeHeight, std::asin(towards.y)));
  const glm::dvec3 irradiance = withinSrgb(sunlightColor(share)) * disc;
  if (luminanceOf(irradiance) < kFaintest) return std::nullopt;
  return FoundSun{towards, kSunRadians, irradiance};
}

Environment skyEnvironment(const Sky& sky) {
  const glm::dvec3 towards = towardsSun(sky.sun);
  const double across = std::hypot(towards.x, towards.z);
  const ScatteringAir air(coefficientsOf(sky.turbidity), {across, 0, towards.y}, byBand(sky.albedo));

  Environment made;
  made.map = {kWidth, kHeight, std::vector<glm::vec3>(std::size_t{kWidth} * kHeight)};
  drawSky(made.map, skyTable(air), towards);
  made.sun = sunOf(sky);
  glm::dvec3 onGround = skyIlluminance(made.map);
  if (made.sun) onGround += made.sun->irradiance * std::max(towards.y, 0.0);
  drawGround(made.map, onGround * glm::dvec3(sky.albedo[0], sky.albedo[1], sky.albedo[2]) / glm::pi<double>());
  return makeEnvironment(std::move(made.map), made.sun);
}

} // namespace gnomon

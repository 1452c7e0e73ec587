#include "renderer/environment/extract_sun.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "renderer/core/light.h"

namespace gnomon {
namespace {

constexpr double kLeastContrast = 500;                      ///< of the peak to the mean
constexpr double kLeastShare = 0.25;                        ///< of the light on a surface that faces it
constexpr double kWidestDisc = 6 * glm::pi<double>() / 180; ///< diameter, radians
constexpr double kDiscLuminance = 0.5;                      ///< of the peak

glm::dvec3 directionAt(const EnvironmentMap& map, int x, int y) {
  return environmentDirection({(x + 0.5) / map.width, (y + 0.5) / map.height});
}

struct Brightest {
  int x = 0, y = 0;
  double peak = 0; ///< luminance
  double mean = 0; ///< luminance, over all directions
};

Brightest brightestOf(const EnvironmentMap& map) {
  Brightest found;
  for (int y = 0; y < map.height; ++y) {
    double row = 0;
    for (int x = 0; x < map.width; ++x) {
      const double here = luminanceOf(glm::dvec3(map.at(x, y)));
      row += here;
      if (here > found.peak) found = {x, y, here, found.mean};
    }
    found.mean += row * texelSolidAngle(map, y) / (4 * glm::pi<double>());
  }
  return found;
}

/// Solid angle of the texels that are connected to the brightest by their edges and at least half as bright; more than
/// `most` = they are more than that.
double discAngle(const EnvironmentMap& map, const Brightest& brightest, double most) {
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
  };
  std::vector<bool> seen(map.texels.size());
  std::vector<std::pair<int, int>> open{{brightest.x, brightest.y}};
  seen[index(brightest.x, brightest.y)] = true;
  double angle = 0;
  const auto visit = [&](int x, int y) {
    if (y < 0 || y >= map.height) return;
    x = (x + map.width) % map.width;
    if (seen[index(x, y)] || luminanceOf(glm::dvec3(map.at(x, y))) < kDiscLuminance * brightest.peak) return;
    seen[index(x, y)] = true;
    open.emplace_back(x, y);
  };
  while (!open.empty() && angle <= most) {
    const auto [x, y] = open.back();
    open.pop_back();
    angle += texelSolidAngle(map, y);
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return angle;
}

/// Calls `take` with column, row and angle from `middle` of every texel whose centre is within `radius` of it.
template <class Take>
void forTexelsWithin(const EnvironmentMap& map, const glm::dvec3& middle, double radius, const Take& take) {
  const double colatitude = std::acos(std::clamp(middle.y, -1.0, 1.0));
  const auto rowOf = [&](double angle) {
    return std::clamp(static_cast<int>(std::floor(angle / glm::pi<double>() * map.height)), 0, map.height - 1);
  };
  for (int y = rowOf(colatitude - radius); y <= rowOf(colatitude + radius); ++y) {
    for (int x = 0; x < map.width; ++x) {
      const double angle = std::acos(std::clamp(glm::dot(directionAt(map, x, y), middle), -1.0, 1.0));
      if (angle <= radius) take(x, y, angle);
    }
  }
}

glm::vec3 meanOfRing(const EnvironmentMap& map, const glm::dvec3& middle, double inner, double outer) {
  glm::dvec3 light(0);
  double angles = 0;
  forTexelsWithin(map, middle, outer, [&](int x, int y, double angle) {
    if (angle <= inner) return;
    light += glm::dvec3(map.at(x, y)) * texelSolidAngle(map, y);
    angles += texelSolidAngle(map, y);
  });
  return glm::vec3(angles > 0 ? light / angles : glm::dvec3(0));
}

} // namespace

std::optional<FoundSun> takeSun(EnvironmentMap& map) {
  const Brightest brightest = brightestOf(map);
  if (!(brightest.peak > 0) || brightest.peak < kLeastContrast * brightest.mean) return std::nullopt;
  const double widest = glm::two_pi<double>() * (1 - std::cos(kWidestDisc / 2));
  const double disc = discAngle(map, brightest, widest);
  if (disc > widest) return std::nullopt;

  const double radius = std::acos(1 - disc / glm::two_pi<double>());
  const double texel = glm::pi<double>() / map.height;
  const glm::dvec3 middle = directionAt(map, brightest.x, brightest.y);
  const double halo = 4 * radius + 2 * texel;
  const glm::vec3 ring = meanOfRing(map, middle, halo, halo + 2 * texel);

  FoundSun sun{{}, 2 * radius, glm::dvec3(0)};
  glm::dvec3 place(0);
  forTexelsWithin(map, middle, halo, [&](int x, int y, double) {
    const glm::vec3& here = map.at(x, y);
    const glm::dvec3 taken = glm::dvec3(here - glm::min(here, ring)) * texelSolidAngle(map, y);
    sun.irradiance += taken;
    place += luminanceOf(taken) * directionAt(map, x, y);
  });
  const double arriving = luminanceOf(sun.irradiance);
  const double left = glm::pi<double>() * brightest.mean - arriving / 4;
  if (!(arriving >= kLeastShare * left)) return std::nullopt;
  sun.towards = glm::normalize(place);
  forTexelsWithin(map, middle, halo, [&](int x, int y, double) {
    glm::vec3& here =
        map.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
    here = glm::min(here, ring);
  });
  return sun;
}

} // namespace gnomon

#include "renderer/environment/stated_irradiance.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "renderer/core/light.h"

namespace gnomon {
namespace {

/// The nine functions, each of which squared is 1 over the sphere.
Irradiance basisAt(const glm::dvec3& n) {
  return {0.282094791773878,
          0.488602511902920 * n.y,
          0.488602511902920 * n.z,
          0.488602511902920 * n.x,
          1.092548430592079 * n.x * n.y,
          1.092548430592079 * n.y * n.z,
          0.315391565252520 * (3 * n.z * n.z - 1),
          1.092548430592079 * n.x * n.z,
          0.546274215296040 * (n.x * n.x - n.y * n.y)};
}

/// What the cosine over the hemisphere makes of each: of l = 0, 1 and 2.
constexpr double kPi = glm::pi<double>();
constexpr Irradiance kCosine{kPi, 2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4, kPi / 4, kPi / 4, kPi / 4, kPi / 4};

} // namespace

Irradiance irradianceOf(const EnvironmentMap& map, const glm::dmat3& axesFromMap) {
  constexpr int kMostColumns = 256; ///< directions a row, each of the mean of its texels: l <= 2 needs no more
  const int step = std::max(1, map.width / kMostColumns);
  Irradiance sum{};
  for (int y = 0; y < map.height; ++y) {
    const double solidAngle = texelSolidAngle(map, y) * step;
    for (int x = 0; x + step <= map.width; x += step) {
      double light = 0;
      for (int i = 0; i < step; ++i) light += luminanceOf(glm::dvec3(map.at(x + i, y)));
      const glm::dvec2 place((x + 0.5 * step) / map.width, (y + 0.5) / map.height);
      const Irradiance basis = basisAt(axesFromMap * environmentDirection(place));
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += basis[i] * light / step * solidAngle;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] *= kCosine[i];
  return sum;
}

double irradianceAt(const Irradiance& irradiance, const glm::dvec3& normal) {
  const Irradiance basis = basisAt(normal);
  double sum = 0;
  for (std::size_t i = 0; i < basis.size(); ++i) sum += irradiance[i] * basis[i];
  return sum;
}

double greatestDifference(const Irradiance& stated, const Irradiance& right) {
  double difference = 0, greatest = 0;
  for (int i = 0; i < 27; ++i) {
    const glm::dvec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (way == glm::dvec3(0)) continue;
    const glm::dvec3 normal = glm::normalize(way);
    difference = std::max(difference, std::abs(irradianceAt(stated, normal) - irradianceAt(right, normal)));
    greatest = std::max(greatest, irradianceAt(right, normal));
  }
  if (greatest > 0) return difference / greatest;
  return difference > 0 ? std::numeric_limits<double>::infinity() : 0;
}

} // namespace gnomon

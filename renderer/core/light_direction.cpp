#include "renderer/core/light_direction.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/vec3.h"

namespace gnomon {

glm::dvec3 directionOf(const Light& light) {
  if (light.sun) {
    const double azimuth = glm::radians(light.sun->azimuthDegrees);
    const double elevation = glm::radians(light.sun->elevationDegrees);
    return -glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                       -std::cos(azimuth) * std::cos(elevation));
  }
  if (light.direction) {
    const glm::dvec3 direction = toVector(*light.direction);
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    return glm::normalize(direction / largest);
  }
  return {0, -1, 0};
}

} // namespace gnomon

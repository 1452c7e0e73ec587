#include "renderer/environment/environment_map.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gnomon {

glm::dvec3 environmentDirection(const glm::dvec2& place) {
  const double longitude = (place.x - 0.5) * glm::two_pi<double>();
  const double colatitude = place.y * glm::pi<double>();
  const double across = std::sin(colatitude);
  return {across * std::cos(longitude), std::cos(colatitude), across * std::sin(longitude)};
}

glm::dvec2 environmentPlace(const glm::dvec3& direction) {
  const double across = std::hypot(direction.x, direction.z);
  return {std::atan2(direction.z, direction.x) * glm::one_over_two_pi<double>() + 0.5,
          std::atan2(across, direction.y) * glm::one_over_pi<double>()};
}

double texelSolidAngle(const EnvironmentMap& map, int y) {
  const auto latitudes = [&](int row) { return std::cos(row * glm::pi<double>() / map.height); };
  return glm::two_pi<double>() / map.width * (latitudes(y) - latitudes(y + 1));
}

} // namespace gnomon

#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

/// Light from all directions, as a picture.
namespace gnomon {

/// Linear radiance by longitude and latitude. Rows go from the zenith (+Y) down to the nadir; the middle between the
/// first and the last column lies towards +X, and columns go on from there towards +Z. Texels are the radiance at
/// their centres. Every number is finite and not negative.
struct EnvironmentMap {
  int width = 0; ///< texels; twice the height
  int height = 0;
  std::vector<glm::vec3> texels; ///< row by row

  const glm::vec3& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The direction of a place of the picture, 0..1 from its upper left corner. Unit length.
glm::dvec3 environmentDirection(const glm::dvec2& place);

/// The place of a direction of any length but 0: inverse of environmentDirection.
glm::dvec2 environmentPlace(const glm::dvec3& direction);

/// The solid angle of a texel of row `y`, steradians.
double texelSolidAngle(const EnvironmentMap& map, int y);

/// A bright disc that was taken out of a map.
struct FoundSun {
  glm::dvec3 towards{0, 1, 0}; ///< unit length, in the map's own directions
  double angularDiameter = 0;  ///< radians
  glm::dvec3 irradiance{0};    ///< of a surface that faces it, linear RGB, in the map's unit
};

} // namespace gnomon

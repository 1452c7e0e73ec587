#pragma once

#include <vector>

#include "renderer/environment/environment_map.h"

/// A map as cells of ever fewer texels, for sums over all directions that take near ones by themselves.
namespace gnomon {

/// The same map of another size: means over what each of its texels covers, by solid angle.
EnvironmentMap resampled(const EnvironmentMap& map, int width);

struct EnvironmentCell {
  glm::vec3 flux{0};      ///< radiance times solid angle
  float solidAngle = 0;   ///< steradians
  glm::vec3 middle{0};    ///< unit length
  float width = 0;        ///< of its longer side, radians
  glm::vec3 brightest{0}; ///< unit length: the mean direction of its light
};

/// Cells of one or more texels each, two by two from the level before.
struct CellLevel {
  int width = 0;
  int height = 0;
  std::vector<EnvironmentCell> cells;

  const EnvironmentCell& at(int x, int y) const {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The first level has a cell a texel, the last one no more than 8 x 4.
std::vector<CellLevel> cellLevels(const EnvironmentMap& map);

/// The mean of radiance over the lobe of GGX about a direction: see PrefilteredEnvironment. `alpha`: above 0.
glm::vec3 meanOverLobe(const std::vector<CellLevel>& levels, const glm::vec3& direction, float alpha);

} // namespace gnomon

#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "renderer/volume/medium.h"

namespace gnomon {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Numbers for a property test, by a seed that RapidCheck chose.
class Chances {
 public:
  explicit Chances(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * std::generate_canonical<double, 53>(engine_); }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  glm::dvec3 place() { return {between(0, 1), between(0, 1), between(0, 1)}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v = 2.0 * place() - 1.0;
      const double length = glm::length(v);
      if (length > 0.1 && length < 1.0) return v / length;
    }
  }

 private:
  std::mt19937 engine_;
};

/// A grid whose voxels have the value of their centre.
inline std::shared_ptr<const DensityGrid> gridOf(const glm::ivec3& size,
                                                 const std::function<double(const glm::dvec3&)>& value) {
  auto grid = std::make_shared<DensityGrid>(DensityGrid{size, {}});
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        grid->values.push_back(static_cast<float>(value((glm::dvec3(x, y, z) + 0.5) / glm::dvec3(size))));
      }
    }
  }
  return grid;
}

/// Extinction is `perMetre` times the value, of values 0..1; half of what is taken is scattered.
inline TransferFunction proportional(double perMetre) {
  return *makeTransferFunction({{0, {glm::dvec3(0.5), 0}}, {1, {glm::dvec3(0.5), perMetre}}});
}

inline VolumeSpace boxSpace(const glm::dvec3& low, const glm::dvec3& high) {
  return *spaceOf(Aabb{low, high});
}

/// The unit cube stretched to `size`, turned about its middle, and moved there.
inline VolumeSpace turnedSpace(const glm::dvec3& middle, const glm::dvec3& size, double angle, const glm::dvec3& axis) {
  const glm::dmat4 matrix = glm::translate(glm::dmat4(1), middle) * glm::rotate(glm::dmat4(1), angle, axis) *
                            glm::scale(glm::dmat4(1), size) * glm::translate(glm::dmat4(1), glm::dvec3(-0.5));
  return *spaceOf(matrix);
}

/// A box, or a turned one, of up to 20 m around a place.
inline VolumeSpace anySpace(Chances& chances, const glm::dvec3& middle) {
  const glm::dvec3 size = 0.1 + 20.0 * chances.place();
  return chances.below(2) == 0 ? boxSpace(middle - size / 2.0, middle + size / 2.0)
                               : turnedSpace(middle, size, chances.between(0, 7), chances.direction());
}

/// The same extinction everywhere.
inline Medium homogeneous(const VolumeSpace& space, double perMetre, const glm::ivec3& size = {4, 4, 4}) {
  return makeMedium(gridOf(size, [](const glm::dvec3&) { return 1.0; }), proportional(perMetre), space);
}

/// A ball of the largest radius in the cube, densest in its middle, smooth towards its border.
inline Medium ball(const VolumeSpace& space, double perMetre, int side) {
  const auto density = [](const glm::dvec3& unit) {
    const double radius = 2 * glm::length(unit - 0.5);
    return radius < 1 ? std::pow(std::cos(radius * 1.5707963267948966), 2) : 0.0;
  };
  return makeMedium(gridOf(glm::ivec3(side), density), proportional(perMetre), space);
}

} // namespace gnomon

#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace gnomon {

/// An axis-aligned box in double precision. Empty until something is added.
struct Aabb {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  glm::dvec3 center() const { return 0.5 * (min + max); }
  glm::dvec3 halfExtent() const { return 0.5 * (max - min); }

  void add(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Aabb& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
  }
};

/// From a point to the nearest one of a box; 0 inside. REQUIRES: the box is not empty.
inline double squaredDistance(const Aabb& box, const glm::dvec3& point) {
  const glm::dvec3 away = glm::max(glm::max(box.min - point, point - box.max), glm::dvec3(0.0));
  return glm::dot(away, away);
}

/// The box around `box` after an affine transform (Arvo, Graphics Gems 1990).
inline Aabb transformed(const glm::dmat4& matrix, const Aabb& box) {
  if (box.empty()) return {};
  const glm::dvec3 center = glm::dvec3(matrix * glm::dvec4(box.center(), 1.0));
  const glm::dvec3 half = box.halfExtent();
  const glm::dvec3 extent = glm::abs(glm::dvec3(matrix[0])) * half.x + glm::abs(glm::dvec3(matrix[1])) * half.y +
                            glm::abs(glm::dvec3(matrix[2])) * half.z;
  return {center - extent, center + extent};
}

/// Whether no component is NaN or infinite.
template <glm::length_t N, class T>
bool finite(const glm::vec<N, T>& v) {
  for (glm::length_t i = 0; i < N; ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

inline bool finite(const glm::dmat4& matrix) {
  return finite(matrix[0]) && finite(matrix[1]) && finite(matrix[2]) && finite(matrix[3]);
}

/// An empty box is not finite.
inline bool finite(const Aabb& box) {
  return finite(box.min + box.max);
}

} // namespace gnomon

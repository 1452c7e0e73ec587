#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderer/core/aabb.h"

namespace gnomon {

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

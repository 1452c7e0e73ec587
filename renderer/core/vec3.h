#pragma once

#include <glm/glm.hpp>

#include "protocol/spec/scene_options.h"

namespace gnomon {

/// Between the vocabulary's triples and glm's vectors.
inline glm::dvec3 toVector(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
inline Vec3 toTriple(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

} // namespace gnomon

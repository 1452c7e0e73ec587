#pragma once

#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "protocol/spec/scene_options.h"

namespace gnomon {

/// A glTF rotation by 90 degrees about Y: +Z to +X, so -Z to -X.
inline const nlohmann::json kQuarterAroundY = {0, std::numbers::sqrt2 / 2, 0, std::numbers::sqrt2 / 2};

/// By 90 degrees about Z: +X to +Y.
inline const nlohmann::json kQuarterAroundZ = {0, 0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2};

inline void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::length(actual - expected), tolerance) << actual.x << " " << actual.y << " " << actual.z << " is not "
                                                       << expected.x << " " << expected.y << " " << expected.z;
}

inline glm::dvec3 toDvec3(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

} // namespace gnomon

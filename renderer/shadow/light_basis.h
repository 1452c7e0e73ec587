#pragma once

#include <glm/glm.hpp>

namespace gnomon {

/// Axes to look along a light: right and up span the shadow map, `direction` is where the light travels. Orthonormal;
/// right x up = -direction. Coordinates along these three axes are "light space" (Ls): x, y on the map, z growing away
/// from the light.
struct LightBasis {
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 direction{0, 0, -1};

  /// Rows right, up, direction: a pure turn, so that it takes world and eye-relative points alike.
  glm::dmat3 lightFromWorld() const { return glm::transpose(glm::dmat3(right, up, direction)); }
};

/// Light space from eye-relative world space, with its origin there: a turn and a shift.
inline glm::dmat4 lightFromRelative(const LightBasis& basis, const glm::dvec3& origin) {
  const glm::dmat3 turn = basis.lightFromWorld();
  glm::dmat4 matrix(turn);
  matrix[3] = glm::dvec4(-(turn * origin), 1.0);
  return matrix;
}

/// The basis for a unit direction. It depends on nothing but the direction and turns as little as it: at the vertical,
/// where a basis made from a world "up" jumps, the roll changes about as much as the light moved. A tangent field on
/// the sphere must spin somewhere; here that is around light shining up from a point 11 degrees below the horizon,
/// where no sun stands. There too the basis is finite and orthonormal.
LightBasis lightBasis(const glm::dvec3& direction);

} // namespace gnomon

#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/reference/light_source.h"

namespace gnomon {

/// A flat, convex piece of a surface; metres, relative to the scene's anchor.
struct FlatBlock {
  std::array<glm::dvec3, 4> corners{}; ///< one after the other around it
  glm::dvec3 normal{0};                ///< unit length, on the side that is seen
};

/// A convex region that holds every way from a block to anywhere on a light (Haines and Wallace, "Shaft Culling for
/// Efficient Ray-Traced Radiosity", 1991): what lies outside can't throw a shadow on the block.
struct Shaft {
  static constexpr std::size_t kPlanes = 6;
  /// x y z points inwards, and is zero for a plane that bounds nothing; w is added. In the units of the tree, and moved
  /// outwards by more than floats lose of a coordinate there.
  std::array<glm::vec4, kPlanes> planes{};
};

/// Nothing where part of the light lies below the block's plane, or where the block is too small, or lies too much
/// askew, for its sides to tell.
std::optional<Shaft> shaftTo(const LightSource& light, const FlatBlock& block, double scale);

} // namespace gnomon

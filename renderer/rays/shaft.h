#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "renderer/rays/light_source.h"
#include "renderer/rays/triangle.h"

namespace gnomon {

/// A flat, convex piece of a surface; metres, relative to the scene's anchor.
struct FlatBlock {
  std::array<glm::dvec3, 4> corners{}; ///< one after the other around it; of a triangle the last one twice
  glm::dvec3 normal{0};                ///< unit length, on the side that is seen
};

/// How a block is turned to a light, as faces() says of each of its points.
enum class Turn { towards, away, unsure };
Turn turnOf(const LightSource& light, const FlatBlock& block);

/// Whether all of the light lies over the block's plane.
bool isOver(const LightSource& light, const FlatBlock& block);

/// A convex region that holds every way from a block to anywhere on a light (Haines and Wallace, "Shaft Culling for
/// Efficient Ray-Traced Radiosity", 1991): what lies outside can't throw a shadow on the block.
struct Shaft {
  static constexpr std::size_t kPlanes = 6;
  /// x y z points inwards, and is zero for a plane that bounds nothing; w is added. In the units of the tree, and moved
  /// outwards by more than floats lose of a coordinate there.
  std::array<glm::vec4, kPlanes> planes{};
};

/// Nothing where part of the light lies below the block's plane, or where the block is too small or too askew for a
/// plane along each of its sides.
std::optional<Shaft> shaftTo(const LightSource& light, const FlatBlock& block, double scale);

/// The same from anywhere between some points, of which there is one at least. Nothing where the light is too near.
std::optional<Shaft> shaftTo(const LightSource& light, std::span<const glm::dvec3> points, double scale);

/// Whether no way from a block to anywhere on the light crosses a triangle's plane, but for what `meets` puts down to
/// rounding: large triangles reach into shafts that run past them, and so do a block's neighbours in a hollow.
bool passesBy(const LightSource& light, const FlatBlock& block, const Triangle& triangle);

/// Whether all ways from a block to anywhere on the light run past one of a triangle's sides, as far off as shafts are
/// moved outwards.
bool passesBeside(const LightSource& light, const FlatBlock& block, const Triangle& triangle, double scale);

} // namespace gnomon

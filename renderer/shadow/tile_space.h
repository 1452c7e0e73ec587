#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/shadow/fit.h"

namespace gnomon {

struct ShadowTile;

/// How a tile's texels and depths lie in the world: light space, and the fit in it.
struct TileSpace {
  LightBasis basis;
  glm::dvec3 origin{0}; ///< of light space, relative to the eye: the plan's anchor (parallel light) or the light
  Fit fit;
  int size = 0; ///< texels along a side, border included
};

/// Light clip space from light space: x y in -1..1 over the whole tile, border included; z 0 nearest the light, 1
/// farthest. Affine for parallel light; else w is the distance from the light along its direction.
glm::dmat4 clipFromLight(const TileSpace& space);

/// The box around an eye-relative one, in light space.
Aabb lightSpaceBox(const TileSpace& space, const Aabb& relative);

/// The box around a box of light space, in clip space after the division by w; empty where all of it lies behind the
/// light.
Aabb clipBox(const TileSpace& space, const Aabb& boxLs);

/// Where in a tile receivers look, and how far from the light they are: a square grid of cells over the whole tile.
struct ReceiverMask {
  static constexpr int kSide = 64;
  std::vector<float> farthest; ///< z (0..1) of the farthest receiver by cell, row by row; -1 = none

  /// True where something inside `box` (the tile's clip space) may be between the light and a receiver.
  bool mayShadow(const Aabb& box) const;
};

/// The mask for receivers inside `piecesClip` (the tile's clip space) whose lookups reach `margin` (x, y of clip space)
/// around them.
ReceiverMask receiverMask(const std::vector<Aabb>& piecesClip, const glm::dvec2& margin);

/// True where something inside `casterBounds` (eye-relative) can cast a shadow onto what `tile` serves:
/// seen along the light it overlaps a part of the tile where receivers look, and does not lie behind all of them there.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds);

} // namespace gnomon

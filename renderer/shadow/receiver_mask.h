#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/core/aabb.h"

namespace gnomon {

struct ShadowTile;

/// Where in a tile receivers look, and how far from the light they are: a square grid of cells over the whole tile.
struct ReceiverMask {
  static constexpr int kSide = 64;
  std::vector<float> farthest; ///< z (0..1) of the farthest receiver by cell, row by row; -1 = none

  /// True where something inside `box` (the tile's clip space) may stand between the light and a receiver.
  bool mayShadow(const Aabb& box) const;
};

/// The mask for receivers inside `piecesClip` (the tile's clip space) whose lookups reach `margin` (x, y of clip space)
/// around them.
ReceiverMask receiverMask(const std::vector<Aabb>& piecesClip, const glm::dvec2& margin);

/// True where something inside `casterBounds` (eye-relative) can throw a shadow onto what `tile` serves:
/// seen along the light it overlaps a part of the tile where receivers look, and does not lie behind all of them there.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds);

} // namespace gnomon

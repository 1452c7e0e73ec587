#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/core/aabb.h"

namespace gnomon {

/// What a column or row of blocks of pixels adds to a point: least and greatest, component by component.
struct BlockStrip {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

/// The strips of `count` columns or rows of blocks, each half a pixel wider on both sides (rasterizers move vertices by
/// a fraction of one). `pixels` is the length of the picture along them; `axis` is what ndc 1 adds, at depth 1
/// (perspective) or at any depth (orthographic).
std::vector<BlockStrip> blockStrips(int count, int blockSize, int pixels, const glm::dvec3& axis);

/// The box around the piece of view behind one block, from depth `from` to depth `to`. `forward` is the view axis in
/// the coordinates of the strips.
Aabb blockPiece(bool perspective, const glm::dvec3& forward, const BlockStrip& column, const BlockStrip& row,
                double from, double to);

} // namespace gnomon

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/bake/light_map.h"

namespace gnomon {

/// Blocks of a light map with one value: most of it is lit or dark as a whole, so that few bytes suffice.
struct EvenBlocks {
  static constexpr int kSide = 8;             ///< texels
  static constexpr std::uint16_t kUneven = 1; ///< a share that no block is said to have
  int columns = 0;                            ///< blocks
  std::vector<std::uint16_t> shares;          ///< row by row; behind the last one more, which means nothing

  std::size_t bytes() const { return shares.capacity() * sizeof(shares[0]); }
};

/// Of each block the share that all of its texels have, and those beside it to the right and above, so that it is what
/// is read anywhere between them; else kUneven.
EvenBlocks evenBlocks(const LightMap& map);

/// Of each triangle the share that is read anywhere in it, if that is one; else EvenBlocks::kUneven. Behind the last
/// one more, which means nothing. `even`: of the map; `corners`: three a triangle, texels.
std::vector<std::uint16_t> evenTriangles(const LightMap& map, const EvenBlocks& even,
                                         std::span<const glm::vec2> corners);

} // namespace gnomon

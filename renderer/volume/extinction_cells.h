#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/volume/medium.h"

namespace gnomon {

inline constexpr int kMostExtinctionCells = 32; ///< along each axis

/// The extinction of a medium by cells that fill its unit cube, each the mean over its own place. Read between the
/// cells' middles by trilinear interpolation. A grid of no more voxels has a cell for each.
struct ExtinctionCells {
  glm::ivec3 size{0};          ///< without the border
  std::vector<float> perMetre; ///< x fastest, then y, then z; a border of one cell on each side repeats the outermost
  glm::vec3 low{0}, high{0};   ///< places in the cube, 0..1, outside of which nothing is read; equal = nothing anywhere
};

/// Read at 4 x 4 x 4 places of each cell at most. `bricks`: of this grid and function.
ExtinctionCells extinctionCells(const DensityGrid& grid, const TransferFunction& function, const Bricks& bricks);

} // namespace gnomon

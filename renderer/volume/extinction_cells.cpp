#include "renderer/volume/extinction_cells.h"

#include <algorithm>
#include <cstddef>

#include "renderer/core/parallel.h"

namespace gnomon {

namespace {

constexpr int kMostPlacesAcross = 4; // that a cell is read at, along each axis

std::size_t cellAt(const glm::ivec3& cell, const glm::ivec3& size) {
  return (static_cast<std::size_t>(cell.z) * size.y + cell.y) * static_cast<std::size_t>(size.x) + cell.x;
}

bool isEmpty(const Bricks& bricks, const glm::ivec3& voxel) {
  return bricks.filled[cellAt(voxel / kBrickSide, bricks.size)] == 0;
}

/// Of places that lie evenly within the cell, at most a voxel apart while there are not too many.
double meanExtinction(const DensityGrid& grid, const TransferFunction& function, const Bricks& bricks,
                      const glm::ivec3& cell, const glm::ivec3& cells) {
  const glm::ivec3 places = glm::min((grid.size + cells - 1) / cells, glm::ivec3(kMostPlacesAcross));
  const glm::dvec3 size(grid.size);
  double sum = 0;
  for (int z = 0; z < places.z; ++z) {
    for (int y = 0; y < places.y; ++y) {
      for (int x = 0; x < places.x; ++x) {
        const glm::dvec3 within = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(places);
        const glm::dvec3 unit = (glm::dvec3(cell) + within) / glm::dvec3(cells);
        if (isEmpty(bricks, glm::min(glm::ivec3(unit * size), grid.size - 1))) continue;
        sum += matterOf(function, valueAt(grid, unit)).extinction;
      }
    }
  }
  return sum / (places.x * places.y * places.z);
}

/// Finds how far interpolation reads anything.
void bound(ExtinctionCells& cells) {
  const glm::ivec3 all = cells.size + 2;
  glm::ivec3 first = cells.size, last(-1);
  for (int z = 0; z < cells.size.z; ++z) {
    for (int y = 0; y < cells.size.y; ++y) {
      for (int x = 0; x < cells.size.x; ++x) {
        const glm::ivec3 cell(x, y, z);
        if (!(cells.perMetre[cellAt(cell + 1, all)] > 0)) continue;
        first = glm::min(first, cell);
        last = glm::max(last, cell);
      }
    }
  }
  if (last.x < 0) return;
  const glm::vec3 size(cells.size);
  cells.low = glm::max(glm::vec3(first) - 0.5f, 0.0f) / size;
  cells.high = glm::min(glm::vec3(last) + 1.5f, size) / size;
}

} // namespace

ExtinctionCells extinctionCells(const DensityGrid& grid, const TransferFunction& function, const Bricks& bricks) {
  ExtinctionCells cells;
  cells.size = glm::min(grid.size, glm::ivec3(kMostExtinctionCells));
  const glm::ivec3 all = cells.size + 2;
  const std::size_t layer = static_cast<std::size_t>(all.x) * static_cast<std::size_t>(all.y);
  cells.perMetre.resize(layer * static_cast<std::size_t>(all.z));
  forEach(static_cast<std::size_t>(cells.size.z), [&](std::size_t z) {
    for (int y = 0; y < cells.size.y; ++y) {
      for (int x = 0; x < cells.size.x; ++x) {
        const glm::ivec3 cell(x, y, z);
        cells.perMetre[cellAt(cell + 1, all)] =
            static_cast<float>(meanExtinction(grid, function, bricks, cell, cells.size));
      }
    }
  });
  for (int z = 0; z < all.z; ++z) {
    for (int y = 0; y < all.y; ++y) {
      for (int x = 0; x < all.x; ++x) {
        const glm::ivec3 place(x, y, z);
        const glm::ivec3 within = glm::clamp(place, glm::ivec3(1), cells.size);
        cells.perMetre[cellAt(place, all)] = cells.perMetre[cellAt(within, all)];
      }
    }
  }
  bound(cells);
  return cells;
}

} // namespace gnomon

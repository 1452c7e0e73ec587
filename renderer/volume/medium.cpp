#include "renderer/volume/medium.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

std::size_t indexOf(const glm::ivec3& place, const glm::ivec3& size) {
  return (static_cast<std::size_t>(place.z) * size.y + place.y) * static_cast<std::size_t>(size.x) + place.x;
}

/// Whether any place of a brick takes light: a place is read from the centres around it, so one voxel more on each
/// side.
bool isFilled(const DensityGrid& grid, const TransferFunction& function, const glm::ivec3& brick) {
  const glm::ivec3 low = glm::max(brick * kBrickSide - 1, glm::ivec3(0));
  const glm::ivec3 high = glm::min((brick + 1) * kBrickSide, grid.size - 1);
  float least = std::numeric_limits<float>::infinity(), largest = -least;
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        least = std::min(least, grid.at(x, y, z));
        largest = std::max(largest, grid.at(x, y, z));
      }
    }
  }
  return largestExtinction(function, double{least}, double{largest}) > 0;
}

} // namespace

Bricks bricksOf(const DensityGrid& grid, const TransferFunction& function) {
  Bricks bricks{(grid.size + kBrickSide - 1) / kBrickSide, {}};
  const glm::ivec3 size = bricks.size;
  const std::size_t rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  bricks.filled.resize(rows * static_cast<std::size_t>(size.x));
  forEach(rows, [&](std::size_t row) {
    const int y = static_cast<int>(row) % size.y, z = static_cast<int>(row) / size.y;
    for (int x = 0; x < size.x; ++x) {
      bricks.filled[indexOf({x, y, z}, size)] = isFilled(grid, function, {x, y, z}) ? 1 : 0;
    }
  });
  return bricks;
}

Medium makeMedium(std::shared_ptr<const DensityGrid> grid, TransferFunction function, const VolumeSpace& space) {
  Bricks bricks = bricksOf(*grid, function);
  return {.grid = std::move(grid), .function = std::move(function), .space = space, .bricks = std::move(bricks)};
}

BrickPassage brickAt(const Medium& medium, const Ray& unitRay, double distance) {
  const glm::dvec3 perBrick = glm::dvec3(medium.grid->size) / double{kBrickSide};
  const glm::dvec3 place = pointAt(unitRay, distance) * perBrick;
  const glm::ivec3 brick = glm::ivec3(glm::clamp(place, glm::dvec3(0), glm::dvec3(medium.bricks.size - 1)));
  double until = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = unitRay.direction[axis] * perBrick[axis];
    if (speed == 0) continue;
    until = std::min(until, distance + (brick[axis] + (speed > 0 ? 1 : 0) - place[axis]) / speed);
  }
  return {std::max(until, distance), medium.bricks.filled[indexOf(brick, medium.bricks.size)] != 0};
}

} // namespace gnomon

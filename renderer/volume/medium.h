#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/volume/density_grid.h"
#include "renderer/volume/transfer_function.h"
#include "renderer/volume/volume_space.h"

namespace gnomon {

inline constexpr int kBrickSide = 8; ///< voxels

/// Which bricks of a grid hold something, x fastest.
struct Bricks {
  glm::ivec3 size{0};
  std::vector<std::uint8_t> filled; ///< 0: no place in the brick takes any light
};

/// What dims light where it passes: a grid, placed, with a transfer function.
struct Medium {
  std::shared_ptr<const DensityGrid> grid;
  TransferFunction function;
  VolumeSpace space;
  bool visible = true;       ///< to the camera
  bool castShadow = true;    ///< on surfaces and media, itself among them
  bool receiveShadow = true; ///< from surfaces and media, itself among them
  Bricks bricks{};
};

Bricks bricksOf(const DensityGrid& grid, const TransferFunction& function);

Medium makeMedium(std::shared_ptr<const DensityGrid> grid, TransferFunction function, const VolumeSpace& space);

/// At a place of the unit cube.
inline Matter matterAt(const Medium& medium, const glm::dvec3& unit) {
  return matterOf(medium.function, valueAt(*medium.grid, unit));
}

/// The brick that a ray is in.
struct BrickPassage {
  double until = 0;    ///< distance along the ray; not before the one that was asked for
  bool filled = false; ///< otherwise nothing is in it
};
BrickPassage brickAt(const Medium& medium, const Ray& unitRay, double distance);

} // namespace gnomon

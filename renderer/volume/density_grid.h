#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

inline constexpr std::int64_t kMaxGridSide = kLimits.maxVolumeSide;
inline constexpr std::int64_t kMaxGridVoxels = kLimits.maxVolumeVoxels; ///< half a gigabyte of floats

/// Numbers at the centres of voxels that fill a unit cube.
struct DensityGrid {
  glm::ivec3 size{0};        ///< voxels along x, y, z; at least 1 each
  std::vector<float> values; ///< x fastest, then y, then z; all finite
  glm::vec2 range{0};        ///< the least and the greatest of them, where they were read from a file

  float at(int x, int y, int z) const {
    return values[(static_cast<std::size_t>(z) * size.y + y) * static_cast<std::size_t>(size.x) + x];
  }
};

/// How many voxels a grid of so many along x, y and z has, or the side or count that is beyond the limits.
Result<std::size_t> voxelCount(std::int64_t x, std::int64_t y, std::int64_t z);

/// The first value that is no finite number is a problem with its place; the grid with its range otherwise.
Result<DensityGrid> requireFinite(DensityGrid grid);

/// Trilinear between the eight nearest centres; `unit`: 0..1 in the cube, and clamped to it.
double valueAt(const DensityGrid& grid, const glm::dvec3& unit);

/// A grid from a NumPy or an OpenVDB file, by its first bytes. `name`: of the grid; empty = the only float grid, or
/// that of a NumPy file, which has no name.
Result<DensityGrid> readGridFile(std::span<const std::uint8_t> file, const std::string& name = {});

/// A grid from a .npy file, versions 1 to 3: three axes (z, y, x) in C order, of little-endian float32 or float16 or of
/// uint8 (0..255).
Result<DensityGrid> readNpy(std::span<const std::uint8_t> file);

} // namespace gnomon

#pragma once

#include <array>
#include <string>
#include <vector>

namespace gnomon {

/// A grid with these active voxels; everything else is its background.
struct VdbGrid {
  struct Voxel {
    std::array<int, 3> place;
    float value;
  };
  std::string name;
  std::vector<Voxel> voxels;
  float background = 0;
  bool isFloat = true; ///< else of doubles
};

/// The bytes of an OpenVDB file.
std::string vdbFile(const std::vector<VdbGrid>& grids);

} // namespace gnomon

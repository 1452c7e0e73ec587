// Density grids as they come in OpenVDB's files.
#include "renderer/volume/vdb_file.h"
#include "tests/fuzz/sound_problems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const auto grid = readVdb({data, size});
  if (!grid) {
    fuzz::requireSound(grid.problems());
    return 0;
  }
  const auto count = voxelCount(grid->size.x, grid->size.y, grid->size.z);
  fuzz::require(count && *count == grid->values.size(), "a number for each voxel");
  return 0;
}

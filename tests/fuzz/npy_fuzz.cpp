// Density grids as they come in NumPy's files.
#include <cmath>

#include "renderer/volume/density_grid.h"
#include "tests/fuzz/sound_problems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const auto grid = readNpy({data, size});
  if (!grid) {
    fuzz::requireSound(grid.problems());
    return 0;
  }
  const auto count = voxelCount(grid->size.x, grid->size.y, grid->size.z);
  fuzz::require(count && *count == grid->values.size() && *count <= size, "a number of the file for each voxel");
  fuzz::require(std::isfinite(valueAt(*grid, {0.25, 0.5, 1.0})), "numbers are finite");
  return 0;
}

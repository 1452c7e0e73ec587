#pragma once

#include <cstdint>
#include <span>

#include "renderer/volume/density_grid.h"

namespace gnomon {

/// A grid from a .npy file of NumPy, versions 1 to 3: three axes (z, y, x) in C order, of little-endian float32 or
/// float16 or of uint8, whose values are 0..255. The sizes are checked against the file's before memory is taken.
Result<DensityGrid> readNpy(std::span<const std::uint8_t> file);

} // namespace gnomon
